//! Closed forms, and the same fault in several ways.

use std::f64::consts::PI;

use nalgebra::{Vector1, Vector2};
use stickslip_bie::{
    Cells, DippingFault, Fault, FaultSystem, Placement, PlaneFault, Receivers, Rectangles,
    SegmentFault, Segments, Sense, SurfaceFault, Triangles,
};

use super::POISSON_RATIO;
use crate::{IN_PLANE, MEDIUM, Outcome};

/// `(D/pi) [atan(x/d)]` of a screw dislocation below `d`, by the creep below the cells; inside, `(D/(2 pi)) (atan(x/(d + z)) +
/// atan(x/(d - z)))`.
#[test]
fn a_locked_fault_moves_by_arctangents() -> Outcome {
    let depth: f64 = 15e3;
    for cells in [1, 30] {
        let fault = Fault::half_space(Cells::new([0.0, depth], cells)?, MEDIUM)?;
        for x in [-200e3_f64, -10e3, -1.0, 1e-3, 3e3, 15e3, 80e3] {
            for z in [0.0, -4e3, -14.9e3] {
                let moved = Receivers::new(&fault, &[[x, 7.0, z]])?.creep(Vector1::new(3.0))?;
                let exact = (x / (depth + z)).atan() + (x / (depth - z)).atan();
                let exact = 3.0 / (2.0 * PI) * exact;
                assert!(
                    (moved[0][1] - exact).abs() < 1e-12,
                    "{x} {z}: {moved:?} {exact}"
                );
                assert_eq!([moved[0][0], moved[0][2]], [0.0; 2]);
            }
        }
    }
    Ok(())
}

/// Slip to the depth `d` from the surface on: `(D/pi) (pi/2 - atan(x/d))`.
#[test]
fn an_event_moves_by_the_rest() -> Outcome {
    let fault = Fault::half_space(Cells::new([0.0, 15e3], 20)?, MEDIUM)?;
    let points = [100.0, 2e3, 50e3].map(|x| [x, 0.0, 0.0]);
    let moved = Receivers::new(&fault, &points)?.displacement(&[Vector1::new(2.0); 20])?;
    for ([x, ..], [_, along, _]) in points.iter().zip(moved) {
        let exact = 2.0 / PI * (15e3 / x).atan();
        assert!((along - exact).abs() < 1e-13);
    }
    Ok(())
}

#[test]
fn a_dipping_line_is_a_straight_polyline() -> Outcome {
    let points = [[-4e3, 0.0, 0.0], [2e3, 0.0, -1e3], [9e3, 0.0, -7e3]];
    for (dip, sense) in [
        (30.0, Sense::Normal),
        (60.0, Sense::Thrust),
        (90.0, Sense::Thrust),
    ] {
        let cells = Cells::new([0.0, 10e3], 20)?;
        let line = DippingFault::new(cells, MEDIUM, POISSON_RATIO, dip, sense)?;
        let polyline = Segments::down([(dip, 10e3)], 500.0)?;
        let polyline = SegmentFault::half_space(polyline, MEDIUM, IN_PLANE)?.with_sense(sense);
        let slip: Vec<_> = (0..20)
            .map(|k| Vector1::new(1.0 / (1.0 + f64::from(k))))
            .collect();
        let both = [
            Receivers::new(&line, &points)?,
            Receivers::new(&polyline, &points)?,
        ];
        let [one, other] = [both[0].displacement(&slip)?, both[1].displacement(&slip)?];
        for i in 0..9 {
            let (one, other) = (one.as_flattened()[i], other.as_flattened()[i]);
            assert!((one - other).abs() < 1e-12);
        }
        let of_polyline = polyline.displacement_at(&points.map(|[x, _, z]| [x, z]), &slip)?;
        assert_eq!(of_polyline, other);
        let [one, other] = [both[0].stress(&slip)?, both[1].stress(&slip)?];
        assert!((one[2] - other[2]).abs().max() < 1e-12 * MEDIUM.shear_modulus / 1e3);
    }
    Ok(())
}

