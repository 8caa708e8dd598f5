//! Errors as one line.

use super::*;
use crate::{BoundaryPart, ErrorControl, Limit, LocalError, SceneError, Steps};

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
        place: None,
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
    assert_eq!(
        data.to_string(),
        "load at vertex 3 must be finite, is inf; check functions of with_load_history and with_scaled_load, and plate rates"
    );
}

#[test]
fn a_message_ends_with_its_hint() {
    let limit = Limit::Stability(1e-3);
    let at = |quantity: fn(&mut LocalError)| {
        let mut error = LocalError::default();
        quantity(&mut error);
        error
    };
    let errors = [
        at(|error| error.slip_rate.error = 1.0),
        at(|error| error.state.error = 1.0),
        at(|error| error.slip.error = 1.0),
        at(|error| error.displacement.error = 1.0),
        at(|error| error.motion = 1.0),
    ];
    let too_small = |error, resisted| StepError::StepTooSmall {
        dt: 1e-9,
        error,
        tolerance: 1e-4,
        resisted,
    };
    let not_unique = |shorter| StepError::NotUnique {
        vertex: 1,
        slip_rate: 1e-6,
        dt: 1.0,
        shorter,
    };
    let mut failed = vec![
        StepError::Tension {
            vertex: 1,
            normal_stress: -1.0,
        },
        StepError::Penetration {
            vertex: 1,
            opening: -1.0,
        },
        StepError::NotContracting {
            vertex: 1,
            contraction: 1.5,
            iterations: 7,
            dt: 1.0,
        },
        StepError::Stage {
            vertex: 1,
            time: 1.0,
            slip_rate: 1.0,
            state: 1.0,
            evolution: f64::NAN,
        },
        StepError::Extrapolation { order: 2 },
        StepError::NotCoupled {
            iterations: 200,
            change: 1.0,
            tolerance: 0.1,
        },
        StepError::TooManySteps {
            steps: 1,
            dt: 1.0,
            limit,
        },
        not_unique(true),
        not_unique(false),
        too_small(errors[0], false),
    ];
    failed.extend(errors.map(|error| too_small(error, true)));
    for error in failed {
        let message = error.to_string();
        assert!(
            error.hint().is_some_and(|hint| message.ends_with(hint)),
            "{message}"
        );
    }
    let refused = [
        SceneError::HalfHeld {
            vertex: 1,
            component: 0,
        },
        SceneError::NoBasis { what: "mass" },
        SceneError::Unbalanced {
            vertex: 1,
            slip_rate: 1.0,
            missing: 1.0,
        },
        SceneError::NotSymmetric {
            what: "stiffness matrix",
            products: [1.0, 2.0],
        },
        SceneError::Start(StepError::Tension {
            vertex: 1,
            normal_stress: -1.0,
        }),
    ];
    for error in refused {
        let message = error.to_string();
        assert!(
            error.hint().is_some_and(|hint| message.ends_with(hint)),
            "{message}"
        );
    }
}

#[test]
fn a_failure_names_contact_and_cell() {
    let cells = [0.5, 1.5, 2.5];
    let part = BoundaryPart {
        vertices: (10..16).collect(),
        weights: vec![1.0; 6],
        points: (0..6).map(|k| [cells[k % 3], cells[k / 3], 0.0]).collect(),
        dimension: 2,
        ..BoundaryPart::point(1.0)
    };
    let failure = StepFailure::new(
        7,
        2.0,
        StepError::Data {
            what: "load",
            vertex: 14,
            value: f64::NAN,
        },
    );
    let placed = failure.placed(|vertex| Some(Place::of(&part, 1, vertex - 10)));
    assert_eq!(
        placed.place.as_ref().and_then(|place| place.cell),
        Some([1, 1])
    );
    assert_eq!(
        placed.to_string(),
        "step 7 at t = 2 s: load at vertex 14 must be finite, is NaN; check functions of with_load_history and with_scaled_load, and plate \
         rates; vertex 14 is number 4 of contact(1), in row 1 and column 1, at [1.5, 1.5] m"
    );
}
