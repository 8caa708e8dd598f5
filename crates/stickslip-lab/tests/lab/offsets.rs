//! The time of velocity steps as a parameter.

use stickslip_lab::{Evolution, Fit, Parameter, Record, Warning};

use crate::fits::{AGING, assert_within};
use crate::{Noise, Outcome, one_state, sequence, times};

/// The record of a sequence whose steps come later than it says \[s\].
fn late(offset: f64, law: Evolution<'_>, noise: f64, seed: u64) -> Outcome<Record> {
    let shifted: Vec<f64> = times().iter().map(|time| time - offset).collect();
    let friction = one_state().curve(&[law], &sequence()?, &shifted)?;
    Ok(Record::new(
        times(),
        Noise::new(seed).added_to(&friction, noise),
    )?)
}

fn warned(found: &stickslip_lab::Fitted) -> Option<(f64, f64)> {
    found.warnings.iter().find_map(|warning| match *warning {
        Warning::StepTime {
            offset,
            standard_error,
        } => Some((offset, standard_error)),
        _ => None,
    })
}

/// Exact data give the offset and all other parameters; the error of curves leaves 1e-5 of the rise of a second.
#[test]
fn an_offset_is_found_with_the_parameters() -> Outcome {
    for law in [Evolution::Aging, Evolution::Slip] {
        for offset in [-0.4, -0.1, 0.0, 0.1, 0.7] {
            let fit = Fit::new(&[law]).with_step_offset();
            let found = fit.run(&late(offset, law, 0.0, 1)?, &sequence()?)?;
            let error = (found.value(Parameter::StepOffset) - offset).abs();
            assert!(error < 1e-4, "{law:?} {offset}: {found}");
            let length = found.value(Parameter::SlipDistance(0)) / 1.2e-5 - 1.0;
            assert!(length.abs() < 1e-3, "{law:?} {offset}: {found}");
            assert_eq!(found.step_offset, found.value(Parameter::StepOffset));
        }
    }
    Ok(())
}

/// The offset is within two standard errors in 95 of 100 draws, and so are the others; fewer than 86 of 100 are found with a
/// probability of 1e-4.
#[test]
fn an_offset_has_its_standard_error() -> Outcome {
    let mut truth = one_state();
    truth.states[0].initial_state = 0.0;
    let mut within = [0; 6];
    for seed in 0..100 {
        let record = late(0.1, Evolution::Aging, 1e-3, seed)?;
        let found = Fit::new(AGING)
            .with_step_offset()
            .run(&record, &sequence()?)?;
        assert_eq!(warned(&found), None, "{found}");
        for (within, estimate) in within.iter_mut().zip(&found.estimates) {
            let exact = match estimate.parameter {
                Parameter::StepOffset => 0.1,
                other => other.of(&truth),
            };
            *within += usize::from((estimate.value - exact).abs() <= 2.0 * estimate.standard_error);
        }
    }
    assert!(within.iter().all(|within| *within >= 86), "{within:?}");
    Ok(())
}

/// Steps that are late by a tenth of a second are no step by which k is wrong in silence: the warning names the offset.
#[test]
fn late_steps_are_warned_of() -> Outcome {
    for offset in [-0.1, 0.1] {
        let record = late(offset, Evolution::Aging, 1e-3, 3)?;
        let found = Fit::new(AGING).run(&record, &sequence()?)?;
        let (seen, _) = warned(&found).ok_or(format!("{offset}: {found}"))?;
        assert!((seen / offset - 1.0).abs() < 0.5, "{offset} {seen}");
        assert!(found.to_string().contains("peak behind the steps"));
        // The offset is known then.
        let fixed = Fit::new(AGING).with_fixed(Parameter::StepOffset, offset);
        let found = fixed.run(&record, &sequence()?)?;
        assert_within(&found, &one_state());
        assert_eq!((warned(&found), found.step_offset), (None, offset));
    }
    let found = Fit::new(AGING).run(&late(0.0, Evolution::Aging, 1e-3, 3)?, &sequence()?)?;
    assert_eq!(warned(&found), None, "{found}");
    Ok(())
}
