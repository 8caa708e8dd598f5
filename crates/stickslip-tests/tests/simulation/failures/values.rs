//! Values that are no numbers, or none that make sense.

use nalgebra::{SMatrix, Vector1};
use stickslip::fem::elasticity;
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, Cholesky, Components, Contact, Newmark, Point, Scene, SceneError, Simulation,
    StepError,
};

use super::{
    COULOMB, NAN, body_error, contact_error, coulomb, error_of, free_spring, one_line, spring,
};
use crate::Outcome;
use crate::common::body;

/// A value out of range, and its place.
fn senseless(error: SceneError) -> Result<(&'static str, usize), SceneError> {
    match error {
        SceneError::Value { what, position, .. } => Ok((what, position)),
        other => Err(other),
    }
}

#[test]
fn fields_that_are_no_numbers_are_named() -> Outcome {
    let one = |value| vec![Vector1::new(value)];
    let matrix = |value| SMatrix::from([[value]]);
    for value in [NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (scene, part) in [
            (spring().with_load(one(value)), "load"),
            (
                spring().with_displacement(one(value)),
                "initial displacement",
            ),
            (spring().with_velocity(one(value)), "initial velocity"),
            (
                spring().with_acceleration(one(value)),
                "initial acceleration",
            ),
            (spring().with_mass(matrix(value)), "mass matrix"),
            (spring().with_viscosity(matrix(value)), "viscosity matrix"),
            (Scene::new(matrix(value)), "stiffness matrix"),
            (spring().from_time(value), "initial time"),
        ] {
            assert_eq!(senseless(error_of(scene)?)?, (part, 0));
        }
    }
    Ok(())
}

#[test]
fn contact_data_that_are_no_numbers_are_named() -> Outcome {
    for value in [NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let stateful = Contact::new(BoundaryPart::point(1.0), FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(value));
        for (error, part) in [
            (contact_error(stateful)?, "initial state"),
            (
                contact_error(Contact::new(BoundaryPart::point(1.0), COULOMB, value))?,
                "normal stress",
            ),
            (
                contact_error(Contact::new(BoundaryPart::point(value), COULOMB, 1e5))?,
                "contact",
            ),
            (contact_error(coulomb().with_cohesion(value))?, "cohesion"),
            (
                contact_error(coulomb().with_shear_stress(Vector1::new(value)))?,
                "shear stress",
            ),
        ] {
            assert_eq!(senseless(error)?, (part, 0));
        }
    }
    Ok(())
}

#[test]
fn negative_weights_and_cohesions_are_named() -> Outcome {
    for (error, part) in [
        (
            contact_error(Contact::new(BoundaryPart::point(-1.0), COULOMB, 1e5))?,
            "contact",
        ),
        (contact_error(coulomb().with_cohesion(-1.0))?, "cohesion"),
    ] {
        let SceneError::Value { what, value, .. } = error else {
            return Err(error.into());
        };
        assert_eq!((what, value), (part, -1.0));
    }
    Ok(())
}

/// Of values one a vertex, the position of the wrong one is named.
#[test]
fn values_are_named_with_their_positions() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let count = bottom.vertices().len();
    let odd = |base: f64, value: f64| {
        let mut values = vec![base; count];
        values[3] = value;
        values
    };
    for value in [NAN, f64::INFINITY, -1.0] {
        let contact = Contact::new(&bottom, COULOMB, 1e5).with_cohesion(odd(0.0, value));
        let error = body_error(paper.scene(&space)?.with_contact(contact))?;
        assert_eq!(senseless(error)?, ("cohesion", 3));
    }
    let contact = Contact::new(&bottom, COULOMB, odd(1e5, NAN));
    let error = body_error(paper.scene(&space)?.with_contact(contact))?;
    assert_eq!(senseless(error)?, ("normal stress", 3));
    let states: Vec<LogTheta> = odd(0.0, NAN).into_iter().map(LogTheta).collect();
    let contact = Contact::new(&bottom, FRICTION, 1e5).with_state(AGING, states);
    let error = body_error(paper.scene(&space)?.with_contact(contact))?;
    assert_eq!(senseless(error)?, ("initial state", 3));
    Ok(())
}

/// A normal must have the length one, or none at all.
#[test]
fn normals_of_another_length_are_named() -> Outcome {
    let part = |normal| BoundaryPart {
        vertices: vec![0],
        weights: vec![1.0],
        points: vec![[0.0; 3]],
        normals: vec![normal],
        axes: Vec::new(),
        opposite: None,
        dimension: 2,
        mesh: None,
    };
    for normal in [
        [0.0, 2.0, 0.0],
        [0.0, 1e-3, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, NAN, 0.0],
        [f64::INFINITY, 0.0, 0.0],
    ] {
        let error = contact_error(Contact::new(part(normal), COULOMB, 1e5))?;
        assert_eq!(senseless(error)?, ("contact", 0));
        let error = error_of(spring().fix(part(normal), Components::ALL))?;
        assert_eq!(senseless(error)?, ("held boundary", 0));
    }
    Ok(())
}

/// Data that depend on time are checked at the first time if they matter there.
#[test]
fn data_of_the_first_time_are_named() -> Outcome {
    let turned = |time: f64, stress: &mut [f64]| {
        if time < 1.0 {
            stress[0] = NAN;
        }
    };
    let contact = || coulomb().with_normal_stress_history(turned);
    let error = contact_error(contact())?;
    let SceneError::Start(StepError::Data {
        what: "normal stress",
        vertex: 0,
        value,
    }) = error
    else {
        return Err(error.into());
    };
    assert!(value.is_nan());
    let later = free_spring().with_contact(contact()).from_time(1.0);
    Simulation::new(later, Newmark::default(), Point)?.step(0.5)?;

    let space = body(1).space()?;
    let stiffness = elasticity(&space, &body(1).elastic)?;
    let scene = Scene::new(stiffness)
        .fix(&space.trace(|x| x[1] == 1.0)?, Components::ALL)
        .with_load_history(|time, load| load[5][1] = if time < 1.0 { NAN } else { 0.0 })
        .in_equilibrium(Cholesky::new());
    assert_eq!(senseless(body_error(scene)?)?, ("load", 5));
    Ok(())
}

#[test]
fn tolerances_that_are_none_are_named() -> Outcome {
    for tolerance in [0.0, -1e-10, NAN, f64::INFINITY] {
        let slider = Simulation::new(spring(), Newmark::default(), Point)?;
        let error = slider
            .with_absolute_tolerance(tolerance)
            .err()
            .ok_or("accepted")?;
        let SceneError::Value { what, value, .. } = one_line(error)? else {
            return Err("another error".into());
        };
        assert_eq!((what, value.to_bits()), ("tolerance", tolerance.to_bits()));
    }
    Ok(())
}
