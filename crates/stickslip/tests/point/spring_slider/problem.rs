//! What sets the slider up: the steady state of a law, and the path of the load point.

#[path = "../../../../../examples/custom_state_law/law.rs"]
mod perrin_rice_zheng;

use stickslip::problems::{AGING, LoadPath, steady_state};
use stickslip::state::{Dieterich, Discontinuous, StateError, StateVariable};

use super::{RUINA, SLIP_DISTANCE};
use crate::Outcome;
use perrin_rice_zheng::PerrinRiceZheng;

#[test]
fn every_law_has_its_steady_state() -> Outcome {
    let own = PerrinRiceZheng {
        slip_distance: SLIP_DISTANCE,
    };
    for exponent in -15..=2 {
        let rate = 10f64.powi(exponent);
        let near = |value: f64, exact: f64| (value - exact).abs() <= 1e-12 * exact.abs().max(1.0);
        let log = (SLIP_DISTANCE / rate).ln();
        assert!(near(steady_state(&AGING, rate)?.value(), log));
        assert!(near(steady_state(&RUINA, rate)?.value(), log));
        let jump = steady_state(&Discontinuous, rate)?.value() * rate;
        assert!(near(jump, 1.0), "{rate:e}: {jump}");
        let user = steady_state(&own, rate)?.value() * rate / SLIP_DISTANCE;
        assert!(near(user, 2.0), "{rate:e}: {user}");
    }
    for rate in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        for error in [
            steady_state(&AGING, rate).err(),
            steady_state(&Discontinuous, rate).err(),
        ] {
            assert!(
                matches!(error, Some(StateError::NotPositive { .. })),
                "{rate}: {error:?}"
            );
        }
    }
    let law = Dieterich { slip_distance: 0.0 };
    assert!(steady_state(&law, 1e-6).is_err());
    Ok(())
}

/// Simpson's rule is exact on a segment, where the velocity is linear.
#[test]
fn a_load_path_is_the_integral_of_its_velocity() {
    let path = LoadPath::steady(1e-6)
        .then(10.0, 0.0)
        .ramp(17.0, 31.0, 3e-5)
        .then(40.0, -2e-6)
        .ramp(40.0, 45.0, 1e-7);
    let kinks: Vec<f64> = path.kinks().collect();
    assert_eq!(kinks, [10.0, 17.0, 31.0, 40.0, 40.0, 45.0]);
    let mut position = 0.0;
    let mut from = 0.0;
    for to in kinks.iter().copied().chain([100.0]) {
        for part in 0..4 {
            let width = 0.25 * (to - from);
            let left = from + f64::from(part) * width;
            // The velocity is that from the right.
            let end = path.velocity((left + width).next_down());
            position +=
                width / 6.0 * (path.velocity(left) + 4.0 * path.velocity(left + 0.5 * width) + end);
            let given = path.position(left + width);
            assert!(
                (given - position).abs() < 1e-17,
                "{left}: {given:e}, {position:e}"
            );
        }
        from = to;
    }
    assert_eq!(path.velocity(5.0), 1e-6);
    assert_eq!(path.velocity(10.0), 0.0);
    assert_eq!(path.velocity(1e9), 1e-7);
}
