//! The set-up of the slider: the steady state of a law, and the path of the load point.

#[path = "../../own_laws/perrin_rice_zheng.rs"]
mod perrin_rice_zheng;

use stickslip::SceneError;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::state::{Dieterich, Discontinuous, StateError, StateVariable};

use super::{RUINA, SLIP_DISTANCE, stepped};
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
                matches!(
                    error,
                    Some(StateError::Value {
                        what: "slip rate [m/s]",
                        ..
                    })
                ),
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

/// Whatever follows, the first thing wrong is named, and the path stays what it was before.
#[test]
fn load_paths_that_go_back_in_time_are_refused() -> Outcome {
    let path = || LoadPath::steady(1e-6).then(10.0, 2e-6);
    let [time, end, velocity] = ["time", "end of a ramp", "velocity"];
    for (wrong, name, value) in [
        (path().then(9.0, 0.0), time, 9.0),
        (path().then(-1.0, 0.0), time, -1.0),
        (path().then(f64::INFINITY, 0.0), time, f64::INFINITY),
        (path().then(f64::NAN, 0.0), time, f64::NAN),
        (path().then(11.0, f64::NAN), velocity, f64::NAN),
        (path().ramp(20.0, 20.0, 1.0), end, 20.0),
        (path().ramp(20.0, 15.0, 1.0), end, 15.0),
        (path().ramp(20.0, f64::NAN, 1.0), end, f64::NAN),
        (path().ramp(20.0, f64::INFINITY, 1.0), end, f64::INFINITY),
        (path().ramp(9.0, 12.0, 1.0), time, 9.0),
        (path().ramp(f64::NAN, 12.0, 1.0), time, f64::NAN),
        (path().ramp(20.0, 20.0 + 1e-14, f64::MAX), end, 20.0 + 1e-14),
        (
            path().ramp(20.0, 30.0, f64::INFINITY),
            velocity,
            f64::INFINITY,
        ),
    ] {
        let wrong = wrong.then(100.0, 0.0).ramp(200.0, 200.0, 0.0);
        let slider = SpringSlider {
            load: wrong.clone(),
            ..stepped(1e9)
        };
        let errors = [
            wrong.validate().err(),
            slider.steady(FRICTION, AGING, 1e-6).err(),
        ];
        for error in errors {
            let Some(SceneError::Value {
                what, value: found, ..
            }) = error
            else {
                return Err(format!("{wrong:?}: {error:?}").into());
            };
            assert!(what.starts_with(name), "{wrong:?}: {what}");
            assert_eq!(found.to_bits(), value.to_bits());
        }
        assert_eq!(wrong.position(1e3), path().position(1e3));
    }
    assert!(
        LoadPath::steady(f64::NAN)
            .then(1.0, 0.0)
            .validate()
            .is_err()
    );
    let right = path().then(10.0, 0.0).ramp(10.0, 20.0, 1.0);
    assert_eq!(right.validate(), Ok(()));
    Ok(())
}
