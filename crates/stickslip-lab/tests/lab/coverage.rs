//! True parameters are within the standard errors that a fit states.

use stickslip_lab::{Evolution, Fit, Parameters, Record};

use crate::{Noise, Outcome, STIFFNESS, one_state, sequence, times, two_states};

const DRAWS: u64 = 100;

/// The number of draws of noise of 1e-3 by which all fitted parameters are within three standard errors of the truth.
/// Every fit is without a guess, and at least as close to the data as the truth is.
fn covered(truth: &Parameters, laws: &[Evolution<'_>], stiffness_free: bool) -> Outcome<usize> {
    let (load, times) = (sequence()?, times());
    let clean = truth.curve(laws, &load, &times)?;
    let mut covered = 0;
    for seed in 0..DRAWS {
        let data = Noise::new(seed).added_to(&clean, 1e-3);
        let squares: f64 = clean.iter().zip(&data).map(|(x, y)| (x - y).powi(2)).sum();
        let record = Record::new(times.clone(), data)?;
        let mut fit = Fit::new(laws);
        if !stiffness_free {
            fit = fit.with_stiffness(STIFFNESS);
        }
        let found = fit.run(&record, &load)?;
        assert!(
            found.rms.powi(2) * times.len() as f64 <= squares,
            "{seed}: {found}"
        );
        assert!(found.warnings.is_empty(), "{seed}: {found}");
        let within = found.estimates.iter().all(|estimate| {
            let exact = estimate.parameter.of(truth);
            (estimate.value - exact).abs() <= 3.0 * estimate.standard_error
        });
        covered += usize::from(within);
    }
    println!("{laws:?} free {stiffness_free}: {covered}");
    Ok(covered)
}

fn assert_covered(truth: &Parameters, law: Evolution<'_>) -> Outcome {
    for free in [false, true] {
        let laws = vec![law; truth.states.len()];
        let covered = covered(truth, &laws, free)?;
        assert!(covered >= 95, "{laws:?}, stiffness free: {free}: {covered}");
    }
    Ok(())
}

#[test]
fn one_state_is_found_by_the_aging_law() -> Outcome {
    assert_covered(&one_state(), Evolution::Aging)
}

#[test]
fn one_state_is_found_by_the_slip_law() -> Outcome {
    assert_covered(&one_state(), Evolution::Slip)
}

#[test]
fn two_states_are_found_by_the_aging_law() -> Outcome {
    assert_covered(&two_states(), Evolution::Aging)
}

#[test]
fn two_states_are_found_by_the_slip_law() -> Outcome {
    assert_covered(&two_states(), Evolution::Slip)
}
