//! Fits say what the data do not determine.

use stickslip_lab::{Evolution, Fit, Fitted, LoadHistory, Parameter, Parameters, Record, Warning};

use crate::fits::{AGING, assert_within, record};
use crate::{Noise, Outcome, STIFFNESS, one_state, sequence};

fn warned(found: &Fitted, parameter: Parameter) -> bool {
    found.warnings.iter().any(|warning| {
        matches!(warning, Warning::NotDetermined { parameter: other, .. } if *other == parameter)
    })
}

#[test]
fn a_negative_b_is_found() -> Outcome {
    let mut truth = one_state();
    truth.states[0].b = -0.004;
    let found = Fit::new(AGING)
        .with_stiffness(STIFFNESS)
        .run(&record(&truth, AGING, 3e-4)?, &sequence()?)?;
    assert_within(&found, &truth);
    assert!(
        found.value(Parameter::B(0)) < 0.0 && found.warnings.is_empty(),
        "{found}"
    );
    Ok(())
}

/// Without an evolution effect `L` has no meaning, and `b` is zero to within its standard error.
#[test]
fn without_an_evolution_effect_the_slip_distance_is_not_determined() -> Outcome {
    let mut truth = one_state();
    truth.states[0].b = 0.0;
    for law in [Evolution::Aging, Evolution::Slip] {
        let record = record(&truth, &[law], 1e-3)?;
        let fit = Fit::new(&[law]).with_stiffness(STIFFNESS);
        let found = fit.run(&record, &sequence()?)?;
        assert!(warned(&found, Parameter::SlipDistance(0)), "{found}");
        let (difference, error) = found.a_minus_b;
        assert!((difference - truth.a).abs() < 4.0 * error, "{found}");
    }
    Ok(())
}

/// Samples behind every transient determine `a - b` alone.
#[test]
fn steady_levels_determine_a_minus_b_alone() -> Outcome {
    let load = LoadHistory::velocity_steps(&[1e-6, 1e-5, 3e-6, 3e-5], 6e-4)?;
    let truth = one_state();
    let times = load.samples(400);
    let friction = truth.curve(AGING, &load, &times)?;
    let friction = Noise::new(3).added_to(&friction, 1e-3);
    // The last third of the samples of each step.
    let kept = |n: usize| n % 400 >= 266;
    let of = |values: &[f64]| -> Vec<f64> {
        let kept = values.iter().enumerate().filter(|(n, _)| kept(*n));
        kept.map(|(_, value)| *value).collect()
    };
    let record = Record::new(of(&times), of(&friction))?;
    let found = Fit::new(AGING)
        .with_stiffness(STIFFNESS)
        .run(&record, &load)?;
    let (difference, error) = found.a_minus_b;
    let only = |warning: &Warning| matches!(warning, Warning::OnlyDifference { .. });
    assert!(found.warnings.iter().any(only), "{found}");
    assert!(
        (difference - truth.a_minus_b()).abs() < 4.0 * error && error < 3e-4,
        "{found}"
    );
    Ok(())
}

/// Without samples on the rise behind a velocity step, the stiffness is not in the data.
#[test]
fn a_stiffness_that_is_not_in_the_data_has_a_warning() -> Outcome {
    let load = LoadHistory::velocity_steps(&[1e-6, 1e-5, 1e-6], 6e-4)?;
    let stiff = Parameters {
        stiffness: 2e5,
        ..one_state()
    };
    let times = load.samples(300);
    let friction = Noise::new(5).added_to(&stiff.curve(AGING, &load, &times)?, 1e-3);
    let found = Fit::new(AGING).run(&Record::new(times, friction)?, &load)?;
    assert!(warned(&found, Parameter::Stiffness), "{found}");
    assert!((found.value(Parameter::A) - stiff.a).abs() < 4.0 * found.standard_error(Parameter::A));
    Ok(())
}

#[test]
fn a_fit_prints_its_parameters_and_warnings() -> Outcome {
    let mut truth = one_state();
    truth.states[0].b = 0.0;
    let fit = Fit::new(AGING).with_stiffness(STIFFNESS);
    let table = fit
        .run(&record(&truth, AGING, 1e-3)?, &sequence()?)?
        .to_string();
    for part in [
        "one state, aging law",
        "a ",
        "b1",
        "L1",
        " m\n",
        "mu0",
        "a - b",
        "AIC",
    ] {
        assert!(table.contains(part), "{table}");
    }
    assert!(table.contains("warning: L1 is not determined"), "{table}");
    Ok(())
}
