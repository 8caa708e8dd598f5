//! The paper's slider through its first slip.

use crate::common::onsets::Onsets;
use std::f64::consts::LN_2;

use stickslip::friction::{FrictionLaw, TwoStates};
use stickslip::problems::pipping_slider::{AGING, END, FRICTION, NORMAL_STRESS, PippingSlider};
use stickslip::state::{KatoTullis, LogTheta, Reads, StateLaw, check_state_law};
use stickslip::{
    Condensed, Contact, Coupling, FixedPoint, Monolithic, Newmark, Simulation, StateUpdate, Steps,
};

use super::{ALPHA, OF_OWN_STATE, OWN_FRICTION, OWN_STATE, PerrinRiceZheng, THETA};
use crate::Outcome;
use crate::common::{body, centre};

/// The slip rate [m/s] that counts as slip.
const SLIP: f64 = 1e-4;

/// The slider until shortly after its first slip.
#[derive(Debug, Clone, Copy)]
struct Sliding {
    /// When the middle of the bottom first slides at 1e-4 m/s [s].
    first_slip_time: Option<f64>,
    /// Its displacement in the end [m].
    displacement_end: f64,
    /// The largest slip rate on the bottom [m/s].
    peak_slip_rate: f64,
    /// Steps in which the coupling fell back on the fixed point.
    fallbacks: usize,
}

/// The slider on a bottom with the laws `(friction, law)`, from the state `initial`, with `steps` steps in the
/// whole 15 s, of which it runs through 10.5 s.
fn slide<L, S>(
    refinements: usize,
    steps: usize,
    (friction, law, initial): (L, S, S::State),
    coupling: impl Coupling + 'static,
) -> Outcome<Sliding>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let body = body(refinements);
    let space = body.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, friction, NORMAL_STRESS)
        .with_state(law, initial);
    let scene = body.scene(&space)?.with_contact(contact);
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?
        .with_coupling(coupling)
        .with_state_update(StateUpdate::Midpoint);

    let centre = centre(&space)?;
    let mut slips = Onsets::new(SLIP, SLIP);
    let (mut peak_slip_rate, mut fallbacks) = (0.0, 0);
    let taken = (0.7 * steps as f64).ceil() as usize;
    let plan = Steps::constant(END / steps as f64)
        .count(taken)
        .with_substeps();
    simulation.run(&plan, |at| {
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

fn first_slip(sliding: &Sliding) -> Result<f64, &'static str> {
    sliding.first_slip_time.ok_or("no slip")
}

const STEPS: usize = 10_000;

/// At rest contacts are as old by both state laws, but half as old in units of steady ones, so that
/// friction is `b ln 2` smaller when it gives way; and at rates above `2L/theta` the own law weakens
/// faster: it may save the slider the `a ln(V theta/2L)` up to the rate that counts as slip. The load
/// grows by some `G V/h`.
#[test]
fn the_slider_gives_way_earlier_by_the_own_state_law() -> Outcome {
    let known = slide(2, STEPS, (FRICTION, AGING, ALPHA), Monolithic::default())?;
    let own = slide(
        2,
        STEPS,
        (OF_OWN_STATE, OWN_STATE, THETA),
        Monolithic::default(),
    )?;
    let loading = 5e7 / 2.6 * 2e-4 / NORMAL_STRESS; // of the coefficient [1/s]
    let least = FRICTION.b * LN_2 / loading;
    let age = first_slip(&known)?;
    let spared = FRICTION.a * (1e-4 * age / OF_OWN_STATE.slip_distance).ln() / loading;
    let earlier = age - first_slip(&own)?;
    assert!(
        earlier > least && earlier < least + spared,
        "{least} < {earlier} < {least} + {spared}"
    );
    Ok(())
}

#[test]
fn the_slider_cannot_tell_a_soft_cutoff() -> Outcome {
    let known = slide(2, STEPS, (FRICTION, AGING, ALPHA), Monolithic::default())?;
    let own = slide(
        2,
        STEPS,
        (OWN_FRICTION, AGING, ALPHA),
        Monolithic::default(),
    )?;
    let difference = (first_slip(&known)? - first_slip(&own)?).abs();
    assert!(difference < 1e-12 * END, "{difference:e}");
    Ok(())
}

/// The same body by the same laws, rate and state at once and in turns.
fn couplings<L, S>(friction: L, law: S, initial: S::State) -> Outcome<[Sliding; 2]>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: Reads<S::State>,
{
    let laws = (friction.clone(), law.clone(), initial);
    let at_once = slide(1, STEPS, laws, Monolithic::default())?;
    let in_turns = slide(1, STEPS, (friction, law, initial), FixedPoint::default())?;
    assert_eq!(at_once.fallbacks, 0);
    let difference = first_slip(&at_once)? - first_slip(&in_turns)?;
    assert!(difference.abs() < 1e-9, "{difference:e}");
    Ok([at_once, in_turns])
}

/// Until it slips; beyond, a step of this law in `theta` may have more than one solution.
#[test]
fn the_couplings_agree_by_the_own_state_law() -> Outcome {
    couplings(OF_OWN_STATE, OWN_STATE, THETA)?;
    Ok(())
}

#[test]
fn the_couplings_agree_through_an_event_by_the_own_friction_law() -> Outcome {
    check_event(couplings(OWN_FRICTION, AGING, ALPHA)?);
    Ok(())
}

fn check_event(runs: [Sliding; 2]) {
    let slipped = runs[0].peak_slip_rate > 1e-2;
    assert!(slipped, "{runs:?}");
    check_agreement(runs);
}

fn check_agreement([at_once, in_turns]: [Sliding; 2]) {
    for (a, b) in [
        (at_once.displacement_end, in_turns.displacement_end),
        (at_once.peak_slip_rate, in_turns.peak_slip_rate),
    ] {
        assert!((a / b - 1.0).abs() < 1e-8, "{at_once:?}, {in_turns:?}");
    }
}

/// The own state law in another variable: `alpha' = exp(-alpha) - (V/2L)^2 exp(alpha)`.
#[derive(Debug, Clone, Copy)]
struct InLogarithm(PerrinRiceZheng);

impl StateLaw for InLogarithm {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.0.slip_distance);
        (-alpha).exp() - rate * rate * alpha.exp()
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.0.slip_distance);
        -(-alpha).exp() - rate * rate * alpha.exp()
    }
}

