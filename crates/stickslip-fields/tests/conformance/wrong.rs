//! Wrong fields, and the violations that they show.

use stickslip_fields::{FieldViolation, check_fault_field};

use super::drained::{Drained, Flaw};

/// The quantity of the violation, and its requirement.
fn found(flaw: Flaw) -> (String, &'static str) {
    let violation = check_fault_field(&Drained(flaw)).expect_err("the flaw is found");
    match violation {
        FieldViolation::Refused { error, .. } => (error.to_string(), "refused"),
        FieldViolation::Value {
            what, requirement, ..
        }
        | FieldViolation::Differs {
            what, requirement, ..
        } => (what.to_string(), requirement),
        other => panic!("{flaw:?}: {other}"),
    }
}

#[test]
fn the_field_without_a_flaw_is_right() {
    assert_eq!(check_fault_field(&Drained(Flaw::None)), Ok(()));
}

#[test]
fn each_flaw_is_found() {
    let number = "a finite number";
    let free = "pressure without source at vertex";
    let growth = "at most, in magnitude, the largest with it,";
    let long = "as after two halves of the step (L-stable),";
    for (flaw, what, requirement) in [
        (
            Flaw::NoVertices,
            "number of vertices of field",
            "at least 1",
        ),
        (Flaw::InitialMemory, "initial memory", number),
        (Flaw::SourceAtRest, "source", number),
        (Flaw::SourceUnwritten, "source", number),
        (Flaw::MemoryUnwritten, "memory", number),
        (Flaw::LongSteps, "time step 1e11 at place 0", "refused"),
        (Flaw::NoStep, "memory", "as before,"),
        (
            Flaw::FirstSourceOnly,
            "memory, by two halves, at place",
            "as by the whole step, since `error` adds nothing,",
        ),
        (
            Flaw::Assigned,
            "pressure added to that of another field, at vertex",
            "the sum",
        ),
        (
            Flaw::Squared,
            "pressure of a mean of two memories, at vertex",
            "the mean",
        ),
        (
            Flaw::OtherPressure,
            "pressure_after at vertex",
            "that of the advanced memory,",
        ),
        (Flaw::ScratchUnwritten, "source", number),
        (Flaw::Growth, free, growth),
        (Flaw::Ringing, free, long),
        (Flaw::Trapezoid, free, long),
        (Flaw::ErrorNan, "error at vertex", number),
        (Flaw::Reading, "drainage", number),
        (Flaw::Total, "volume", number),
    ] {
        assert_eq!(found(flaw), (what.to_string(), requirement), "{flaw:?}");
    }
}

/// Halves of a step of first order differ by the second power of its length: a fourth of it.
#[test]
fn first_order_is_found_by_its_factor() {
    let violation = check_fault_field(&Drained(Flaw::BackwardEuler)).expect_err("first order");
    let FieldViolation::Order { dt, by, factor, .. } = violation else {
        panic!("{violation}");
    };
    assert!((3.5..4.5).contains(&factor), "{factor}");
    assert!(dt > 0.0 && by > 0.0);
    assert!(violation.to_string().contains("must be by about 8"));
}

#[test]
fn messages_have_the_numbers() {
    let message =
        |flaw| check_fault_field(&Drained(flaw)).map_err(|violation| violation.to_string());
    let long = "advance by 1e11 s fails: time step 1e11 at place 0";
    assert_eq!(message(Flaw::LongSteps), Err(long.into()));
    let source = "source 1 is NaN, must be a finite number";
    assert_eq!(message(Flaw::SourceUnwritten), Err(source.into()));
    let step = "memory 0 is 1e0 after a step of 0e0 s, must be as before, 0e0";
    assert_eq!(message(Flaw::NoStep), Err(step.into()));
}
