//! Wrong input is a typed error with its numbers.

use stickslip_lab::{
    Evolution, Fit, Healing, LabError, LoadHistory, Parameter, Parameters, Record,
};

use crate::{Outcome, one_state, sequence, times};

fn value<T>(result: Result<T, LabError>) -> Option<(&'static str, usize)> {
    match result {
        Err(LabError::Value { what, position, .. }) => Some((what, position)),
        _ => None,
    }
}

#[test]
fn histories_and_records_are_checked() {
    let velocity = "velocity of the load point [m/s]";
    let time = "time of a velocity step [s]";
    let initial = "initial velocity of the load point [m/s]";
    assert_eq!(value(LoadHistory::new(0.0, &[])), Some((initial, 0)));
    assert_eq!(
        value(LoadHistory::new(1.0, &[(1.0, 2.0), (1.0, 3.0)])),
        Some((time, 1))
    );
    assert_eq!(
        value(LoadHistory::new(1.0, &[(1.0, f64::NAN)])),
        Some((velocity, 0))
    );
    assert_eq!(
        value(LoadHistory::by_displacement(1.0, &[(1.0, 0.0)])),
        Some((velocity, 0))
    );
    assert_eq!(
        value(LoadHistory::measured(&[1.0], &[1.0], 0.0, None)),
        Some(("number of samples", 0))
    );
    assert_eq!(
        value(LoadHistory::measured(&[1.0, 1.0], &[1.0, 2.0], 0.0, None)),
        Some(("time [s]", 1))
    );
    assert_eq!(
        value(LoadHistory::measured(&[1.0, 2.0], &[1.0, 1.0], 0.0, None)),
        Some((initial, 0))
    );
    assert_eq!(
        value(LoadHistory::measured(&[1.0, 2.0], &[1.0, 2.0], -1.0, None)),
        Some(("resolution [m]", 0))
    );
    assert_eq!(
        value(Record::new(vec![0.0, -1.0], vec![0.6; 2])),
        Some(("time [s]", 1))
    );
    assert_eq!(
        value(Record::new(vec![0.0, 1.0], vec![0.6, f64::INFINITY])),
        Some(("friction coefficient", 1))
    );
    let length = LabError::Length {
        what: "friction coefficients",
        expected: 1,
        found: 2,
    };
    assert_eq!(Record::new(vec![0.0], vec![0.6; 2]), Err(length));
    let record = Record::new(vec![0.0], vec![0.6]);
    assert_eq!(
        value(record.and_then(|record| record.with_weights(vec![-1.0]))),
        Some(("weight", 0))
    );
}

#[test]
fn fits_are_checked() -> Outcome {
    let load = sequence()?;
    let laws = [Evolution::Aging];
    let record = Record::new(times(), one_state().curve(&laws, &load, &times())?)?;
    let run = |fit: Fit<'_>| fit.run(&record, &load).map(|_| ());
    let fit = || Fit::new(&laws).with_stiffness(1500.0);
    let bound = "lower bound of a parameter";
    assert_eq!(value(run(fit().with_stiffness(0.0))), Some((bound, 0)));
    assert_eq!(
        value(run(fit().with_bounds(Parameter::A, 0.02, 0.01))),
        Some((bound, 0))
    );
    assert_eq!(
        value(run(fit().with_fixed(Parameter::B(0), f64::NAN))),
        Some((bound, 0))
    );
    assert_eq!(
        value(run(fit().with_reference_velocity(-1.0))),
        Some(("reference velocity [m/s]", 0))
    );
    assert!(matches!(
        run(fit().with_fixed(Parameter::B(1), 0.01)),
        Err(LabError::States { found: 2, .. })
    ));
    assert!(matches!(
        run(Fit::new(&[])),
        Err(LabError::States { found: 0, .. })
    ));
    let two = Fit::new(&[Evolution::Slip; 2]).with_guess(one_state());
    assert!(matches!(run(two), Err(LabError::States { found: 1, .. })));
    let few = record.window(40.0, 50.5);
    assert!(matches!(
        fit().run(&few.window(0.0, 43.0), &load),
        Err(LabError::TooFewSamples {
            samples: 4,
            parameters: 4
        })
    ));
    let before = fit().run(&record.window(0.0, 50.0), &load);
    assert!(matches!(
        before,
        Err(LabError::NoVelocityStep { velocity: 1e-6 })
    ));
    let hold = "velocity of the load point at the first sample [m/s]";
    assert_eq!(
        value(fit().run(&record.window(240.0, 400.0), &load)),
        Some((hold, 0))
    );
    // Softer than critical.
    let soft = Parameters {
        stiffness: 100.0,
        ..one_state()
    };
    assert!(matches!(
        run(fit().with_stiffness(100.0).with_guess(soft.clone())),
        Err(LabError::Unstable { .. })
    ));
    assert!(matches!(
        soft.curve(&laws, &load, &times()),
        Err(LabError::Unstable { .. })
    ));
    assert_eq!(
        Healing::of(&record.window(0.0, 230.0), &load),
        Err(LabError::NoHold)
    );
    Ok(())
}

/// With equal slip distances two states are one; without a second effect, too.
#[test]
fn the_critical_stiffness_of_two_states_is_that_of_one() {
    let one = one_state();
    let exact = (0.012 - 0.009) / 1.2e-5;
    assert!((one.critical_stiffness() / exact - 1.0).abs() < 1e-12);
    for (b, length) in [
        ([0.007, 0.005], 1.2e-5),
        ([0.012, 0.0], 7e-5),
        ([0.012, 0.0], 2e-6),
    ] {
        let mut two = one.clone();
        two.states = vec![one.states[0]; 2];
        two.states[0].b = b[0];
        two.states[1].b = b[1];
        two.states[1].slip_distance = length;
        assert!(
            (two.critical_stiffness() / exact - 1.0).abs() < 1e-9,
            "{two:?}"
        );
    }
}

/// Data without a change, and a fit without a parameter.
#[test]
fn fits_of_nothing_are_refused() -> Outcome {
    let load = LoadHistory::new(1e-6, &[(10.0, 1e-5)])?;
    let times: Vec<f64> = (0..100).map(f64::from).collect();
    let constant = Record::new(times.clone(), vec![0.6; 100])?;
    let fit = Fit::new(&[Evolution::Aging]).with_stiffness(1500.0);
    let refused = value(fit.run(&constant, &load));
    assert_eq!(refused, Some(("friction coefficient", 0)));
    let changing = Record::new(
        times.clone(),
        times.iter().map(|t| 0.6 + 1e-4 * t).collect(),
    )?;
    let fit = fit
        .with_fixed(Parameter::A, 0.008)
        .with_fixed(Parameter::B(0), 0.012)
        .with_fixed(Parameter::SlipDistance(0), 1.5e-5)
        .with_fixed(Parameter::ReferenceFriction, 0.6);
    let refused = value(fit.run(&changing, &load));
    assert_eq!(refused, Some(("number of free parameters", 0)));
    Ok(())
}
