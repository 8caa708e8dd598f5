//! The paper's slider with a choice of parts, and what several tests read of a run.

pub(crate) mod onsets;
pub(crate) mod reference;

use stickslip::fem::P1;
use stickslip::friction::FrictionLaw;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::{LogTheta, Reads, StateLaw};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, Contact, FixedPoint, Newmark, NonsmoothSolver, RateScheme,
    Simulation, Snapshot, StateUpdate, Tnnmg,
};

use crate::Outcome;

/// The slider in motion.
pub(crate) type Sliding = Simulation<2>;

/// The time step of `N = 1e4` [s].
pub(crate) const STEP: f64 = END / 1e4;

/// The velocity solvers that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Solver {
    Tnnmg,
    GaussSeidel,
    Condensed,
}

impl Solver {
    pub(crate) const ALL: [Self; 3] = [Self::Tnnmg, Self::GaussSeidel, Self::Condensed];

    pub(crate) fn on<const C: usize, const D: usize>(
        self,
        space: &P1<D>,
    ) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        match self {
            Self::Tnnmg => Box::new(Tnnmg::new(space.transfers())),
            Self::GaussSeidel => Box::new(BlockGaussSeidel::new()),
            Self::Condensed => Box::new(stickslip::Condensed::new()),
        }
    }
}

/// The paper's body with as many refinements.
pub(crate) fn body(refinements: usize) -> PippingSlider {
    PippingSlider {
        refinements,
        ..PippingSlider::default()
    }
}

/// The vertex at which histories are recorded.
pub(crate) fn centre(space: &P1<2>) -> Outcome<usize> {
    PippingSlider::centre(space).ok_or_else(|| "no vertex at (2.5, 0)".into())
}

/// A body on a frictional bottom, rate and state paired as in the paper, all other choices open.
pub(crate) fn slide<L, S>(
    body: &PippingSlider,
    space: &P1<2>,
    (friction, law, initial): (L, S, S::State),
    scheme: impl RateScheme + 'static,
    solver: Solver,
    tolerance: f64,
) -> Outcome<Sliding>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let contact = Contact::new(&PippingSlider::bottom(space)?, friction, NORMAL_STRESS);
    let scene = body
        .scene(space)?
        .with_contact(contact.with_state(law, initial));
    Ok(Simulation::new(scene, scheme, solver.on(space))?
        .with_coupling(FixedPoint::paper())
        .with_state_update(StateUpdate::BackwardEuler)
        .with_absolute_tolerance(tolerance)?)
}

/// The paper's slider: Dieterich's law, Newmark's scheme.
pub(crate) fn paper_slider(
    body: &PippingSlider,
    space: &P1<2>,
    solver: Solver,
    tolerance: f64,
) -> Outcome<Sliding> {
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    slide(body, space, laws, Newmark::default(), solver, tolerance)
}

/// All numbers of a step as bits: displacement, velocity, acceleration, state.
pub(crate) fn bits<const C: usize>(at: &Snapshot<'_, C>) -> Vec<u64> {
    let fields = [at.displacement, at.velocity, at.acceleration];
    let states = at
        .contacts()
        .flat_map(|contact| (0..contact.len()).map(move |k| contact.state(k)));
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
