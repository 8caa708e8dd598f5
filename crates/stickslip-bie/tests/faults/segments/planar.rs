//! Straight segments are planar faults.

use nalgebra::DMatrix;
use stickslip_bie::{Cells, DippingFault, Fault, Mode, SegmentFault, Segments, Sense};

use crate::{IN_PLANE, MEDIUM, Outcome, dense};

/// A straight line of a dip from one distance to another.
fn line(dip: f64, cells: &Cells) -> Outcome<Segments> {
    let (sin, cos) = dip.to_radians().sin_cos();
    let at = |k: usize| cells.ends()[0] + k as f64 * cells.length();
    let points = (0..=cells.count()).map(|k| [at(k) * cos, -at(k) * sin]);
    Ok(Segments::polyline(&points.collect::<Vec<_>>())?)
}

/// Both matrices, in the order of the cells of a planar fault.
fn matrices(fault: &SegmentFault, reversed: bool) -> [DMatrix<f64>; 2] {
    let count = fault.cells().count();
    let order = |k: usize| if reversed { count - 1 - k } else { k };
    let matrices = [
        DMatrix::from(&fault.stiffness()),
        DMatrix::from(&fault.normal_stiffness()),
    ];
    matrices.map(|own| DMatrix::from_fn(count, count, |i, j| own[(order(i), order(j))]))
}

/// Whatever the direction of its points and of its dip, to the tolerance of the planar fault's low ranks.
#[test]
fn straight_segments_are_a_dipping_fault() -> Outcome {
    for (begin, dip) in [
        (0.0, 90.0),
        (0.0, 60.0),
        (300.0, 60.0),
        (0.0, 30.0),
        (2e3, 10.0),
    ] {
        let cells = Cells::new([begin, 12e3], 60)?;
        let right = line(dip, &cells)?;
        let left = right.map_points(|[x, z]| [-x, z])?;
        let back = |segments: &Segments| {
            let points: Vec<_> = (0..60).rev().map(|cell| segments.ends(cell)[1]).collect();
            let first = segments.ends(0)[0];
            Segments::polyline(&points.into_iter().chain([first]).collect::<Vec<_>>())
        };
        for sense in [Sense::Thrust, Sense::Normal] {
            let planar = DippingFault::new(cells, MEDIUM, 0.25, dip, sense)?;
            let stiffness = DMatrix::from(&planar.stiffness());
            let normal = DMatrix::from(&planar.normal_stiffness());
            let size = stiffness.amax();
            for (segments, reversed) in [
                (right.clone(), false),
                (left.clone(), false),
                (back(&right)?, true),
                (back(&left)?, true),
            ] {
                let fault = SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?;
                let own = matrices(&fault.with_sense(sense), reversed);
                let apart = [
                    (&own[0] - &stiffness).amax(),
                    (&own[1] - &normal).amax() * cells.length(),
                ];
                assert!(
                    apart.iter().all(|apart| *apart < 1e-10 * size),
                    "{apart:?} of {size:e}"
                );
            }
        }
    }
    Ok(())
}

#[test]
fn vertical_antiplane_segments_are_a_fault_in_a_half_space() -> Outcome {
    for begin in [0.0, 700.0] {
        let cells = Cells::new([begin, 40e3], 80)?;
        let planar = dense(&Fault::half_space(cells, MEDIUM)?.stiffness());
        let fault = SegmentFault::half_space(line(90.0, &cells)?, MEDIUM, Mode::Antiplane)?;
        let apart = DMatrix::from(&fault.stiffness()) - &planar;
        assert!(apart.amax() < 1e-12 * planar.amax(), "{:e}", apart.amax());
        assert!(fault.normal_stiffness().is_zero());
    }
    // An own cell at the surface.
    let cells = Cells::new([0.0, 10.0], 10)?;
    let fault = SegmentFault::half_space(line(90.0, &cells)?, super::UNIT, Mode::Antiplane)?;
    assert!((fault.stiffness().entry(0, 0) - 0.424_413_18).abs() < 1e-8);
    Ok(())
}

/// In every direction.
#[test]
fn straight_segments_are_a_fault_in_a_whole_space() -> Outcome {
    let cells = Cells::new([-3e3, 5e3], 48)?;
    for mode in [Mode::Antiplane, IN_PLANE] {
        let planar = dense(&Fault::whole_space(cells, MEDIUM, mode)?.stiffness());
        for direction in [0.0, 17.0, 90.0, 135.0, 180.0, 261.0] {
            let fault = SegmentFault::whole_space(line(direction, &cells)?, MEDIUM, mode)?;
            let [stiffness, normal] = matrices(&fault, false);
            assert!((stiffness - &planar).amax() < 1e-12 * planar.amax());
            assert!(normal.amax() * cells.length() < 1e-12 * planar.amax());
        }
    }
    Ok(())
}

/// The values of an independent computation, see the tests of dipping faults.
#[test]
fn shallow_slip_of_a_thrust_unclamps_its_own_cell() -> Outcome {
    for (dip, known) in [(60.0, -0.012_858_983), (30.0, -0.163_356_710)] {
        let fault = super::half_space(Segments::down([(dip, 100.0)], 1.0)?)?;
        let own = fault.normal_stiffness().entry(0, 0);
        assert!((own - known).abs() < 1e-9, "{own}");
    }
    Ok(())
}
