//! Segments that are no fault: each ends with one error that names the place.

use nalgebra::DMatrix;
use proptest::prelude::*;
use stickslip_bie::{Mode, SegmentFault, Segments, SegmentsError};

use super::half_space;
use crate::{IN_PLANE, MEDIUM, Outcome};

/// The error of polylines, or of a fault of them, and its message.
fn refused(polylines: &[&[[f64; 2]]]) -> Outcome<(SegmentsError, String)> {
    let fault = Segments::polylines(polylines).and_then(in_space);
    let error = fault.err().ok_or("accepted")?;
    let message = error.to_string();
    Ok((error, message))
}

fn in_space(segments: Segments) -> Result<SegmentFault, SegmentsError> {
    SegmentFault::whole_space(segments, MEDIUM, IN_PLANE)
}

/// The message of an error below a free surface.
fn below(points: &[[f64; 2]]) -> Outcome<String> {
    let error = half_space(Segments::polyline(points)?)
        .err()
        .ok_or("accepted")?;
    Ok(error.to_string())
}

#[test]
fn polylines_that_are_none_are_refused() -> Outcome {
    assert_eq!(refused(&[])?.1, "segments need at least one polyline");
    let (_, message) = refused(&[&[[0.0, 0.0], [1.0, 0.0]], &[[0.0, 5.0]]])?;
    assert_eq!(message, "polyline 1 has 1 points, and needs at least 2");
    for wrong in [f64::NAN, f64::INFINITY] {
        let (error, _) = refused(&[&[[0.0, 0.0], [1.0, 0.0], [2.0, wrong]]])?;
        assert!(matches!(
            error,
            SegmentsError::NotFinite {
                fault: 0,
                point: 2,
                ..
            }
        ));
    }
    let (_, message) = refused(&[&[[0.0, 0.0], [1.0, -2.0], [1.0, -2.0]]])?;
    assert_eq!(
        message,
        "cell 1 at (1, -2) m has no length: remove one of its two points"
    );
    Ok(())
}

#[test]
fn cells_that_are_the_same_or_cross_are_refused() -> Outcome {
    let line = [[0.0, -1.0], [1.0, -1.0], [2.0, -1.0]];
    let (error, _) = refused(&[&line, &[[2.0, -1.0], [1.0, -1.0]]])?;
    assert_eq!(error, SegmentsError::Duplicate { cells: [1, 2] });
    let (error, message) = refused(&[&line, &[[1.25, 0.0], [1.75, -2.0]]])?;
    assert!(matches!(
        error,
        SegmentsError::Crossing { cells: [1, 2], .. }
    ));
    assert!(
        message.starts_with("cells 1 and 2 cross at (1.5, -1) m"),
        "{message}"
    );
    // Of one polyline that crosses itself.
    let (error, _) = refused(&[&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [1.0, -2.0]]])?;
    assert!(matches!(
        error,
        SegmentsError::Crossing { cells: [0, 3], .. }
    ));
    Ok(())
}

#[test]
fn centers_near_other_cells_are_refused() -> Outcome {
    let line = [[0.0, -1.0], [1.0, -1.0], [2.0, -1.0]];
    // Beside each other, at less than half of the length.
    let beside = |gap: f64| [[0.0, -1.0 - gap], [1.0, -1.0 - gap]];
    let (error, message) = refused(&[&line, &beside(0.49)])?;
    assert!(
        matches!(error, SegmentsError::TooNear { cells: [0, 2], .. }),
        "{error:?}"
    );
    assert!(
        message.contains("at least 0.5 m away from cell 2, is at 0.49"),
        "{message}"
    );
    in_space(Segments::polylines([&line[..], &beside(0.51)])?)?;
    // Shorter cells are far enough from each other.
    in_space(Segments::polylines([&line[..], &beside(0.49)])?.divided(0.9)?)?;
    // A long cell beside short ones, and a branch that ends inside of a cell, are too near.
    assert!(matches!(
        refused(&[&line, &[[-8.0, -1.9], [8.0, -1.9]]])?.0,
        SegmentsError::TooNear { .. }
    ));
    assert!(matches!(
        refused(&[&line, &[[0.3, -1.0], [0.3, -2.0]]])?.0,
        SegmentsError::TooNear { .. }
    ));
    // Cells over others, on one line.
    assert!(matches!(
        refused(&[&line, &[[1.5, -1.0], [4.0, -1.0]]])?.0,
        SegmentsError::TooNear { .. }
    ));
    // Folds and branches at a point.
    let branch = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [[1.0, -1.0], [1.0 + cos, -1.0 - sin]]
    };
    assert!(matches!(
        refused(&[&line, &branch(8.0)])?.0,
        SegmentsError::TooNear { .. }
    ));
    in_space(Segments::polylines([&line[..], &branch(25.0)])?)?;
    Ok(())
}

