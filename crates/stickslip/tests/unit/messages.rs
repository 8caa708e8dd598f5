//! Errors as one line.

use super::*;

#[test]
fn times_are_short() {
    let times = [0.0, 4240.0 * 1.5e-3, -0.25, 1e9, 1e12, 3e-310];
    let read = times.map(twelve_digits);
    assert_eq!(read, ["0", "6.36", "-0.25", "1000000000", "1e12", "3e-310"]);
}

#[test]
fn a_failure_reads_as_one_line_with_its_numbers() {
    let cause = StepError::NotCoupled {
        iterations: 200,
        change: 4.7e-10,
        tolerance: 1e-10,
    };
    let failure = StepFailure {
        step: 4240,
        time: 4240.0 * 1.5e-3,
        cause,
    };
    assert_eq!(
        failure.to_string(),
        "step 4240 at t = 6.36 s: the fixed-point coupling did not converge in 200 iterations \
         (change 4.700e-10, tolerance 1.000e-10): reduce dt or use `Monolithic`"
    );
}
