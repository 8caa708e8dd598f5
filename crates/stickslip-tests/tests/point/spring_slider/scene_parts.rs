//! Parts of a scene that need no mesh: cohesion, normal stress in time, viscosity.

use nalgebra::{SMatrix, Vector1};
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::problems::spring_slider::{
    AGING, FRICTION, SpringScene, SpringSlider, steady_state,
};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, FixedPoint, Monolithic, Newmark, Point, Scene,
    SceneError, Simulation, Steps,
};

use super::agreement::methods_agree;
use super::{implicit, stepped};
use crate::Outcome;

/// Coulomb's friction on 1 m^2.
fn coulomb(normal_stress: f64) -> Contact<Tresca, (), 1> {
    Contact::new(
        BoundaryPart::point(1.0),
        Tresca { coefficient: 0.6 },
        normal_stress,
    )
}

/// The strength is `mu sigma + c`: below it nothing moves, above it the force stays there.
#[test]
fn cohesion_adds_to_the_strength() -> Outcome {
    let (stiffness, pull, stress, cohesion) = (2e6, 1e-3, 1e5, 2.5e4);
    let strength = 0.6 * stress + cohesion;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_contact(coulomb(stress).with_cohesion(cohesion))
        .with_load_history(move |time, load| load[0][0] = stiffness * pull * time);
    let mut block = Simulation::new(scene, BackwardEuler, Point)?;
    let mut slid = 0;
    for _ in 0..100 {
        block.step(0.7)?;
        let at = block.snapshot();
        let drive = stiffness * pull * at.time;
        let force = drive - stiffness * at.displacement[0][0];
        if drive <= strength {
            assert_eq!(at.velocity[0][0], 0.0);
            assert_eq!(at.displacement[0][0], 0.0);
        } else {
            assert!((force - strength).abs() < 1e-15 * stiffness, "{force}");
            slid += 1;
        }
    }
    // 2000 N/s reach 85 kN at 42.5 s, within the 61st step.
    assert_eq!(slid, 100 - 60);
    Ok(())
}

/// Rate and state under cohesion alone: without normal stress the strength knows neither.
#[test]
fn cohesion_needs_no_normal_stress() -> Outcome {
    let (stiffness, cohesion) = (2e6, 2.5e4);
    for eliminated in [true, false] {
        let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 0.0)
            .with_state(AGING, LogTheta(0.0))
            .with_cohesion(cohesion);
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_contact(contact)
            .with_load_history(|time, load| load[0][0] = 2e3 * time);
        let mut block = Simulation::new(scene, BackwardEuler, Point)?;
        if eliminated {
            block.set_coupling(Monolithic::without_fallback());
        } else {
            block.set_coupling(FixedPoint::paper());
        }
        block.run(&Steps::constant(0.7).count(50), |at| {
            let exact = (2e3 * at.time - cohesion).max(0.0) / stiffness;
            assert!((at.displacement[0][0] - exact).abs() < 1e-15, "{exact:e}");
        })?;
    }
    Ok(())
}

/// A normal stress that falls from 1e5 Pa by 2 kPa/s, under a pull that grows by 600 N/s: the block
/// lets go where `600 t = 0.6 (1e5 - 2e3 t)`, at 33.3 s, and balances the force from there on.
#[test]
fn a_falling_normal_stress_lets_the_block_go() -> Outcome {
    let stiffness = 1e6;
    let stress = |time: f64| 1e5 - 2e3 * time;
    let exact = 0.6 * 1e5 / (600.0 + 0.6 * 2e3);
    for steps_a_second in [3_usize, 7, 100] {
        let falling = coulomb(1e5)
            .with_normal_stress_history(move |time, stresses| stresses[0] = stress(time));
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_contact(falling)
            .with_load_history(|time, load| load[0][0] = 600.0 * time);
        let mut block = Simulation::new(scene, BackwardEuler, Point)?;
        let mut first = None;
        let steps = Steps::constant(1.0 / steps_a_second as f64).count(40 * steps_a_second);
        block.run(&steps, |at| {
            let force = 600.0 * at.time - stiffness * at.displacement[0][0];
            assert_eq!(at.contact(0).normal_stress(0), stress(at.time));
            if at.velocity[0][0] == 0.0 {
                assert!(at.time <= exact && at.displacement[0][0] == 0.0);
            } else {
                assert!(at.time > exact);
                first = first.or(Some(at.step));
                let imbalance = force - 0.6 * stress(at.time);
                assert!(imbalance.abs() < 1e-12 * force, "{imbalance:e}");
            }
        })?;
        let expected = (exact * steps_a_second as f64).floor() as usize + 1;
        assert_eq!(first, Some(expected));
    }
    Ok(())
}

