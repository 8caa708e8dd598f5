//! Fields of wrong lengths, and values that are no numbers.

use nalgebra::{SMatrix, Vector1};
use stickslip::fem::mass;
use stickslip::friction::Tresca;
use stickslip::problems::AGING;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::tnnmg::SolveError;
use stickslip::{BackwardEuler, Patch, Scene, SceneError, Simulation, Tnnmg};

use crate::common::{Outcome, body};
use crate::{ALPHA, NAN, aging_spring, body_error, error_of, one_line, spring};

/// The first word of the part that has the wrong length, and the two lengths.
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
fn lengths_that_do_not_fit_are_named() -> Outcome {
    let two = || vec![Vector1::new(0.0); 2];
    let cases = [
        (error_of(spring().with_load(two()))?, "load"),
        (
            error_of(spring().with_displacement(two()))?,
            "initial displacement",
        ),
        (error_of(spring().with_velocity(two()))?, "initial velocity"),
        (
            error_of(spring().with_acceleration(two()))?,
            "initial acceleration",
        ),
        (
            error_of(spring().with_friction::<Tresca>(
                Patch::point(1.0),
                vec![Tresca { coefficient: 0.6 }; 2],
                1e5,
            ))?,
            "friction law",
        ),
        (
            error_of(spring().with_friction(
                Patch::point(1.0),
                Tresca { coefficient: 0.6 },
                vec![1e5; 2],
            ))?,
            "normal stress",
        ),
        (
            error_of(aging_spring().with_state::<Dieterich>(vec![AGING; 2], ALPHA))?,
            "state law",
        ),
        (
            error_of(aging_spring().with_state(AGING, vec![ALPHA; 2]))?,
            "initial state",
        ),
    ];
    for (error, part) in cases {
        assert_eq!(wrong_length(error)?, (part, 1, 2));
    }
    let weights = Patch {
        vertices: vec![0],
        weights: vec![1.0; 2],
    };
    let error = error_of(spring().with_friction(weights, Tresca { coefficient: 0.6 }, 1e5))?;
    assert_eq!(wrong_length(error)?, ("frictional boundary", 1, 2));

    let (coarse, fine) = (body(0).space()?, body(1).space()?);
    let scene = body(1).scene(&fine)?.with_mass(mass(&coarse, 5e3)?);
    assert_eq!(wrong_length(body_error(scene)?)?, ("mass matrix", 33, 12));
    let solver = Tnnmg::new(body(2).space()?.hierarchy().prolongations());
    let made = Simulation::new(body(1).scene(&fine)?, BackwardEuler, solver);
    let error = one_line(made.err().ok_or("a hierarchy of another mesh")?)?;
    assert!(matches!(
        error,
        SceneError::Solver(SolveError::SizeMismatch { .. })
    ));
    Ok(())
}

#[test]
fn values_that_are_none_are_named() -> Outcome {
    let one = |value| vec![Vector1::new(value)];
    for value in [NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let cases = [
            (error_of(spring().with_load(one(value)))?, "load"),
            (
                error_of(spring().with_displacement(one(value)))?,
                "initial displacement",
            ),
            (
                error_of(spring().with_velocity(one(value)))?,
                "initial velocity",
            ),
            (
                error_of(spring().with_acceleration(one(value)))?,
                "initial acceleration",
            ),
            (
                error_of(spring().with_mass(SMatrix::from([[value]])))?,
                "mass matrix",
            ),
            (
                error_of(Scene::new(SMatrix::from([[value]])))?,
                "stiffness matrix",
            ),
            (
                error_of(aging_spring().with_state(AGING, LogTheta(value)))?,
                "initial state",
            ),
            (
                error_of(spring().with_friction(
                    Patch::point(1.0),
                    Tresca { coefficient: 0.6 },
                    value,
                ))?,
                "normal stress",
            ),
            (
                error_of(spring().with_friction(
                    Patch::point(value),
                    Tresca { coefficient: 0.6 },
                    1e5,
                ))?,
                "frictional boundary",
            ),
        ];
        for (error, part) in cases {
            let SceneError::Value { what, position, .. } = error else {
                return Err(error.into());
            };
            assert_eq!((what, position), (part, 0));
        }
    }
    let error =
        error_of(spring().with_friction(Patch::point(-1.0), Tresca { coefficient: 0.6 }, 1e5))?;
    assert!(matches!(error, SceneError::Value { value: -1.0, .. }));
    Ok(())
}
