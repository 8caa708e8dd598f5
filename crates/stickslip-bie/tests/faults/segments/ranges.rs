//! Values of faults of segments that are out of their ranges.

use stickslip_bie::hmatrix::Approximation;
use stickslip_bie::{DipProfile, Medium, Mode, SegmentFault, Segments, SegmentsError};

use super::half_space;
use crate::{IN_PLANE, MEDIUM, Outcome, field};

#[test]
fn values_out_of_their_ranges_are_refused() -> Outcome {
    let cells = || Segments::down([(60.0, 4e3)], 1e3);
    for poisson_ratio in [0.5, -1.0, f64::NAN] {
        let mode = Mode::InPlane { poisson_ratio };
        let error = SegmentFault::half_space(cells()?, MEDIUM, mode).err();
        assert!(
            error.is_some_and(|error| error.to_string().starts_with("Poisson's ratio must be"))
        );
    }
    for shear_modulus in [0.0, -1.0, f64::NAN] {
        let rock = Medium {
            shear_modulus,
            ..MEDIUM
        };
        let error = SegmentFault::whole_space(cells()?, rock, IN_PLANE).err();
        assert!(error.is_some_and(|error| error.to_string().starts_with("shear modulus must be")));
    }
    let few = SegmentFault::half_space(cells()?, MEDIUM, IN_PLANE)?;
    for tolerance in [0.0, -1e-4, 0.11, f64::NAN] {
        let error = few.clone().with_tolerance(tolerance).err();
        let message = error.ok_or("accepted")?.to_string();
        assert!(message.starts_with("tolerance of an H-matrix must be positive"));
    }
    let limited = Approximation::default()
        .without_far_blocks()
        .with_memory_limit(100);
    let message = few
        .with_approximation(limited)
        .err()
        .ok_or("accepted")?
        .to_string();
    assert!(
        message.contains("bytes without far blocks, more than the limit of 100 bytes"),
        "{message}"
    );
    assert!(cells()?.section(|_| false).is_err() && cells()?.section_of(1).is_err());
    Ok(())
}

#[test]
fn dips_that_are_none_are_refused() -> Outcome {
    let message = |profile: DipProfile, cell: f64| -> Outcome<String> {
        let error = Segments::down(profile, cell).err().ok_or("accepted")?;
        Ok(error.to_string())
    };
    for dip in [-1.0, 181.0, f64::NAN] {
        let found = message(DipProfile::new([(60.0, 1e3), (dip, 1e3)]), 100.0)?;
        assert!(
            found.starts_with("dip [degrees] of piece 1 must be from 0 to 180"),
            "{found}"
        );
    }
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = message(DipProfile::new([(60.0, length)]), 100.0)?;
        assert!(
            found.starts_with("length [m] of piece 0 must be positive and finite"),
            "{found}"
        );
        let found = message(DipProfile::new([(60.0, 1e3)]), length)?;
        assert!(
            found.starts_with("length [m] of cells must be positive and finite"),
            "{found}"
        );
    }
    assert!(message(DipProfile::new([]), 100.0)?.starts_with("number of pieces down dip"));
    let bent = DipProfile::new([(60.0, 5e3), (50.0, 2e3), (40.0, 9e3)]);
    let found = message(bent.clone().spread(3e3), 100.0)?;
    assert!(
        found.starts_with("bend 1 is spread over 3000 m, and must be over at most 2000 m"),
        "{found}"
    );
    assert!(message(bent.spread(-1.0), 100.0)?.starts_with("length [m] of a bend must be finite"));
    let found = message(DipProfile::new([(60.0, 1e3)]), 1e-4)?;
    assert!(
        found.ends_with("are more than 1000000: take longer cells"),
        "{found}"
    );
    let error = Segments::by_dip([0.0; 2], 1e3, 100.0, |s| 60.0 - s)
        .err()
        .ok_or("accepted")?;
    assert!(
        error
            .to_string()
            .starts_with("dip [degrees] of cell 1 must be from 0"),
        "{error}"
    );
    Ok(())
}

#[test]
fn receivers_that_are_none_are_refused() -> Outcome {
    let fault = half_space(Segments::down([(60.0, 4e3)], 1e3)?)?;
    let slip = field(&[1.0; 4]);
    for position in [[0.0, 1.0], [f64::NAN, -1.0]] {
        let error = fault
            .stress_at(&[[5.0, -1.0], position], &slip)
            .err()
            .ok_or("accepted")?;
        assert!(
            matches!(error, SegmentsError::Receiver { point: 1, .. }),
            "{error}"
        );
    }
    let error = fault
        .displacement_at(&[[0.0, 0.0]], &slip)
        .err()
        .ok_or("accepted")?;
    assert!(
        matches!(
            error,
            SegmentsError::ReceiverAtEnd {
                point: 0,
                cell: 0,
                ..
            }
        ),
        "{error}"
    );
    assert!(fault.stress_at(&[[1.0, -1.0]], &slip[1..]).is_err());
    Ok(())
}