/// A plane much longer than wide is a line in its middle, up to the width over the length.
#[test]
fn a_long_plane_is_a_line() -> Outcome {
    let down = Cells::new([1e3, 6e3], 2)?;
    let columns = Cells::new([-2e7, 2e7], 1)?;
    let plane =
        PlaneFault::half_space(Rectangles::new(columns, down), 35.0, MEDIUM, POISSON_RATIO)?;
    let line = DippingFault::new(down, MEDIUM, POISSON_RATIO, 35.0, Sense::Thrust)?;
    // The line dips towards x, the plane to the right of strike, towards -y.
    let points = [[-5e3, 0.0], [3e3, 0.0], [4e3, -6e3], [9e3, -1e3]];
    let of_plane = Receivers::new(&plane, &points.map(|[x, z]| [0.0, -x, z]))?;
    let of_line = Receivers::new(&line, &points.map(|[x, z]| [x, 0.0, z]))?;
    let of_plane = of_plane.displacement(&[Vector2::new(0.0, 1.0), Vector2::new(0.0, 0.3)])?;
    let of_line = of_line.displacement(&[Vector1::new(1.0), Vector1::new(0.3)])?;
    for ([_, y, up], [x, _, z]) in of_plane.into_iter().zip(of_line) {
        assert!(
            (x + y).abs() < 2.5e-5 && (z - up).abs() < 2.5e-5,
            "{x} {y}, {z} {up}"
        );
    }
    Ok(())
}

/// A plane, the same in a system, and the same of triangles.
#[test]
fn planes_are_what_their_triangles_are() -> Outcome {
    let rows = Cells::new([0.0, 3e3], 1)?;
    let cells = Rectangles::new(Cells::new([0.0, 4e3], 1)?, rows);
    let plane = PlaneFault::half_space(cells, 45.0, MEDIUM, POISSON_RATIO)?;
    // Strike to the east: x is east, y is north.
    let place = Placement {
        strike: 90.0,
        origin: [0.0, 0.0],
    };
    let system = FaultSystem::new([(plane.clone(), place)])?;
    let down = 3e3 * 0.5_f64.sqrt();
    let corners = [
        [0.0, 0.0, 0.0],
        [4e3, 0.0, 0.0],
        [4e3, -down, -down],
        [0.0, -down, -down],
    ];
    let triangles = Triangles::new(&corners, &[[0, 2, 1], [0, 3, 2]])?;
    let surface = SurfaceFault::half_space(triangles, MEDIUM, POISSON_RATIO)?;
    // On the continuation of the trace, above a corner, and inside.
    let points = [
        [-3e3, 0.0, 0.0],
        [4e3, -down, 0.0],
        [7e3, 2e3, 0.0],
        [1e3, -5e3, -2e3],
        [2e3, 0.0, -2.5e3],
    ];
    let slip = Vector2::new(0.7, -0.4);
    let (one, other) = (
        Receivers::new(&plane, &points)?,
        Receivers::new(&system, &points)?,
    );
    let third = Receivers::new(&surface, &points)?;
    let all = [
        one.displacement(&[slip])?,
        other.displacement(&[slip])?,
        third.displacement(&[slip; 2])?,
    ];
    for other in &all[1..] {
        for (one, other) in all[0].as_flattened().iter().zip(other.as_flattened()) {
            assert!((one - other).abs() < 1e-12, "{one} {other}");
        }
    }
    let stresses = [one.stress(&[slip])?, third.stress(&[slip; 2])?];
    let okada = plane.dislocation(0).ok_or("no half space")?;
    for (at, (one, other)) in points.iter().zip(stresses[0].iter().zip(&stresses[1])) {
        let okada = okada.stress(slip.into(), *at);
        let scale = MEDIUM.shear_modulus / 3e3;
        assert!((one - other).abs().max() < 1e-11 * scale);
        assert!(
            (one - okada).abs().max() < 1e-9 * scale,
            "{at:?} {one} {okada}"
        );
    }
    Ok(())
}
