//! Data that cannot be added are given once; the rest adds up.

use nalgebra::{SMatrix, Vector1};
use stickslip::solvers::ConjugateGradients;
use stickslip::{Newmark, Point, SceneError, Simulation};

use super::{coulomb, error_of, spring};
use crate::Outcome;

#[test]
fn what_is_given_twice_is_named() -> Outcome {
    let one = || vec![Vector1::new(1.0)];
    let mass = SMatrix::from([[2.0]]);
    let gradients = ConjugateGradients::<1>::default;
    for (scene, part) in [
        (spring().with_mass(mass).with_mass(mass), "mass matrix"),
        (
            spring().with_displacement(one()).with_displacement(one()),
            "initial displacement",
        ),
        (
            spring()
                .with_displacement(one())
                .in_equilibrium(gradients()),
            "initial displacement",
        ),
        (
            spring()
                .in_equilibrium(gradients())
                .with_displacement(one()),
            "initial displacement",
        ),
        (
            spring()
                .in_equilibrium(gradients())
                .in_equilibrium(gradients()),
            "initial displacement",
        ),
        (
            spring().with_velocity(one()).with_velocity(one()),
            "initial velocity",
        ),
        (
            spring().with_acceleration(one()).with_acceleration(one()),
            "initial acceleration",
        ),
    ] {
        let error = error_of(scene)?;
        assert_eq!(error, SceneError::Repeated { what: part });
        assert!(error.to_string().contains(part), "{error}");
    }
    // The first of several is named.
    let scene = spring().with_mass(mass).with_mass(mass);
    let scene = scene.with_velocity(one()).with_velocity(one());
    let what = "mass matrix";
    assert_eq!(error_of(scene)?, SceneError::Repeated { what });
    Ok(())
}

/// Two of each half as large are one: loads, viscosities, contacts.
#[test]
fn what_can_be_added_adds_up() -> Outcome {
    let pull = |share: f64| vec![Vector1::new(share * 5e4)];
    let grow =
        |share: f64| move |time: f64, load: &mut [Vector1<f64>]| load[0][0] = share * 1e5 * time;
    let viscosity = |share: f64| SMatrix::from([[share * 1e4]]);
    let once = spring()
        .with_contact(coulomb())
        .with_viscosity(viscosity(1.0))
        .with_load(pull(1.0))
        .with_load_history(grow(1.0));
    let halves = spring()
        .with_contact(coulomb())
        .with_viscosity(viscosity(0.5))
        .with_load(pull(0.5))
        .with_load_history(grow(0.5))
        .with_viscosity(viscosity(0.5))
        .with_load_history(grow(0.5))
        .with_load(pull(0.5));
    let mut once = Simulation::new(once, Newmark::default(), Point)?;
    let mut halves = Simulation::new(halves, Newmark::default(), Point)?;
    for _ in 0..20 {
        once.step(0.1)?;
        halves.step(0.1)?;
        let (a, b) = (once.snapshot(), halves.snapshot());
        assert!((a.displacement[0] - b.displacement[0]).amax() < 1e-15);
        assert!((a.velocity[0] - b.velocity[0]).amax() < 1e-14);
    }
    // Two contacts of 60 kN each, under 250 kN in the end.
    assert!(once.snapshot().max_slip_rate() > 0.0);
    Ok(())
}
