//! A clone of a simulation takes the steps of the original, bit for bit, and leaves it alone.

use nalgebra::{SMatrix, SVector};
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::reduced::Reduced;
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, Cholesky, Components, Contact, DenseNewton, GeneralizedAlpha, MultigridSolver,
    NonsmoothSolver, Point, Scene, SceneError, Simulation, StepError, Steps,
};

use crate::Outcome;
use crate::common::{STEP, Solver, bits, body, paper_slider};

/// So little that the slider slides after a second \[Pa\].
const LIGHT: f64 = 0.03 * NORMAL_STRESS;

/// Goes on twice from one simulation: by itself and by a clone that is taken first and goes last.
fn goes_on_alike<const C: usize>(mut original: Simulation<C>, steps: &Steps) -> Outcome {
    original.run(&steps.clone().count(20), |_| ())?;
    let mut branch = original.clone();
    let before = bits(&branch.snapshot());
    original.run(&steps.clone().count(40), |_| ())?;
    assert_eq!(bits(&branch.snapshot()), before);
    assert_ne!(bits(&original.snapshot()), before);
    branch.run(&steps.clone().count(40), |_| ())?;
    assert_eq!(branch.state(), original.state());
    assert_eq!(bits(&branch.snapshot()), bits(&original.snapshot()));
    let mut again = original.clone();
    original.step(STEP)?;
    again.step(STEP)?;
    assert_eq!(again.state(), original.state());
    Ok(())
}

fn fault(space: &P1<2>) -> Outcome<Contact<DieterichRuina, Dieterich, 2>> {
    let bottom = space.trace(|x| x[1] == 0.0)?;
    Ok(Contact::new(&bottom, FRICTION, LIGHT)
        .with_normal_stress_history(|time, stress| stress.fill(LIGHT * (1.0 + 0.1 * time.sin())))
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
}

fn light(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    Ok(body(1).scene(space)?.with_contact(fault(space)?))
}

/// The same body, held at its top under its weight.
fn hanging(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let body = body(1);
    let weight = SVector::from([0.0, -body.density * body.gravity]);
    Ok(Scene::new(elasticity(space, &body.elastic)?)
        .with_mass(mass(space, body.density)?)
        .with_load(body_force(space, |_| weight))
        .fix(&PippingSlider::top(space)?, Components::ALL)
        .with_contact(fault(space)?))
}

#[test]
fn of_each_solver() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    for solver in Solver::ALL {
        let slider = paper_slider(&body, &space, solver, 1e-10)?;
        goes_on_alike(slider, &Steps::constant(STEP))?;
        let slider = Simulation::new(
            light(&space)?,
            GeneralizedAlpha::default(),
            solver.on(&space),
        )?;
        goes_on_alike(slider, &Steps::adaptive(1e-4))?;
    }
    let reduced = Reduced::new(&light(&space)?)
        .for_time_step(STEP)?
        .reduce(light(&space)?)?;
    let solver = DenseNewton::new();
    let slider = Simulation::new(reduced, GeneralizedAlpha::default(), solver)?;
    goes_on_alike(slider, &Steps::constant(STEP))?;
    let slider = SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-5),
    };
    let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    let block = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
    goes_on_alike(block, &Steps::adaptive(1e-6))
}

/// Two simulations of one scene, that starts in an equilibrium which a factor or multigrid finds.
#[test]
fn of_a_scene() -> Outcome {
    let space = body(1).space()?;
    for direct in [true, false] {
        let scene = hanging(&space)?;
        let scene = if direct {
            scene.in_equilibrium(Cholesky::new())
        } else {
            scene.in_equilibrium(MultigridSolver::new(space.transfers()))
        };
        let [mut one, mut other] = [scene.clone(), scene]
            .map(|scene| {
                Simulation::new(
                    scene,
                    GeneralizedAlpha::default(),
                    Solver::Condensed.on(&space),
                )
            })
            .map(|built| built.expect("a scene in order"));
        assert!(one.snapshot().displacement.iter().any(|u| u.norm() > 0.0));
        one.run(&Steps::constant(STEP).count(20), |_| ())?;
        other.run(&Steps::constant(STEP).count(20), |_| ())?;
        assert_eq!(one.state(), other.state());
    }
    Ok(())
}

/// A solver that cannot be cloned.
struct Alone;

impl NonsmoothSolver<SMatrix<f64, 1, 1>, 1> for Alone {
    fn minimize(
        &mut self,
        energy: &Energy<'_, SMatrix<f64, 1, 1>, 1>,
        stopping: &Stopping<'_, SMatrix<f64, 1, 1>>,
        v: &mut [SVector<f64, 1>],
    ) -> Result<SolveReport, SolveError> {
        Point.minimize(energy, stopping, v)
    }
}

#[test]
fn a_solver_that_cannot_be_cloned_is_missed_by_its_first_step() -> Outcome {
    let slider = SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-5),
    };
    let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    let mut block = Simulation::new(scene, GeneralizedAlpha::default(), Alone)?;
    block.step(0.1)?;
    let mut branch = block.clone();
    let failure = branch.step(0.1).err().ok_or("no solver, and a step")?;
    assert_eq!(failure.cause, StepError::Solver(SolveError::NotCloned));
    branch.set_solver(Point)?;
    branch.step(0.1)?;
    block.step(0.1)?;
    assert_eq!(branch.state(), block.state());
    Ok(())
}

/// A solver for the equilibrium that cannot be cloned.
struct Once(Cholesky<2>);

impl stickslip::LinearSolver<BlockMatrix<2>, 2> for Once {
    fn prepare(
        &mut self,
        operator: &BlockMatrix<2>,
        fixed: &[[bool; 2]],
    ) -> Result<(), SolveError> {
        self.0.prepare(operator, fixed)
    }

    fn solve(
        &mut self,
        operator: &BlockMatrix<2>,
        load: &[SVector<f64, 2>],
        x: &mut [SVector<f64, 2>],
    ) -> Result<(), SolveError> {
        self.0.solve(operator, load, x)
    }
}

#[test]
fn an_equilibrium_that_cannot_be_cloned_is_refused() -> Outcome {
    let space = body(1).space()?;
    let scene = hanging(&space)?.in_equilibrium(Once(Cholesky::new()));
    let solver = || Solver::Condensed.on(&space);
    let copy = Simulation::new(scene.clone(), GeneralizedAlpha::default(), solver());
    assert_eq!(
        copy.err(),
        Some(SceneError::Equilibrium(SolveError::NotCloned))
    );
    Simulation::new(scene, GeneralizedAlpha::default(), solver())?;
    Ok(())
}
