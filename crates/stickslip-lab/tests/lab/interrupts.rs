//! Fits that are interrupted.

use std::sync::atomic::{AtomicUsize, Ordering};

use stickslip_lab::{Evolution, Experiment, Fit, Fitted, LabError, Loss, Record, Warning};

use crate::fits::AGING;
use crate::{Noise, Outcome, STIFFNESS, one_state, sequence, times, two_states};

fn noisy(states: usize) -> Outcome<(Record, Vec<Evolution<'static>>)> {
    let laws = vec![Evolution::Aging; states];
    let truth = if states == 1 {
        one_state()
    } else {
        two_states()
    };
    let friction = truth.curve(&laws, &sequence()?, &times())?;
    Ok((
        Record::new(times(), Noise::new(3).added_to(&friction, 1e-3))?,
        laws,
    ))
}

/// The result of a fit that is interrupted at its question number `at`, and the number of its questions.
fn interrupted(fit: &Fit<'_>, record: &Record, at: usize) -> (Result<Fitted, LabError>, usize) {
    let asked = AtomicUsize::new(0);
    let ask = || asked.fetch_add(1, Ordering::Relaxed) >= at;
    let load = sequence();
    let result = match &load {
        Ok(load) => fit.clone().with_interrupt(&ask).run(record, load),
        Err(_) => Err(LabError::NoRecord),
    };
    (result, asked.into_inner())
}

/// At any time: a result that says so, with finite parameters and errors, after one curve, of its own, at most; or none before the first
/// start. Later is not worse, but for the tolerance of curves of starts.
#[test]
fn a_fit_ends_wherever_it_is_interrupted_with_what_it_has() -> Outcome {
    for (states, loss) in [(1, Loss::Squares), (1, Loss::Huber), (2, Loss::Squares)] {
        let (record, laws) = noisy(states)?;
        let fit = Fit::new(&laws).with_loss(loss);
        let (whole, questions) = interrupted(&fit, &record, usize::MAX);
        let whole = whole?;
        assert!(!whole.interrupted);
        // From a guess that is interrupted at once there is the curve of the result alone.
        let guess = fit.clone().with_guess(whole.parameters.clone());
        let one = interrupted(&guess, &record, 0).0?.work;
        assert_eq!(one.integrations, 1);
        let (mut results, mut last) = (0, f64::INFINITY);
        for share in 0..60 {
            let at = questions * share / 60;
            let (found, asked) = interrupted(&fit, &record, at);
            assert_eq!(asked, at + 1, "no question after the answer");
            let found = match found {
                Err(error) => {
                    assert_eq!((error, results), (LabError::Interrupted, 0));
                    continue;
                }
                Ok(found) => found,
            };
            results += 1;
            assert!(found.interrupted && found.steps <= whole.steps);
            let warned = |warning: &Warning| matches!(warning, Warning::Interrupted { .. });
            assert!(found.warnings.iter().any(warned), "{found}");
            assert!(found.to_string().contains("interrupted after"), "{found}");
            for estimate in &found.estimates {
                assert!(estimate.value.is_finite() && !estimate.standard_error.is_nan());
            }
            assert_eq!(found.residuals.len(), record.times().len());
            // Each curve has asked, but that of the result.
            assert!(found.work.integrations <= at + 1, "{at}: {:?}", found.work);
            if loss == Loss::Squares {
                assert!(found.rms < 1.05 * last, "{at}: {} {last}", found.rms);
                last = found.rms;
            }
        }
        assert!(results > 40, "{results}");
        assert!(last < 1.05 * whole.rms || loss == Loss::Huber);
    }
    Ok(())
}

/// Before anything is known, from a guess, with several records, and by a law of one's own.
#[test]
fn every_road_is_interrupted() -> Outcome {
    let (record, _) = noisy(1)?;
    let load = sequence()?;
    let now = || true;
    let fit = Fit::new(AGING).with_interrupt(&now);
    assert!(matches!(
        fit.run(&record, &load),
        Err(LabError::Interrupted)
    ));
    let guess = fit.clone().with_guess(one_state()).run(&record, &load)?;
    assert!(guess.interrupted);
    assert_eq!(guess.parameters.stiffness, STIFFNESS);
    let experiments = [
        Experiment::new(&record, &load),
        Experiment::new(&record, &load),
    ];
    for at in [100, 300, 900] {
        let asked = AtomicUsize::new(0);
        let ask = || asked.fetch_add(1, Ordering::Relaxed) >= at;
        let joint = Fit::new(AGING)
            .with_interrupt(&ask)
            .run_joint(&experiments)?;
        assert!(joint.interrupted && joint.records.iter().all(|record| record.interrupted));
    }
    let own = |friction: &stickslip_friction::DieterichRuina| -> stickslip_lab::BoxedLaw {
        Box::new(friction.aging())
    };
    let (custom, _) = interrupted(&Fit::new(&[Evolution::Custom(&own)]), &record, 1000);
    assert!(custom?.interrupted);
    Ok(())
}

/// A function that is never true changes no bit.
#[test]
fn a_fit_that_is_not_interrupted_has_the_same_bits() -> Outcome {
    let (record, laws) = noisy(1)?;
    let (asked, _) = interrupted(&Fit::new(&laws), &record, usize::MAX);
    let plain = Fit::new(&laws).run(&record, &sequence()?)?;
    assert_eq!(asked?.estimates, plain.estimates);
    Ok(())
}