/// The slider as it slides steadily at 1 um/s, then under a normal stress that is multiplied with a
/// factor of time.
fn pressed(
    slider: &SpringSlider,
    factor: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Result<SpringScene, SceneError> {
    let (stiffness, load, rate) = (slider.stiffness, slider.load.clone(), 1e-6);
    let state = steady_state(&AGING, rate)?;
    let strength = slider.normal_stress * FRICTION.coefficient(rate, state);
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, slider.normal_stress)
        .with_state(AGING, state)
        .with_normal_stress_history(move |time, stress| stress[0] *= factor(time));
    let stretch = (strength + slider.damping * rate) / stiffness;
    Ok(Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(slider.damping))
        .with_contact(contact)
        .with_load_history(move |time, force| force[0][0] = stiffness * load.position(time))
        .with_displacement(vec![Vector1::new(-stretch)])
        .with_velocity(vec![Vector1::new(rate)]))
}

/// The history starts from the stress of the contact, and rate and state feel it too: force
/// balance.
#[test]
fn rate_and_state_follow_a_normal_stress_in_time() -> Outcome {
    let slider = SpringSlider {
        damping: 5e6,
        ..stepped(6e8)
    };
    let factor = |time: f64| 1.0 + 0.1 * (0.7 * time).sin();
    let scene = || pressed(&slider, factor);
    let mut block = implicit(scene()?)?;
    block.run(&Steps::constant(1e-2).count(3000), |at| {
        let contact = at.contact(0);
        let (rate, state) = (at.velocity[0][0], LogTheta(contact.state(0)));
        let strength = 1e6 * factor(at.time) * FRICTION.coefficient(rate, state);
        let spring = slider.stiffness * (slider.load.position(at.time) - at.displacement[0][0]);
        let imbalance = spring - strength - slider.damping * rate;
        assert!(imbalance.abs() < 1e-12 * spring, "{imbalance:e}");
        assert_eq!(contact.normal_stress(0), 1e6 * factor(at.time));
    })?;
    methods_agree(scene)
}

/// A block of mass `m` without a spring, pulled by `F` against friction `mu sigma` and the
/// viscosity `c`: `v = (F - mu sigma)/c (1 - exp(-c t/m))`.
#[test]
fn a_viscous_block_approaches_its_terminal_velocity() -> Outcome {
    let (mass, viscosity, force, stress) = (5e3, 2e4, 9e4, 1e5);
    let terminal = (force - 0.6 * stress) / viscosity;
    let block = || {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(0.0))
            .with_mass(SMatrix::<f64, 1, 1>::new(mass))
            .with_viscosity(SMatrix::<f64, 1, 1>::new(viscosity))
            .with_contact(coulomb(stress))
            .with_load(vec![Vector1::new(force)])
            .with_acceleration(vec![Vector1::new((force - 0.6 * stress) / mass)]);
        Simulation::new(scene, Newmark::default(), Point)
    };
    let error = |steps: usize| -> Outcome<f64> {
        let mut block = block()?;
        let mut worst = 0_f64;
        block.run(&Steps::constant(1.0 / steps as f64).count(steps), |at| {
            let exact = -terminal * f64::exp_m1(-viscosity * at.time / mass);
            worst = worst.max((at.velocity[0][0] - exact).abs());
        })?;
        Ok(worst)
    };
    let (coarse, fine) = (error(100)?, error(200)?);
    assert!(
        (3.9..4.1).contains(&(coarse / fine)),
        "{coarse:e}, {fine:e}"
    );
    let mut block = block()?;
    block.run(&Steps::constant(1e-2).count(1000), |_| ())?;
    let rate = block.snapshot().velocity[0][0];
    assert!(
        (rate - terminal).abs() < 1e-13 * terminal,
        "{rate}, {terminal}"
    );
    Ok(())
}
