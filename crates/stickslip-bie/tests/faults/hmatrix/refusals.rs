//! What a hierarchical matrix refuses.

use stickslip_bie::hmatrix::{Approximation, Extent, HMatrix, HMatrixError};

use super::{Points, sheet, smooth};
use crate::Outcome;

#[test]
fn tolerances_out_of_their_range() -> Outcome {
    for tolerance in [0.0, -1e-4, 0.11, f64::NAN, f64::INFINITY] {
        let refused = Approximation::default().with_tolerance(tolerance);
        let error = refused.err().ok_or("accepted")?;
        let message = error.to_string();
        assert!(
            message.starts_with("tolerance of an H-matrix must be positive, and at most 0.1, is"),
            "{message}"
        );
    }
    let largest = Approximation::default().with_tolerance(0.1)?;
    assert_eq!(largest.tolerance(), 0.1);
    Ok(())
}

#[test]
fn no_cells_and_boxes_that_are_not_finite() {
    let points = Points {
        places: sheet(5),
        shape: [1, 1],
        pair: smooth,
    };
    let with = Approximation::default();
    let refused =
        |cells: &[Extent]| HMatrix::new(&points, cells, &with).map_err(|error| error.to_string());
    let message = refused(&[]).err();
    assert_eq!(
        message.as_deref(),
        Some("number of cells of an H-matrix must be at least 1, is 0")
    );
    let place = Extent::of_points([[0.0; 3]]);
    let message = refused(&[place, Extent::of_points([])]).err();
    assert_eq!(
        message.as_deref(),
        Some("coordinate [m] of cell 1 must be finite, is inf")
    );
}

#[test]
fn entries_that_are_not_finite() -> Outcome {
    for bad in [[3, 3], [0, 399], [399, 0], [210, 14]] {
        let places = sheet(20);
        let [receiver, source] = bad.map(|cell| places[cell]);
        let points = Points {
            places,
            shape: [1, 2],
            pair: |a: [f64; 3], b: [f64; 3], block: &mut [f64]| {
                smooth(a, b, block);
                // Receivers in a row, so that any approximation meets them.
                if a[0] == receiver[0] && b == source {
                    block[1] = f64::NAN;
                }
            },
        };
        match points.compress(&Approximation::default()) {
            Err(HMatrixError::Entry { value, .. }) => assert!(value.is_nan()),
            // Not looked at: far pairs that no cross needs.
            other => assert!(other.is_ok() && receiver != source),
        }
    }
    Ok(())
}

#[test]
fn more_memory_than_the_limit() -> Outcome {
    let points = Points {
        places: sheet(40),
        shape: [3, 2],
        pair: smooth,
    };
    let fine = Approximation::default().with_tolerance(1e-4)?;
    let compression = points.compress(&fine)?.compression();
    // Near blocks alone are too large.
    let refused = points.compress(&fine.with_memory_limit(1000));
    let Err(HMatrixError::Memory {
        needed, fitting, ..
    }) = refused
    else {
        return Err("accepted".into());
    };
    assert!(needed <= compression.near_bytes && fitting.is_none());
    // A larger tolerance fits.
    let coarse = Approximation::default().with_tolerance(1e-2)?;
    let of_coarse = points.compress(&coarse)?.compression();
    let limit = (compression.bytes + of_coarse.bytes) / 2;
    let Err(HMatrixError::Memory {
        needed, fitting, ..
    }) = points.compress(&fine.with_memory_limit(limit))
    else {
        return Err("accepted".into());
    };
    let share = needed as f64 / compression.bytes as f64;
    assert!((share - 1.0).abs() < 0.1, "{share}");
    let fitting = fitting.ok_or("no tolerance")?;
    let fits = Approximation::default()
        .with_tolerance(fitting)?
        .with_memory_limit(limit);
    assert!(points.compress(&fits)?.compression().bytes <= limit + limit / 10);
    Ok(())
}

#[test]
fn additions_to_far_pairs() -> Outcome {
    let points = Points {
        places: sheet(30),
        shape: [1, 1],
        pair: smooth,
    };
    let mut matrix = points.compress(&Approximation::default())?;
    let refused = matrix.add([0, 0], [899, 0], 1.0);
    let far = HMatrixError::FarPair {
        receiver: 0,
        source_cell: 899,
    };
    assert_eq!(refused, Err(far));
    Ok(())
}
