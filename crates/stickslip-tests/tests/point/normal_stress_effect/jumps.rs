//! Closed forms: a jump of the normal stress while nothing slides.

use nalgebra::SMatrix;
use stickslip::state::{Discontinuous, LogTheta, Ruina, Theta};
use stickslip::{
    BackwardEuler, Newmark, Point, RateScheme, Scene, Sdirk2, Simulation, StateUpdate,
};

use super::{KAPPA, SLIP_DISTANCE, contact};
use crate::Outcome;

const RUINA: Ruina = Ruina {
    slip_distance: SLIP_DISTANCE,
};
/// From 1 MPa to three times that, down to a tenth of it, and on.
const PATH: [f64; 4] = [1e6, 3e6, 3e5, 7e5];

fn path(time: f64) -> f64 {
    PATH[time.floor() as usize]
}

/// The change of the state along the path.
fn moved(k: usize) -> f64 {
    -KAPPA * (PATH[k] / PATH[0]).ln()
}

/// Neither of these laws changes a state at rest: what is left is `theta (sigma_o/sigma)^kappa`.
#[test]
fn a_jump_multiplies_theta_by_a_power_of_the_normal_stress() -> Outcome {
    let spring = || Scene::new(SMatrix::<f64, 1, 1>::new(1e9));
    type Scheme = fn() -> Box<dyn RateScheme>;
    let methods: [(Scheme, StateUpdate); 3] = [
        (|| Box::new(Newmark::default()), StateUpdate::Midpoint),
        (|| Box::new(BackwardEuler), StateUpdate::BackwardEuler),
        (|| Box::new(Sdirk2), StateUpdate::Midpoint),
    ];
    for (scheme, update) in methods {
        let logarithm = contact(RUINA, LogTheta(2.0), path, Some(KAPPA));
        let mut logarithm = Simulation::new(spring().with_contact(logarithm), scheme(), Point)?
            .with_state_update(update);
        let theta = contact(Discontinuous, Theta(5.0), path, Some(KAPPA));
        let mut theta = Simulation::new(spring().with_contact(theta), scheme(), Point)?
            .with_state_update(update);
        for k in 1..PATH.len() {
            for simulation in [&mut logarithm, &mut theta] {
                simulation.step(1.0)?;
                assert_eq!(simulation.snapshot().max_slip_rate(), 0.0);
            }
            let alpha = logarithm.snapshot().contact(0).state(0);
            assert!((alpha - (2.0 + moved(k))).abs() <= 1e-15 * 8.0, "{alpha}");
            let power = theta.snapshot().contact(0).state(0);
            let exact = 5.0 * moved(k).exp();
            assert!(
                (power / exact - 1.0).abs() <= 1e-15 * 8.0,
                "{power} {exact}"
            );
        }
    }
    Ok(())
}

/// At rest the aging law adds the time: between two halves of the jump at the midpoint, behind the whole of it by
/// backward Euler, at whose end the law's equation holds.
#[test]
fn healing_falls_between_the_halves_of_a_jump() -> Outcome {
    let dt = 1.0;
    for (update, exact) in [
        (
            StateUpdate::Midpoint,
            (5.0 * (0.5 * moved(1)).exp() + dt) * (0.5 * moved(1)).exp(),
        ),
        (StateUpdate::BackwardEuler, 5.0 * moved(1).exp() + dt),
    ] {
        let contact = contact(super::Aging, Theta(5.0), path, Some(KAPPA));
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9)).with_contact(contact);
        let mut simulation =
            Simulation::new(scene, BackwardEuler, Point)?.with_state_update(update);
        simulation.step(dt)?;
        let theta = simulation.snapshot().contact(0).state(0);
        assert!((theta / exact - 1.0).abs() < 1e-14, "{theta} {exact}");
    }
    Ok(())
}
