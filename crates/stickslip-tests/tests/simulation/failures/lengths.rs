//! Fields, matrices and lists of lengths that do not fit.

use nalgebra::Vector1;
use stickslip::fem::{elasticity, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::solvers::SolveError;
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Contact, MultigridSolver, Scene, SceneError,
    Simulation, StepError, Tnnmg,
};

use super::{
    ALPHA, COULOMB, aging, body_error, contact_error, coulomb, error_of, one_line, spring,
};
use crate::Outcome;
use crate::common::body;

/// The part that has the wrong length, and the two lengths.
fn wrong_length(error: SceneError) -> Result<(&'static str, usize, usize), SceneError> {
    match error {
        SceneError::Length {
            what,
            expected,
            found,
        } => Ok((what, expected, found)),
        other => Err(other),
    }
}

#[test]
fn fields_that_do_not_fit_are_named() -> Outcome {
    let two = || vec![Vector1::new(0.0); 2];
    for (error, part) in [
        (error_of(spring().with_load(two()))?, "load"),
        (
            error_of(spring().with_load(vec![Vector1::new(0.0)]).with_load(two()))?,
            "load",
        ),
        (
            error_of(spring().with_displacement(two()))?,
            "initial displacement",
        ),
        (error_of(spring().with_velocity(two()))?, "initial velocity"),
        (
            error_of(spring().with_acceleration(two()))?,
            "initial acceleration",
        ),
    ] {
        assert_eq!(wrong_length(error)?, (part, 1, 2));
    }
    Ok(())
}

#[test]
fn nodal_data_that_do_not_fit_are_named() -> Outcome {
    let point = || BoundaryPart::point(1.0);
    let stateful = || Contact::new(point(), FRICTION, NORMAL_STRESS);
    for (error, part) in [
        (
            contact_error(Contact::per_vertex(point(), [COULOMB; 2], 1e5))?,
            "friction law",
        ),
        (
            contact_error(Contact::new(point(), COULOMB, vec![1e5; 2]))?,
            "normal stress",
        ),
        (
            contact_error(stateful().with_state_per_vertex([AGING; 2], ALPHA))?,
            "state law",
        ),
        (
            contact_error(stateful().with_state(AGING, vec![ALPHA; 2]))?,
            "initial state",
        ),
        (
            contact_error(aging().with_cohesion(vec![0.0; 2]))?,
            "cohesion",
        ),
        (
            contact_error(coulomb().with_shear_stress(vec![Vector1::new(0.0); 2]))?,
            "shear stress",
        ),
    ] {
        assert_eq!(wrong_length(error)?, (part, 1, 2));
    }
    let error = contact_error(Contact::per_vertex(point(), [COULOMB; 0], 1e5))?;
    assert_eq!(wrong_length(error)?, ("friction law", 1, 0));
    Ok(())
}

#[test]
fn boundary_parts_whose_lists_differ_are_named() -> Outcome {
    let odd = |weights: usize, points: usize, normals: usize| BoundaryPart {
        vertices: vec![0],
        weights: vec![1.0; weights],
        points: vec![[0.0; 3]; points],
        normals: vec![[0.0, 1.0, 0.0]; normals],
        axes: Vec::new(),
        opposite: None,
        dimension: 2,
        mesh: None,
    };
    for (part, found) in [
        (odd(0, 0, 0), 0),
        (odd(2, 0, 0), 2),
        (odd(1, 2, 1), 2),
        (odd(1, 1, 3), 3),
    ] {
        let held = spring().fix(&part, Components::NONE);
        assert_eq!(wrong_length(error_of(held)?)?, ("held boundary", 1, found));
        let moved = spring().prescribe_velocity(&part, Components::NONE, |_| [0.0]);
        assert_eq!(
            wrong_length(error_of(moved)?)?,
            ("moved boundary", 1, found)
        );
        let error = contact_error(Contact::new(part, COULOMB, 1e5))?;
        assert_eq!(wrong_length(error)?, ("contact", 1, found));
    }
    Ok(())
}

#[test]
fn matrices_of_another_mesh_are_named() -> Outcome {
    let paper = body(1);
    let (coarse, fine) = (body(0).space()?, paper.space()?);
    let stiffness = || elasticity(&fine, &paper.elastic);
    let other = || mass(&coarse, 5e3);
    let scene = Scene::new(stiffness()?).with_mass(other()?);
    assert_eq!(wrong_length(body_error(scene)?)?, ("mass matrix", 33, 12));
    let fitting = Scene::new(stiffness()?).with_viscosity(mass(&fine, 1.0)?);
    let error = body_error(fitting.with_viscosity(other()?))?;
    assert_eq!(wrong_length(error)?, ("viscosity matrix", 33, 12));
    Ok(())
}

/// A hierarchy of another mesh is of no use for the equilibrium, nor for a step.
#[test]
fn a_hierarchy_of_another_mesh_is_named() -> Outcome {
    let (fine, finer) = (body(1).space()?, body(2).space()?);
    let stiffness = elasticity(&fine, &body(1).elastic)?;
    let solver = MultigridSolver::new(finer.hierarchy().prolongations());
    let error = body_error(Scene::new(stiffness).in_equilibrium(solver))?;
    assert!(
        matches!(
            error,
            SceneError::Equilibrium(SolveError::SizeMismatch { .. })
        ),
        "{error}"
    );
    let solver = Tnnmg::new(finer.hierarchy().prolongations());
    let mut body = Simulation::new(body(1).scene(&fine)?, BackwardEuler, solver)?;
    let failure = one_line(body.step(1e-3).err().ok_or("a step")?)?;
    assert!(
        matches!(
            failure.cause,
            StepError::Solver(SolveError::SizeMismatch { .. })
        ),
        "{failure}"
    );
    Ok(())
}
