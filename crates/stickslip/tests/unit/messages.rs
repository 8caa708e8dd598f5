//! Errors as one line.

use super::*;
use crate::{ErrorControl, Steps};

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

#[test]
fn a_setting_out_of_range_is_told_with_its_range() {
    let refused = |steps: Steps| steps.validate(0.0).map_err(|error| error.to_string());
    let adaptive = || Steps::adaptive(1e-4);
    let control = |motion| {
        adaptive().with_error_control(ErrorControl {
            motion,
            ..ErrorControl::default()
        })
    };
    for (steps, told) in [
        (
            adaptive().until(-1.0),
            "end must be finite, and not before the present time, is -1",
        ),
        (Steps::adaptive(0.0), "tolerance must be positive, is 0"),
        (
            adaptive().with_first_step(-2.0),
            "first step must be positive, is -2",
        ),
        (
            adaptive().with_max_step(0.0).with_min_step(0.0),
            "largest step must be positive, is 0",
        ),
        (
            adaptive().with_min_step(2.0).with_max_step(1.0),
            "smallest step must be at least 0 and at most the largest step, is 2",
        ),
        (
            control(1.5),
            "weight of the motion must be from 0 to 1, is 1.5",
        ),
    ] {
        assert_eq!(refused(steps), Err(format!("step-size control: {told}")));
    }
    let data = StepError::Data {
        what: "load",
        vertex: 3,
        value: f64::INFINITY,
    };
    assert_eq!(data.to_string(), "load at vertex 3 must be finite, is inf");
}
