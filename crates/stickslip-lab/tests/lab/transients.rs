//! Windows that begin in a transient.

use stickslip_lab::{Evolution, Fit, Fitted, Parameter, Record, Warning};

use crate::fits::assert_within;
use crate::{Noise, Outcome, one_state, sequence, times, two_states};

fn warned(found: &Fitted) -> bool {
    let transient = |warning: &Warning| matches!(warning, Warning::Transient { .. });
    found.warnings.iter().any(transient)
}

/// The parameters of friction and machine alone: the truth has no initial stress at the begin of the window.
fn assert_friction_within(found: &Fitted, seed: u64) {
    for estimate in &found.estimates {
        let beginning = matches!(
            estimate.parameter,
            Parameter::InitialState(_) | Parameter::InitialStress
        );
        let error = (estimate.value - estimate.parameter.of(&one_state())).abs();
        assert!(
            beginning || error <= 4.0 * estimate.standard_error,
            "{seed}: {found}"
        );
    }
}

/// Half a second, two and five seconds behind a step, and as long behind a hold, in which the slip rate is below a
/// thousandth of that of the load point.
#[test]
fn a_window_in_a_transient_has_a_warning_and_a_free_beginning_the_truth() -> Outcome {
    let load = sequence()?;
    for law in [Evolution::Aging, Evolution::Slip] {
        let clean = one_state().curve(&[law], &load, &times())?;
        for begin in [50.5, 52.0, 221.0, 265.2, 266.0, 267.0] {
            let mut found = 0;
            for seed in 0..10 {
                let friction = Noise::new(seed).added_to(&clean, 1e-3);
                let record = Record::new(times(), friction)?.window(begin, 700.0);
                let fit = Fit::new(&[law]).with_reference_velocity(1e-6);
                let steady = fit.run(&record, &load)?;
                found += usize::from(warned(&steady));
                let free = fit.with_free_initial_state().run(&record, &load)?;
                assert!(!warned(&free), "{begin}: {free}");
                assert_friction_within(&free, seed);
            }
            assert!(found >= 9, "{law:?} {begin}: {found}");
        }
    }
    Ok(())
}

/// Steady sliding has no warning, nor a beginning that differs from it.
#[test]
fn steady_sliding_has_no_warning() -> Outcome {
    let load = sequence()?;
    for (truth, states) in [(one_state(), 1), (two_states(), 2)] {
        let laws = vec![Evolution::Aging; states];
        let friction = truth.curve(&laws, &load, &times())?;
        let record = Record::new(times(), Noise::new(3).added_to(&friction, 1e-3))?;
        assert!(!warned(&Fit::new(&laws).run(&record, &load)?));
        let free = Fit::new(&laws)
            .with_free_initial_state()
            .run(&record, &load)?;
        assert_within(&free, &truth);
    }
    Ok(())
}

/// Derivatives by differences, of a law of one's own, have the same minimum.
#[test]
fn a_law_of_ones_own_has_the_same_beginning() -> Outcome {
    let load = sequence()?;
    let clean = one_state().curve(&[Evolution::Aging], &load, &times())?;
    let record = Record::new(times(), Noise::new(5).added_to(&clean, 1e-3))?.window(52.0, 300.0);
    let law = |friction: &stickslip_friction::DieterichRuina| -> stickslip_lab::BoxedLaw {
        Box::new(friction.aging())
    };
    let fit = |law| {
        Fit::new(&[law])
            .with_free_initial_state()
            .with_step_offset()
    };
    let one = fit(Evolution::Aging).run(&record, &load)?;
    let other = fit(Evolution::Custom(&law)).run(&record, &load)?;
    for (one, other) in one.estimates.iter().zip(&other.estimates) {
        let difference = (one.value - other.value).abs();
        assert!(difference < 1e-2 * one.standard_error, "{one:?} {other:?}");
    }
    Ok(())
}
