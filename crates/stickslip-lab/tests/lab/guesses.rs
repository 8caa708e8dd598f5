//! Guesses of single parameters, and bounds of any.

use stickslip_lab::{Evolution, Fit, Fitted, LabError, Parameter, Record, Trend, Warning};

use crate::fits::{AGING, assert_close, record};
use crate::{Outcome, STIFFNESS, one_state, sequence, times, two_states};

/// The parameters at a bound.
fn at_bounds(found: &Fitted) -> Vec<Parameter> {
    let parameters = found.warnings.iter().filter_map(|warning| match *warning {
        Warning::AtBound { parameter, .. } => Some(parameter),
        _ => None,
    });
    parameters.collect()
}

/// A guess of one parameter, half of the truth or twice it, leads to the minimum.
#[test]
fn a_guess_of_one_parameter_leads_to_the_minimum() -> Outcome {
    let load = sequence()?;
    for (truth, states) in [(one_state(), 1), (two_states(), 2)] {
        let laws = vec![Evolution::Aging; states];
        let record = record(&truth, &laws, 0.0)?;
        let parameters = [
            Parameter::A,
            Parameter::B(0),
            Parameter::SlipDistance(0),
            Parameter::SlipDistance(states - 1),
            Parameter::Stiffness,
            Parameter::ReferenceFriction,
        ];
        for parameter in parameters {
            for factor in [0.5, 2.0] {
                let guess = factor * parameter.of(&truth);
                let fit = Fit::new(&laws).with_guess_of(parameter, guess);
                let mut found = fit.run(&record, &load)?.parameters;
                // Two states of one law have no order.
                let states = &mut found.states;
                states.sort_by(|one, two| one.slip_distance.total_cmp(&two.slip_distance));
                for parameter in parameters {
                    let relative = parameter.of(&found) / parameter.of(&truth) - 1.0;
                    assert!(relative.abs() < 2e-5, "{parameter}: {found:?}");
                }
            }
        }
        // Over all of the parameters, too, and not over one that is fixed.
        let fit = Fit::new(&laws)
            .with_guess(truth.clone())
            .with_guess_of(Parameter::A, 1.5 * truth.a)
            .with_stiffness(STIFFNESS)
            .with_guess_of(Parameter::Stiffness, 1.0);
        let found = fit.run(&record, &load)?;
        assert_eq!(found.parameters.stiffness, STIFFNESS);
        assert_close(&found, &truth, 2e-5);
    }
    Ok(())
}

/// Steps that are later by several times their rise, which has no slope left at the times of the history.
#[test]
fn a_guess_of_the_offset_finds_steps_that_are_far() -> Outcome {
    let shifted: Vec<f64> = times().iter().map(|time| time - 6.0).collect();
    let record = Record::new(times(), one_state().curve(AGING, &sequence()?, &shifted)?)?;
    let fit = Fit::new(AGING)
        .with_step_offset()
        .with_guess_of(Parameter::StepOffset, 5.5);
    let found = fit.run(&record, &sequence()?)?;
    assert!((found.step_offset - 6.0).abs() < 1e-4, "{found}");
    Ok(())
}

/// Each parameter at a bound that excludes the truth has its warning, and no other has.
#[test]
fn bounds_that_hold_are_warned_of() -> Outcome {
    let mut truth = one_state();
    truth.trend = 2e-5;
    let load = sequence()?;
    let mut friction = truth.curve(AGING, &load, &times())?;
    let trend = truth.trend_at(Trend::Time, &load, &times());
    friction
        .iter_mut()
        .zip(trend)
        .for_each(|(mu, trend)| *mu += trend);
    let record = Record::new(times(), friction)?;
    let fit = || {
        Fit::new(AGING)
            .with_trend(Trend::Time)
            .with_step_offset()
            .with_free_initial_state()
    };
    assert_eq!(at_bounds(&fit().run(&record, &load)?), []);
    for (parameter, low, high) in [
        (Parameter::A, 0.0091, 0.02),
        (Parameter::B(0), -1.0, 0.0118),
        (Parameter::SlipDistance(0), 1.25e-5, 1e-4),
        (Parameter::Stiffness, 1e3, 1450.0),
        (Parameter::ReferenceFriction, 0.601, 1.0),
        (Parameter::Trend, -1.0, 1e-5),
        (Parameter::StepOffset, 0.1, 0.5),
        (Parameter::InitialState(0), 0.5, 2.0),
        (Parameter::InitialStress, 1e-3, 1.0),
    ] {
        let found = fit()
            .with_bounds(parameter, low, high)
            .run(&record, &load)?;
        assert_eq!(at_bounds(&found), [parameter], "{found}");
        let value = found.value(parameter);
        assert!(
            value == low
                || value == high
                || (value / low).ln().abs().min((value / high).ln().abs()) < 1e-9
        );
    }
    Ok(())
}

#[test]
fn guesses_are_checked() -> Outcome {
    let record = record(&one_state(), AGING, 1e-3)?;
    for (parameter, value) in [
        (Parameter::A, 0.0),
        (Parameter::SlipDistance(0), -1.0),
        (Parameter::Stiffness, f64::INFINITY),
        (Parameter::B(0), f64::NAN),
    ] {
        let found = Fit::new(AGING)
            .with_guess_of(parameter, value)
            .run(&record, &sequence()?);
        let refused = matches!(
            found,
            Err(LabError::Value {
                what: "guess of a parameter",
                ..
            })
        );
        assert!(refused, "{parameter}");
    }
    let second = Fit::new(AGING).with_guess_of(Parameter::B(1), 0.01);
    let found = second.run(&record, &sequence()?);
    assert!(matches!(found, Err(LabError::States { found: 2, .. })));
    Ok(())
}
