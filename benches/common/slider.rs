//! The paper's slider at the beginning of what is measured of it.

use std::error::Error;

use nalgebra::SVector;
use stickslip::fem::{P1, body_force, elasticity, lumped_mass, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider, load_velocity,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, CentralDifferences, Condensed, Diagonal, FixedPoint,
    InterfacePotential, Monolithic, Newmark, NonsmoothSolver, Scene, SceneError, Simulation,
    Staggered, StateUpdate, Stepper, Tnnmg,
};

use super::{Begun, TIME_STEP};

type Body = Scene<BlockMatrix<2>, DieterichRuina, Dieterich, 2>;
type Motion = Simulation<BlockMatrix<2>, DieterichRuina, Dieterich, Newmark, 2>;
type Solver =
    Box<dyn NonsmoothSolver<BlockMatrix<2>, InterfacePotential<DieterichRuina, Dieterich>, 2>>;

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
    fn motion(&self, body: Body, space: &P1<2>) -> Result<Motion, SceneError> {
        let motion = Simulation::new(body, Newmark::default(), (self.solver)(space))?;
        Ok(if self.monolithic {
            motion.with_coupling(Monolithic::default())
        } else {
            motion.with_coupling(FixedPoint::paper())
        })
    }
}

fn tnnmg(space: &P1<2>) -> Tnnmg<2> {
    Tnnmg::new(space.hierarchy().prolongations())
}

fn slider(refinements: usize) -> Slider {
    Slider {
        refinements,
        ..Slider::default()
    }
}

/// The body with its friction, at rest.
fn body(slider: &Slider, space: &P1<2>) -> Result<Body, SceneError> {
    Ok(slider
        .scene(space)?
        .with_friction(&Slider::bottom(space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
}

/// After these the state has forgotten its start.
const FIRST_STEPS: usize = 5;

/// The body sticks and is loaded.
pub(crate) fn sticking(method: &Method, level: usize) -> Begun<2> {
    let slider = slider(level);
    let space = slider.space()?;
    let body = body(&slider, &space)?.balanced_by(&mut tnnmg(&space))?;
    let mut motion = method.motion(body, &space)?;
    motion.run(FIRST_STEPS, TIME_STEP, &mut |_| ())?;
    Ok(Box::new(motion))
}

/// The step of the explicit scheme, 2 % below its limit \[s\].
pub(crate) fn small_step(level: usize) -> f64 {
    6e-3 / f64::from(1 << level)
}

/// By central differences, with a lumped mass.
pub(crate) fn sticking_explicitly(level: usize) -> Begun<2> {
    let slider = slider(level);
    let space = slider.space()?;
    let body = body(&slider, &space)?
        .with_mass(lumped_mass(&space, slider.density)?)
        .balanced_by(&mut tnnmg(&space))?;
    let mut motion = Simulation::new(body, CentralDifferences, Diagonal::new())?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint);
    motion.run(FIRST_STEPS, small_step(level), &mut |_| ())?;
    Ok(Box::new(motion))
}

/// The motion at 0.7 of the whole time: all of the bottom slides.
pub(crate) struct Sliding {
    displacement: Vec<SVector<f64, 2>>,
    velocity: Vec<SVector<f64, 2>>,
    acceleration: Vec<SVector<f64, 2>>,
    log_theta: Vec<LogTheta>,
}

impl Sliding {
    pub(crate) fn new(level: usize) -> Result<Self, Box<dyn Error>> {
        let slider = slider(level);
        let space = slider.space()?;
        let mut motion = CONDENSED.motion(body(&slider, &space)?, &space)?;
        motion.run(
            (0.7 * END / TIME_STEP).round() as usize,
            TIME_STEP,
            &mut |_| (),
        )?;
        let at = motion.snapshot();
        Ok(Self {
            displacement: at.displacement.to_vec(),
            velocity: at.velocity.to_vec(),
            acceleration: at.acceleration.to_vec(),
            log_theta: (0..at.frictional.len())
                .map(|k| LogTheta(at.states.state(k)))
                .collect(),
        })
    }

    /// Goes on, the top at the velocity it has from `END / 4` on.
    pub(crate) fn go_on(&self, method: &Method, level: usize) -> Begun<2> {
        let slider = slider(level);
        let space = slider.space()?;
        let (bottom, top) = (Slider::bottom(&space)?, space.trace(|x| x[1] == 1.0)?);
        let weight = SVector::from([0.0, -slider.density * slider.gravity]);
        let body = Scene::new(elasticity(&space, &slider.elastic)?)
            .with_mass(mass(&space, slider.density)?)
            .with_load(body_force(&space, |_| weight))
            .hold(&bottom, [false, true])
            .move_at(&top, [true, true], |_| [load_velocity(END), 0.0])
            .with_friction(&bottom, FRICTION, NORMAL_STRESS)
            .with_state(AGING, self.log_theta.clone())
            .with_displacement(self.displacement.clone())
            .with_velocity(self.velocity.clone())
            .with_acceleration(self.acceleration.clone());
        let mut motion = method.motion(body, &space)?;
        motion.step(TIME_STEP)?;
        Ok(Box::new(motion))
    }
}
