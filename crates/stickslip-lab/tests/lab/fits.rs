//! Fits find what made the data.

use stickslip_lab::{
    Evolution, Fit, Fitted, LoadHistory, Parameter, Parameters, Record, StateParameters, Trend,
    Warning,
};

use crate::{Noise, Outcome, STIFFNESS, one_state, sequence, times, two_states};

pub(crate) const AGING: &[Evolution<'_>] = &[Evolution::Aging];

pub(crate) fn record(truth: &Parameters, laws: &[Evolution<'_>], noise: f64) -> Outcome<Record> {
    let friction = truth.curve(laws, &sequence()?, &times())?;
    Ok(Record::new(
        times(),
        Noise::new(7).added_to(&friction, noise),
    )?)
}

/// Every fitted parameter beside the truth, by `relative`; mu0, trend and initial states by that itself.
pub(crate) fn assert_close(found: &Fitted, truth: &Parameters, relative: f64) {
    for estimate in &found.estimates {
        let exact = estimate.parameter.of(truth);
        let scale = match estimate.parameter {
            Parameter::ReferenceFriction
            | Parameter::InitialState(_)
            | Parameter::InitialStress => 1.0,
            _ => exact.abs(),
        };
        let error = (estimate.value - exact).abs();
        assert!(
            error <= relative * scale,
            "{}: {found}\n{truth:?}",
            estimate.parameter
        );
    }
}

/// Every fitted parameter is within four standard errors, which one draw in 16 000 is not.
pub(crate) fn assert_within(found: &Fitted, truth: &Parameters) {
    for estimate in &found.estimates {
        let error = (estimate.value - estimate.parameter.of(truth)).abs();
        assert!(error <= 4.0 * estimate.standard_error, "{found}\n{truth:?}");
    }
}

/// Curves have an error of 1e-9 by the tolerance of a fit, a ten-millionth of `a`.
#[test]
fn exact_data_give_their_parameters_without_a_guess() -> Outcome {
    for law in [Evolution::Aging, Evolution::Slip] {
        for (truth, laws) in [(one_state(), vec![law]), (two_states(), vec![law; 2])] {
            let record = record(&truth, &laws, 0.0)?;
            for fit in [Fit::new(&laws), Fit::new(&laws).with_stiffness(STIFFNESS)] {
                let found = fit.run(&record, &sequence()?)?;
                assert_close(&found, &truth, 2e-5);
                // The rest of the way is below the error of the curve.
                let flat = |warning: &Warning| matches!(warning, Warning::FlatValley { .. });
                assert!(!found.warnings.iter().any(flat), "{found}");
            }
        }
    }
    Ok(())
}

/// Lengths in micrometres instead of metres: the same numbers of steps, and the same `a` and `b`.
#[test]
fn units_do_not_matter() -> Outcome {
    let metres = record(&one_state(), AGING, 1e-3)?;
    let changes = |unit: f64| {
        let load = [
            (50.0, 1e-5),
            (90.0, 3e-6),
            (220.0, 3e-5),
            (235.0, 0.0),
            (265.0, 1e-5),
            (305.0, 0.0),
            (605.0, 1e-5),
        ];
        LoadHistory::new(unit * 1e-6, &load.map(|(time, v)| (time, unit * v)))
    };
    let fit = Fit::new(AGING).with_trend(Trend::Displacement);
    let (one, other) = (
        fit.run(&metres, &changes(1.0)?)?,
        fit.run(&metres, &changes(1e6)?)?,
    );
    for (one, other) in one.estimates.iter().zip(&other.estimates) {
        let unit = match one.parameter {
            Parameter::SlipDistance(_) => 1e6,
            Parameter::Stiffness | Parameter::Trend => 1e-6,
            _ => 1.0,
        };
        assert!(
            (other.value / unit - one.value).abs() <= 1e-7 * one.value.abs(),
            "{other:?}"
        );
        let errors = other.standard_error / unit / one.standard_error;
        assert!((errors - 1.0).abs() < 1e-5, "{errors}");
    }
    assert_eq!(one.steps, other.steps);
    Ok(())
}

/// A trend and an initial state that is not steady, with an outlier of weight 0.
#[test]
fn trends_initial_states_and_weights_are_taken_into_account() -> Outcome {
    let load = sequence()?;
    for (kind, slope) in [(Trend::Time, 2e-5), (Trend::Displacement, 3.0)] {
        let mut truth = Parameters {
            trend: slope,
            ..one_state()
        };
        truth.states[0].initial_state = 0.8;
        let mut friction = truth.curve(AGING, &load, &times())?;
        for (mu, trend) in friction
            .iter_mut()
            .zip(truth.trend_at(kind, &load, &times()))
        {
            *mu += trend;
        }
        friction[500] += 0.1;
        let mut weights = vec![1.0; friction.len()];
        weights[500] = 0.0;
        let record = Record::new(times(), friction)?.with_weights(weights)?;
        let fit = Fit::new(AGING).with_trend(kind).with_free_initial_state();
        let found = fit.run(&record, &load)?;
        assert_close(&found, &truth, 1e-5);
        assert!(found.residuals[500] > 0.0999, "{}", found.residuals[500]);
    }
    Ok(())
}

/// Twice the weights of half of the samples are these samples twice.
#[test]
fn a_weight_is_a_number_of_samples() -> Outcome {
    let load = sequence()?;
    let data = record(&one_state(), AGING, 1e-3)?;
    let mut twice = (Vec::new(), Vec::new());
    let mut weights = Vec::new();
    for (n, (&time, &mu)) in data.times().iter().zip(data.friction()).enumerate() {
        let count = 1 + n % 2;
        weights.push(count as f64);
        for _ in 0..count {
            twice.0.push(time);
            twice.1.push(mu);
        }
    }
    let fit = Fit::new(AGING).with_stiffness(STIFFNESS);
    let weighted = fit.run(&data.with_weights(weights)?, &load)?;
    let repeated = fit.run(&Record::new(twice.0, twice.1)?, &load)?;
    for (one, other) in weighted.estimates.iter().zip(&repeated.estimates) {
        assert!(
            (one.value - other.value).abs() < 1e-5 * one.standard_error,
            "{one:?} {other:?}"
        );
    }
    assert!((weighted.rms / repeated.rms - 1.0).abs() < 1e-9);
    Ok(())
}

/// A window over two steps gives the parameters, and bounds hold.
#[test]
fn windows_and_bounds_hold() -> Outcome {
    let truth = one_state();
    let window = record(&truth, AGING, 0.0)?.window(60.0, 235.0);
    let fit = Fit::new(AGING).with_stiffness(STIFFNESS);
    let long = fit.run(&window, &sequence()?)?;
    // The first step has almost decayed at the begin of the window.
    assert_close(&long, &truth, 0.05);
    let bounded = fit.with_bounds(Parameter::SlipDistance(0), 2e-5, 1e-4);
    let found = bounded.run(&record(&truth, AGING, 0.0)?, &sequence()?)?;
    assert!(
        (found.value(Parameter::SlipDistance(0)) / 2e-5 - 1.0).abs() < 1e-12,
        "{found}"
    );
    assert!(found.warnings.iter().any(|warning| matches!(
        warning,
        Warning::AtBound {
            parameter: Parameter::SlipDistance(0),
            ..
        }
    )));
    let fixed = Fit::new(AGING)
        .with_stiffness(STIFFNESS)
        .with_fixed(Parameter::A, truth.a);
    let found = fixed.run(&record(&truth, AGING, 0.0)?, &sequence()?)?;
    assert_eq!(
        (
            found.value(Parameter::A),
            found.standard_error(Parameter::A)
        ),
        (truth.a, 0.0)
    );
    assert_close(&found, &truth, 1e-5);
    Ok(())
}

/// A fit takes few curves: they cost its time.
#[test]
fn the_work_of_a_fit_is_bounded() -> Outcome {
    let load = sequence()?;
    let one = record(&one_state(), AGING, 1e-3)?;
    let fitted = Fit::new(AGING).with_stiffness(STIFFNESS).run(&one, &load)?;
    assert!(
        fitted.work.integrations <= 60 && fitted.work.steps <= 20_000,
        "{:?}",
        fitted.work
    );
    // A rigid machine costs no more: the method is stable.
    let rigid = Parameters {
        stiffness: 1e7,
        ..one_state()
    };
    let fitted = Fit::new(AGING)
        .with_stiffness(rigid.stiffness)
        .run(&record(&rigid, AGING, 1e-3)?, &load)?;
    assert_within(&fitted, &rigid);
    assert!(fitted.work.steps <= 20_000, "{:?}", fitted.work);
    let laws = [Evolution::Aging; 2];
    let two = record(&two_states(), &laws, 1e-3)?;
    let fitted = Fit::new(&laws).with_stiffness(STIFFNESS).run(&two, &load)?;
    assert!(
        fitted.work.integrations <= 300 && fitted.work.steps <= 60_000,
        "{:?}",
        fitted.work
    );
    Ok(())
}

/// A distance to the minimum far below the standard errors is convergence.
#[test]
fn a_thousand_draws_of_a_velocity_step_are_fitted_from_a_guess() -> Outcome {
    let truth = Parameters {
        a: 0.008,
        states: vec![StateParameters::steady(0.012, 1.5e-5)],
        stiffness: 2000.0,
        ..one_state()
    };
    let guess = Parameters {
        a: 0.012,
        states: vec![StateParameters::steady(0.015, 3e-5)],
        reference_friction: 0.55,
        ..truth.clone()
    };
    let load = LoadHistory::by_displacement(1e-6, &[(0.0, 1e-5)])?;
    let displacements = (-40..=400).map(|n| 0.5e-6 * f64::from(n));
    let times: Vec<f64> = displacements.map(|x| load.time(x)).collect();
    let clean = truth.curve(AGING, &load, &times)?;
    for seed in 0..1000 {
        let record = Record::new(times.clone(), Noise::new(seed).added_to(&clean, 1e-3))?;
        let fit = Fit::new(AGING)
            .with_stiffness(2000.0)
            .with_guess(guess.clone());
        let found = fit.run(&record, &load)?;
        assert!(
            (found.deviation / 1e-3 - 1.0).abs() < 0.25,
            "{seed}: {found}"
        );
    }
    Ok(())
}
