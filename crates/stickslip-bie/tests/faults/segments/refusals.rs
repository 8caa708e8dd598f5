//! Segments that are no fault: each ends with one error that names the place.

use stickslip_bie::{DipProfile, Medium, Mode, SegmentFault, Segments, SegmentsError};

use super::half_space;
use crate::{IN_PLANE, MEDIUM, Outcome, field};

/// The error of polylines, and its message.
fn refused(polylines: &[&[[f64; 2]]]) -> Outcome<(SegmentsError, String)> {
    let error = Segments::polylines(polylines).err().ok_or("accepted")?;
    let message = error.to_string();
    Ok((error, message))
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
    Segments::polylines([&line[..], &beside(0.51)])?;
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
    Segments::polylines([&line[..], &branch(25.0)])?;
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
    let many = Segments::down([(60.0, 4e3)], 1.0)?;
    let error = SegmentFault::half_space(many, MEDIUM, IN_PLANE)
        .err()
        .ok_or("accepted")?;
    assert_eq!(
        error.to_string(),
        "the dense matrices of 4000 cells take 2.56e8 bytes, more than 6.4e7: take at most 2000 cells"
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
