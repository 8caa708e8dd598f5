//! The paper's slider at the beginning of what is measured of it.

use std::error::Error;

use stickslip::fem::P1;
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, CentralDifferences, Condensed, Contact, Diagonal, FixedPoint,
    Monolithic, Newmark, NonsmoothSolver, SceneError, Simulation, Staggered, StateUpdate,
    StepState, Steps, Tnnmg,
};

use super::{Begun, TIME_STEP};

type Motion = Simulation<2>;
type Solver = Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>;

/// Newmark's scheme with a solver, and a coupling that eliminates the state or is the paper's.
#[derive(Clone, Copy)]
pub(crate) struct Method {
    pub(crate) name: &'static str,
    solver: fn(&P1<2>) -> Solver,
    monolithic: bool,
}

pub(crate) const METHODS: [Method; 4] = [
    Method {
        name: "TNNMG, fixed point",
        solver: |space| Box::new(tnnmg(space)),
        monolithic: false,
    },
    Method {
        name: "TNNMG, monolithic",
        solver: |space| Box::new(tnnmg(space)),
        monolithic: true,
    },
    Method {
        name: "Condensed, fixed point",
        solver: |_| Box::new(Condensed::new()),
        monolithic: false,
    },
    CONDENSED,
];
const CONDENSED: Method = Method {
    name: "Condensed, monolithic",
    solver: |_| Box::new(Condensed::new()),
    monolithic: true,
};
pub(crate) const GAUSS_SEIDEL: Method = Method {
    name: "block Gauss-Seidel, fixed point",
    solver: |_| Box::new(BlockGaussSeidel::new()),
    monolithic: false,
};

impl Method {
    fn motion(&self, slider: &PippingSlider) -> Result<Motion, Box<dyn Error>> {
        let space = slider.space()?;
        let body = slider.scene(&space)?.with_contact(bottom(&space)?);
        let motion = Simulation::new(body, Newmark::default(), (self.solver)(&space))?;
        Ok(if self.monolithic {
            motion.with_coupling(Monolithic::default())
        } else {
            motion.with_coupling(FixedPoint::paper())
        })
    }
}

fn tnnmg(space: &P1<2>) -> Tnnmg<2> {
    Tnnmg::new(space.transfers())
}

fn slider(refinements: usize) -> PippingSlider {
    PippingSlider {
        refinements,
        ..PippingSlider::default()
    }
}

/// The paper's friction on the bottom.
fn bottom(space: &P1<2>) -> Result<Contact<DieterichRuina, Dieterich, 2>, SceneError> {
    let contact = Contact::new(&PippingSlider::bottom(space)?, FRICTION, NORMAL_STRESS);
    Ok(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
}

/// After these the state has forgotten its start.
const FIRST_STEPS: usize = 5;

/// The body sticks and is loaded.
pub(crate) fn sticking(method: &Method, level: usize) -> Begun<2> {
    let mut motion = method.motion(&slider(level))?;
    motion.run(&Steps::constant(TIME_STEP).count(FIRST_STEPS), |_| ())?;
    Ok(Box::new(motion))
}

/// The step of the explicit scheme, 2 % below its limit \[s\].
pub(crate) fn small_step(level: usize) -> f64 {
    6e-3 / f64::from(1 << level)
}

/// By central differences, with a lumped mass.
pub(crate) fn sticking_explicitly(level: usize) -> Begun<2> {
    let slider = PippingSlider {
        lumped: true,
        ..slider(level)
    };
    let space = slider.space()?;
    let body = slider.scene(&space)?.with_contact(bottom(&space)?);
    let mut motion = Simulation::new(body, CentralDifferences, Diagonal::new())?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint);
    let steps = Steps::constant(small_step(level)).count(FIRST_STEPS);
    motion.run(&steps, |_| ())?;
    Ok(Box::new(motion))
}

/// The motion at 0.7 of the whole time: all of the bottom slides, and the top keeps its velocity.
pub(crate) struct Sliding {
    level: usize,
    state: StepState<2>,
}

impl Sliding {
    pub(crate) fn new(level: usize) -> Result<Self, Box<dyn Error>> {
        let mut motion = CONDENSED.motion(&slider(level))?;
        let steps = (0.7 * END / TIME_STEP).round() as usize;
        motion.run(&Steps::constant(TIME_STEP).count(steps), |_| ())?;
        let state = motion.state().clone();
        Ok(Self { level, state })
    }

    /// Goes on by another method.
    pub(crate) fn go_on(&self, method: &Method) -> Begun<2> {
        let mut motion = method.motion(&slider(self.level))?;
        motion.restore(&self.state)?;
        motion.step(TIME_STEP)?;
        Ok(Box::new(motion))
    }
}