/// Far more cells than pairs could be checked one by one.
#[test]
fn many_cells_are_checked() -> Outcome {
    let segments = Segments::down([(30.0, 200e3)], 1.0)?;
    assert_eq!(segments.count(), 200_000);
    let across = Segments::polyline(&[[50e3, -100.0], [50e3, -90e3]])?;
    let error = segments.with(&across).err().ok_or("accepted")?;
    assert!(
        matches!(
            error,
            SegmentsError::Crossing {
                cells: [_, 200_000],
                ..
            }
        ),
        "{error}"
    );
    Ok(())
}

#[test]
fn segments_above_the_surface_are_refused() -> Outcome {
    let message = below(&[[0.0, 1.0], [0.0, -1.0], [0.0, -3.0]])?;
    assert_eq!(
        message,
        "cell 0 reaches 1 m above the free surface at z = 0"
    );
    let message = below(&[[0.0, 0.0], [1.0, 1e3], [2.0, 2e3]])?;
    assert!(
        message.contains("all segments have z >= 0, up to 2000 m")
            && message.contains("depths are negative")
    );
    let message = below(&[[-1.0, 0.0], [0.0, 0.0], [1.0, -1.0]])?;
    assert!(
        message.starts_with("cell 0 lies along the free surface"),
        "{message}"
    );
    let message = below(&[[0.0, -5e-4], [0.0, -1.0]])?;
    assert!(
        message.starts_with("cell 0 ends 5e-4 m below the free surface"),
        "{message}"
    );
    // Rounding is set to the surface.
    let fault = half_space(Segments::polyline(&[[0.0, 1e-10], [0.0, -1.0]])?)?;
    assert_eq!(fault.cells().ends(0)[0], [0.0, 0.0]);
    // In a whole space there is none.
    let above = Segments::polyline(&[[0.0, 1.0], [0.0, -1.0]])?;
    SegmentFault::whole_space(above, MEDIUM, IN_PLANE)?;
    Ok(())
}

/// Neighbours of unequal length and bends are reported.
#[test]
fn quality_is_reported() -> Outcome {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.5, 0.0], [5.0, -1.5]];
    let segments = Segments::polyline(&points)?;
    let quality = segments.quality();
    assert_eq!(quality.unequal, [[1, 2], [2, 3]]);
    assert!((quality.largest_ratio - 1.5).abs() < 1e-12);
    assert!((quality.largest_bend - 45.0).abs() < 1e-12);
    assert_eq!(quality.largest_bend_between, Some([2, 3]));
    assert_eq!([0, 1].map(|cell| segments.bend_at(cell)), [0.0; 2]);
    assert!(
        [2, 3]
            .iter()
            .all(|&cell| (segments.bend_at(cell) - 45.0).abs() < 1e-12)
    );
    // Across the first point of a closed fault.
    let closed = Segments::polyline(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.0, 0.0]])?;
    assert!(closed.bend_at(0) > 100.0 && closed.bend_at(2) > 100.0);
    let one = Segments::polyline(&points[..2])?.quality();
    assert_eq!((one.largest_ratio, one.largest_bend_between), (1.0, None));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    /// Random polylines of any size are refused by a message, or have finite matrices whose cells resist their own slip.
    #[test]
    fn polylines_are_refused_or_resist_slip(
        mut points in prop::collection::vec([-5.0..5.0, -9.0..0.5].prop_map(|x: [f64; 2]| x), 2..7),
        on_grid: bool,
        scale in -8..9,
        antiplane: bool,
    ) {
        for x in points.as_flattened_mut() {
            *x = if on_grid { x.round() } else { *x } * 10_f64.powi(scale);
        }
        let mode = if antiplane { Mode::Antiplane } else { IN_PLANE };
        let made = Segments::polyline(&points)
            .and_then(|segments| SegmentFault::half_space(segments, MEDIUM, mode));
        match made {
            Err(error) => prop_assert!(!error.to_string().is_empty()),
            Ok(fault) => {
                let matrix = DMatrix::from(&fault.stiffness());
                prop_assert!(matrix.iter().all(|entry| entry.is_finite()));
                prop_assert!(matrix.diagonal().iter().all(|&own| own > 0.0));
                prop_assert!(DMatrix::from(&fault.normal_stiffness()).iter().all(|entry| entry.is_finite()));
            }
        }
    }
}