#[test]
fn the_couplings_agree_through_an_event_in_the_logarithm() -> Outcome {
    let law = InLogarithm(OWN_STATE);
    check_state_law(&law, &[-20.0, -10.0, 0.0, 3.0].map(LogTheta))?;
    let [at_once, in_turns] = couplings(OF_OWN_STATE, law, THETA.into())?;
    check_event([at_once, in_turns]);
    let in_theta = slide(
        1,
        STEPS,
        (OF_OWN_STATE, OWN_STATE, THETA),
        Monolithic::default(),
    )?;
    // The library's, with its solution in closed form.
    let library = stickslip::state::PerrinRiceZheng {
        slip_distance: OWN_STATE.slip_distance,
    };
    let laws = (OF_OWN_STATE, library, THETA.into());
    let closed = slide(1, STEPS, laws, Monolithic::default())?;
    // By the rule of the paper one step takes more than 200 iterations.
    let in_turns = slide(1, STEPS, laws, FixedPoint::accelerated())?;
    check_event([closed, in_turns]);
    assert_eq!(closed.fallbacks, 0);
    for other in [in_theta, closed] {
        let difference = first_slip(&at_once)? - first_slip(&other)?;
        assert!(difference.abs() < 1e-4, "{difference:e}");
    }
    Ok(())
}

#[test]
fn the_couplings_agree_through_an_event_by_the_composite_law() -> Outcome {
    let law = KatoTullis {
        slip_distance: FRICTION.slip_distance,
        aging_velocity: 1e-8,
    };
    check_event(couplings(FRICTION, law, ALPHA)?);
    Ok(())
}

/// From rest it does not age as the others do: the slider begins to slide without an event.
#[test]
fn the_couplings_agree_by_the_law_with_the_stress_rate() -> Outcome {
    let (friction, law) = FRICTION.weakened_by_stress(2.0);
    check_agreement(couplings(friction, law, ALPHA)?);
    Ok(())
}

/// Two states over the same distance are one, also on a body and through an event.
#[test]
fn two_contacts_on_one_part_are_friction_with_two_states() -> Outcome {
    let friction = TwoStates {
        a: FRICTION.a,
        b: [0.4 * FRICTION.b, 0.6 * FRICTION.b],
        reference_friction: FRICTION.reference_friction,
        reference_velocity: FRICTION.reference_velocity,
        slip_distance: [FRICTION.slip_distance; 2],
    };
    let body = body(1);
    let space = body.space()?;
    let centre = centre(&space)?;
    let bottom = PippingSlider::bottom(&space)?;
    let simulation = |parts: &[_]| -> Outcome<Simulation<2>> {
        let scene = parts.iter().fold(body.scene(&space)?, |scene, &part| {
            let contact = Contact::new(&bottom, part, NORMAL_STRESS);
            scene.with_contact(contact.with_state(AGING, ALPHA))
        });
        Ok(Simulation::new(
            scene,
            Newmark::default(),
            Condensed::new(),
        )?)
    };
    let mut one = simulation(&[FRICTION])?;
    let mut two = simulation(&friction.parts())?;
    let taken = (0.7 * STEPS as f64) as usize;
    let mut peak = 0.0_f64;
    let steps = Steps::constant(END / STEPS as f64).count(taken);
    one.run(&steps, |at| peak = peak.max(at.max_slip_rate()))?;
    two.run(&steps, |_| ())?;
    assert!(peak > 1e-2, "{peak:e}");
    let [one, two] = [&one, &two].map(|slider| slider.snapshot().displacement[centre][0]);
    assert!((one / two - 1.0).abs() < 1e-8, "{one:e} {two:e}");
    Ok(())
}
