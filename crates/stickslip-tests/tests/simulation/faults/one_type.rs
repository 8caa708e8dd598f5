//! Simulations with matrices of any format are of one type.

use nalgebra::{DMatrix, Vector2};
use stickslip::bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip::fem::{Elastic, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::integrate::Stepper;
use stickslip::reduced::Reduced;
use stickslip::{
    BackwardEuler, BlockMatrix, Components, Condensed, Contact, DenseNewton, Run, RungeKutta,
    Scene, SceneError, Simulation, Steps,
};

use crate::Outcome;

const LAW: Tresca = Tresca { coefficient: 0.6 };

/// A body of 2 m x 1 m on a surface, pulled at a side.
fn body(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let (bottom, side) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[0] == 2.0)?);
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    Ok(Scene::new(elasticity(space, &elastic)?)
        .with_contact(Contact::new(&bottom, LAW, 1e5))
        .prescribe_velocity(&side, Components::X, |_| [1e-3, 0.0]))
}

/// A plane in space, pulled at all of its cells along strike; by explicit steps it needs radiation damping.
fn plane() -> Outcome<PlaneFault<2>> {
    let cells = Rectangles::new(Cells::new([0.0, 4.0], 4)?, Cells::new([0.0, 3.0], 3)?);
    let rock = Medium {
        shear_modulus: 3e7,
        shear_wave_speed: 100.0,
    };
    Ok(PlaneFault::half_space(cells, 60.0, rock, 0.25)?)
}

fn pull(time: f64, load: &mut [Vector2<f64>]) {
    load.fill(Vector2::new(2e4 * time, 0.0));
}

#[test]
fn whole_reduced_and_boundary_integral_bodies_stand_in_one_list() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let whole = body(&space)?;
    let reduced = Reduced::new(&whole).up_to_frequency(0.0);
    let reduced = reduced.or_else(|_| Reduced::new(&whole).for_time_step(1.0))?;
    let plane = plane()?;
    let cells = Scene::new(DMatrix::from(&plane.stiffness()))
        .with_contact(Contact::new(&plane, LAW, 1e5))
        .with_load_history(pull);
    let (scheme, dense) = (BackwardEuler, DenseNewton::new);
    let mut bodies: Vec<Simulation<2>> = vec![
        Simulation::new(reduced.reduce(body(&space)?)?, scheme, dense())?,
        Simulation::new(cells, scheme, dense())?,
        Simulation::new(whole, scheme, Condensed::new())?,
    ];
    for body in &mut bodies {
        body.run(&Steps::constant(0.5).until(20.0), |_| ())?;
        assert!(body.snapshot().max_slip_rate() > 1e-4);
    }
    let slip = |body: &Simulation<2>| body.snapshot().contact(0).slip(0);
    let [reduced, _, whole] = [0, 1, 2].map(|n| slip(&bodies[n]));
    assert!((reduced - whole).abs() < 1e-9 * whole);
    Ok(())
}

#[test]
fn every_way_to_step_stands_in_one_list() -> Outcome {
    let plane = plane()?;
    let explicit = Scene::new(plane.stiffness())
        .with_viscosity(plane.radiation_damping())
        .with_contact(Contact::new(&plane, LAW, 1e5))
        .with_load_history(pull);
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let whole = Simulation::new(body(&space)?, BackwardEuler, Condensed::new())?;
    let mut all: Vec<Box<dyn Stepper<2>>> =
        vec![Box::new(RungeKutta::new(explicit)?), Box::new(whole)];
    for stepper in &mut all {
        stepper.run(&Steps::adaptive(1e-3).until(10.0), |_| ())?;
        assert!(stepper.snapshot().max_slip_rate() > 1e-4);
    }
    Ok(())
}

/// It is named with both formats, and the simulation goes on with the solver that it has.
#[test]
fn a_solver_for_another_format_is_refused() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let made = || -> Outcome<_> {
        Ok(Simulation::new(
            body(&space)?,
            BackwardEuler,
            Condensed::new(),
        )?)
    };
    let (mut body, mut other) = (made()?, made()?);
    let refused = body.set_solver::<DMatrix<f64>>(DenseNewton::new()).err();
    let Some(SceneError::Format {
        solver,
        matrices,
        body: own,
    }) = refused
    else {
        return Err(format!("{refused:?}").into());
    };
    assert!(solver.contains("DenseNewton"), "{solver}");
    assert_eq!([matrices, own], ["DMatrix", "BlockMatrix"]);
    let steps = Steps::constant(0.5).until(5.0);
    body.run(&steps, |_| ())?;
    other.run(&steps, |_| ())?;
    assert_eq!(body.state(), other.state());
    Ok(())
}
