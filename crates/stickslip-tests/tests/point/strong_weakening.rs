//! Strong rate weakening on a spring: stick-slip by methods that share nothing but the law.

use stickslip::friction::{FrictionLaw, StrongRateWeakening};
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{LoadPath, SpringScene, SpringSlider, steady_state};
use stickslip::state::{Psi, StateLaw};
use stickslip::{
    ErrorControl, GeneralizedAlpha, Point, Run, RungeKutta, SceneError, Simulation, Steps,
};

use crate::Outcome;

const FLASH: StrongRateWeakening = StrongRateWeakening {
    a: 0.01,
    b: 0.014,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.4,
    weakened_friction: 0.2,
    weakening_velocity: 0.1,
};
const NORMAL: f64 = 120e6;
const DAMPING: f64 = 4.624440e6;

/// Pulled at 0.2 m/s, where steady sliding is unstable on a spring below 5.07e7 Pa/m.
fn slider(stiffness: f64) -> SpringSlider {
    SpringSlider {
        stiffness,
        normal_stress: NORMAL,
        mass: 0.0,
        damping: DAMPING,
        load: LoadPath::steady(0.2),
    }
}

fn scene(stiffness: f64, rate: f64) -> Result<SpringScene, SceneError> {
    slider(stiffness).steady(FLASH, FLASH.evolution(), rate)
}

#[test]
fn the_state_of_steady_sliding_is_found() -> Outcome {
    for rate in [1e-12, 1e-6, 0.1, 1.0, 10.0] {
        let Psi(found) = steady_state(&FLASH.evolution(), rate)?;
        assert!((found - FLASH.steady_state(rate).0).abs() < 1e-12);
    }
    Ok(())
}

/// Through two events of 30 MPa, explicit steps of order 5 and certified implicit steps of second order.
#[test]
fn implicit_and_explicit_steps_agree_through_events() -> Outcome {
    let follow = |block: &mut dyn Stepper<1>, steps: Steps| -> Outcome<[f64; 3]> {
        let mut fastest = 0.0_f64;
        block.run(&steps.until(40.0), |at| {
            let own = at.contact(0);
            fastest = fastest.max(own.slip_rate(0));
            // The state relaxes towards steady sliding, and friction is its function.
            let state = Psi(own.state(0));
            let friction = FLASH.coefficient(own.slip_rate(0), state);
            assert!((own.coefficient(0) - friction).abs() < 1e-12);
            assert!(
                FLASH
                    .evolution()
                    .evolution(state, own.slip_rate(0))
                    .is_finite()
            );
        })?;
        let at = block.snapshot();
        Ok([at.contact(0).slip(0), at.contact(0).state(0), fastest])
    };
    let mut explicit = RungeKutta::new(scene(1e7, 0.19)?)?;
    let exact = follow(&mut explicit, Steps::adaptive(1e-9))?;
    // The block sticks and slips: far faster than its load.
    assert!(exact[2] > 1.0, "{exact:?}");
    let mut implicit = Simulation::new(scene(1e7, 0.19)?, GeneralizedAlpha::default(), Point)?;
    let control = ErrorControl::extrapolated(3);
    let found = follow(
        &mut implicit,
        Steps::adaptive(1e-7).with_error_control(control),
    )?;
    for (a, b) in found.into_iter().zip(exact) {
        assert!((a / b - 1.0).abs() < 1e-3, "{found:?} {exact:?}");
    }
    Ok(())
}

/// The critical stiffness at 0.2 m/s, of an independent computation: a disturbance decays above and grows below.
#[test]
fn steady_sliding_is_stable_above_the_critical_stiffness() -> Outcome {
    for (share, stable) in [(1.1, true), (0.9, false)] {
        let mut block = RungeKutta::new(scene(share * 5.073331e7, 0.2001)?)?;
        let mut last = 0.0_f64;
        block.run(&Steps::adaptive(1e-10).until(60.0), |at| {
            if at.time > 50.0 {
                last = last.max((at.contact(0).slip_rate(0) / 0.2).ln().abs());
            }
        })?;
        let disturbance = 0.0005;
        assert_eq!(last < disturbance, stable, "{share} {last:e}");
    }
    Ok(())
}
