//! The paper's slider with a choice of parts, and what several tests read of a run.
#![allow(dead_code)]

pub(crate) mod reference;

use stickslip::fem::P1;
use stickslip::friction::FrictionLaw;
use stickslip::problems::{AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, FixedPoint, InterfacePotential, Newmark, NonsmoothSolver,
    RateScheme, Simulation, Snapshot, StateUpdate, Stepper, Tnnmg,
};

/// What a test returns that builds scenes and takes steps.
pub(crate) type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A solver for the velocity problems of the slider.
pub(crate) type SliderSolver<L, S> =
    Box<dyn NonsmoothSolver<BlockMatrix<2>, InterfacePotential<L, S>, 2>>;

/// The time step of `N = 1e4` [s].
pub(crate) const STEP: f64 = END / 1e4;

/// The velocity solvers that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Solver {
    Tnnmg,
    GaussSeidel,
    #[cfg(feature = "condensed")]
    Condensed,
}

/// The paper's body with as many refinements.
pub(crate) fn body(refinements: usize) -> Slider {
    Slider {
        refinements,
        ..Slider::default()
    }
}

/// The vertex at which histories are recorded.
pub(crate) fn centre(space: &P1<2>) -> Result<usize, Box<dyn std::error::Error>> {
    Slider::centre(space).ok_or_else(|| "no vertex at (2.5, 0)".into())
}

/// A body on a frictional bottom, rate and state paired as in the paper, all other choices open.
pub(crate) fn slide<L, S, R>(
    body: &Slider,
    space: &P1<2>,
    (friction, law, initial): (L, S, S::State),
    scheme: R,
    solver: Solver,
    tolerance: f64,
) -> Result<Simulation<BlockMatrix<2>, L, S, R, 2>, Box<dyn std::error::Error>>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
    R: RateScheme + 'static,
{
    let scene = body
        .scene(space)?
        .with_friction(&Slider::bottom(space)?, friction, NORMAL_STRESS)
        .with_state(law, initial);
    let solver: SliderSolver<L, S> = match solver {
        Solver::Tnnmg => Box::new(Tnnmg::new(space.hierarchy().prolongations())),
        Solver::GaussSeidel => Box::new(BlockGaussSeidel::new()),
        #[cfg(feature = "condensed")]
        Solver::Condensed => Box::new(stickslip::Condensed::new()),
    };
    Ok(Simulation::new(scene, scheme, solver)?
        .with_coupling(FixedPoint::paper())
        .with_state_update(StateUpdate::BackwardEuler)
        .with_tolerance(tolerance)?)
}

/// The paper's slider: Dieterich's law, Newmark's scheme.
pub(crate) fn paper_slider(
    body: &Slider,
    space: &P1<2>,
    solver: Solver,
    tolerance: f64,
) -> Result<Box<dyn Stepper<2>>, Box<dyn std::error::Error>> {
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let scheme = Newmark::default();
    Ok(Box::new(slide(
        body, space, laws, scheme, solver, tolerance,
    )?))
}

/// All numbers of a step as bits: displacement, velocity, acceleration, state.
pub(crate) fn bits<const C: usize>(at: &Snapshot<'_, C>) -> Vec<u64> {
    let fields = [at.displacement, at.velocity, at.acceleration];
    let states = (0..at.frictional.len()).map(|k| at.states.state(k));
    fields
        .into_iter()
        .flatten()
        .flat_map(|vector| vector.iter().copied().collect::<Vec<f64>>())
        .chain(states)
        .map(f64::to_bits)
        .collect()
}

/// `abs(a - b)` in units of `abs(b)`.
pub(crate) fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / b.abs()
}

/// The largest difference of two fields, component by component.
pub(crate) fn distance<const C: usize>(
    a: &[nalgebra::SVector<f64, C>],
    b: &[nalgebra::SVector<f64, C>],
) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).amax())
        .fold(0.0, f64::max)
}
