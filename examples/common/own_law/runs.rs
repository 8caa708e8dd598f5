//! A law of one's own at work: in a velocity step of a spring slider, and in the paper's 2D slider.

use std::error::Error;

use serde::Serialize;
use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::problems::{END, LoadPath, NORMAL_STRESS, Slider, SpringScene, SpringSlider};
use stickslip::state::{StateLaw, StateVariable};
use stickslip::{
    Adaptive, Condensed, Coupling, Events, Failure, Newmark, RungeKutta, SceneError, Simulation,
    Snapshot, StateUpdate, Stepper,
};

/// The slip rates before and after the velocity step [m/s].
pub(crate) const RATES: [f64; 2] = [1e-6, 1e-5];

/// The slip rate of the 2D slider [m/s] that counts as slip.
const SLIP: f64 = 1e-4;

/// The coefficient of friction in a velocity step.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct VelocityStep {
    /// Before, in steady sliding.
    pub(crate) before: f64,
    /// The largest, just after.
    pub(crate) peak: f64,
    /// One second, a slip of about L, after.
    pub(crate) evolving: f64,
    /// After 100 s, in steady sliding again.
    pub(crate) steady: f64,
}

/// The coefficient of friction of steady sliding after the velocity step,
/// `mu0 + (a - b) ln(V/V0)`.
pub(crate) fn steady_coefficient(law: &DieterichRuina) -> f64 {
    law.reference_friction + (law.a - law.b) * (RATES[1] / law.reference_velocity).ln()
}

/// A block on a stiff spring that slides steadily at `RATES[0]` and is pulled at `RATES[1]`.
pub(crate) fn spring<L, S>(friction: L, law: S) -> Result<SpringScene<L, S>, SceneError>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    let slider = SpringSlider {
        stiffness: 1e10,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(RATES[1]),
    };
    slider.steady(friction, law, RATES[0])
}

/// The velocity step with local errors of `tolerance`.
pub(crate) fn velocity_step<L, S>(
    friction: L,
    law: S,
    tolerance: f64,
) -> Result<VelocityStep, Box<dyn Error>>
where
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
{
    let mut block = RungeKutta::new(spring(friction.clone(), law)?)?;
    let coefficient = |at: Snapshot<'_, 1>| {
        let state = S::State::from_value(at.states.state(0));
        friction.coefficient(at.slip_rate(0), state.into())
    };
    let before = coefficient(block.snapshot());
    let mut peak = before;
    let mut slide_until = |time| -> Result<f64, Failure> {
        let observe = &mut |at: Snapshot<'_, 1>| peak = peak.max(coefficient(at));
        Adaptive::new(tolerance).run(&mut block, time, observe)?;
        Ok(coefficient(block.snapshot()))
    };
    let (evolving, steady) = (slide_until(1.0)?, slide_until(100.0)?);
    Ok(VelocityStep {
        before,
        peak,
        evolving,
        steady,
    })
}

/// The paper's slider until shortly after its first slip.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Sliding {
    /// When the middle of the bottom first slides at 1e-4 m/s \[s\].
    pub(crate) first_slip_time: Option<f64>,
    /// Its displacement in the end \[m\].
    pub(crate) displacement_end: f64,
    /// The largest slip rate on the bottom [m/s].
    pub(crate) peak_slip_rate: f64,
    /// Steps in which the coupling fell back on the fixed point.
    pub(crate) fallbacks: usize,
}

/// The paper's slider on a bottom with the laws `(friction, law)`, from the state `initial`, with
/// `steps` steps in the whole 15 s, of which it runs through 10.5 s.
pub(crate) fn slide<L, S>(
    refinements: usize,
    steps: usize,
    (friction, law, initial): (L, S, S::State),
    coupling: impl Coupling + 'static,
) -> Result<Sliding, Box<dyn Error>>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let body = Slider {
        refinements,
        ..Slider::default()
    };
    let space = body.space()?;
    let scene = body
        .scene(&space)?
        .with_friction(&Slider::bottom(&space)?, friction, NORMAL_STRESS)
        .with_state(law, initial);
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?
        .with_coupling(coupling)
        .with_state_update(StateUpdate::Midpoint);

    let centre = Slider::centre(&space).ok_or("the mesh has no vertex at (2.5, 0)")?;
    let mut slips = Events::new(SLIP, SLIP);
    let (mut peak_slip_rate, mut fallbacks) = (0.0, 0);
    let taken = (0.7 * steps as f64).ceil() as usize;
    simulation.run(taken, END / steps as f64, &mut |at| {
        slips.record(at.time, at.velocity[centre].norm());
        peak_slip_rate = f64::max(peak_slip_rate, at.max_slip_rate());
        fallbacks += usize::from(at.report.fell_back);
    })?;
    Ok(Sliding {
        first_slip_time: slips.times().first().copied(),
        displacement_end: simulation.snapshot().displacement[centre][0],
        peak_slip_rate,
        fallbacks,
    })
}
