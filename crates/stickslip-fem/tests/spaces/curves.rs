//! Curved boundaries: new vertices are on the curve, the others where they were, and what turns over is refused.

use nalgebra::{SVector, Vector2, Vector3};
use stickslip_fem::{FemError, Hierarchy, Mesh, P1};

use crate::common::{levels, volume};

/// The whole boundary is the part "all".
fn named<const D: usize>(mesh: Mesh<D>) -> Mesh<D> {
    let faces = mesh.boundary().to_vec();
    mesh.with_part("all", &faces).unwrap()
}

/// A hexagon on the unit circle around an inner vertex.
fn hexagon() -> Mesh<2> {
    let mut points = vec![Vector2::zeros()];
    points.extend((0..6).map(|k| {
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_3;
        Vector2::new(angle.cos(), angle.sin())
    }));
    let cells = (0..6).flat_map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
    named(Mesh::new(points, cells).unwrap())
}

/// An octahedron on the unit sphere around an inner vertex.
fn octahedron() -> Mesh<3> {
    let mut points = vec![Vector3::zeros()];
    for axis in 0..3 {
        points.extend([Vector3::ith(axis, 1.0), Vector3::ith(axis, -1.0)]);
    }
    let mut cells = Vec::new();
    for sign in 0..8_u32 {
        let [x, y, z] = [0, 1, 2].map(|axis| 1 + 2 * axis + ((sign >> axis) & 1));
        let odd = (sign.count_ones() % 2) == 1;
        cells.extend(if odd { [0, y, x, z] } else { [0, x, y, z] });
    }
    named(Mesh::new(points, cells).unwrap())
}

fn onto_sphere<const D: usize>(x: &SVector<f64, D>) -> SVector<f64, D> {
    x / x.norm()
}

/// Boundary vertices lie on the sphere, inner ones are midpoints by the weights unless their parents moved, and every
/// level is a mesh.
fn check_sphere<const D: usize>(hierarchy: &Hierarchy<D>) {
    for mesh in levels(hierarchy) {
        let cells = mesh.cells().flatten().copied().collect();
        Mesh::new(mesh.vertices().to_vec(), cells).unwrap();
        for &p in mesh.boundary().iter().flatten() {
            assert!((mesh.vertices()[p as usize].norm() - 1.0).abs() < 1e-15);
        }
    }
    for (level, prolongation) in hierarchy.prolongations().iter().enumerate() {
        let weights: Vec<f64> = prolongation
            .outer_iterator()
            .map(|row| row.data().iter().sum())
            .collect();
        assert!(
            weights.iter().all(|&sum| (sum - 1.0).abs() < 1e-15),
            "level {level}"
        );
    }
}

/// The volume between the body and the ball falls with the square of the edges.
#[test]
fn red_refinement_fills_the_ball() {
    let disk = Hierarchy::new(hexagon())
        .refined_onto(5, "all", onto_sphere)
        .unwrap();
    check_sphere(&disk);
    // The boundary is the inscribed regular polygon.
    for (level, mesh) in levels(&disk).into_iter().enumerate() {
        let sides = f64::from(6 << level as u32);
        let area = 0.5 * sides * (2.0 * std::f64::consts::PI / sides).sin();
        assert!((volume(mesh) - area).abs() < 1e-13);
    }
    let ball = Hierarchy::new(octahedron())
        .refined_onto(4, "all", onto_sphere)
        .unwrap();
    check_sphere(&ball);
    let exact = 4.0 / 3.0 * std::f64::consts::PI;
    let lack: Vec<f64> = levels(&ball)
        .into_iter()
        .map(|mesh| exact - volume(mesh))
        .collect();
    let order = (lack[3] / lack[4]).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}, {lack:?}");
}

#[test]
fn bisection_follows_the_curve_too() {
    let size = |x: &Vector2<f64>| 0.02 + 0.3 * (x - Vector2::x()).norm();
    let disk = Hierarchy::new(hexagon())
        .graded_onto(size, "all", onto_sphere)
        .unwrap();
    check_sphere(&disk);
    // Each chord of length d cuts off no more than d^3 / 12 (1 + d^2).
    let chords = disk.finest().boundary().iter().map(|&[p, q]| {
        let [x, y] = [p, q].map(|p| disk.finest().vertices()[p as usize]);
        (x - y).norm()
    });
    let lack: f64 = chords.map(|d| d.powi(3) / 12.0 * (1.0 + d * d)).sum();
    let missing = std::f64::consts::PI - volume(disk.finest());
    assert!(missing > 0.0 && missing <= lack, "{missing:e} {lack:e}");

    let size = |x: &Vector3<f64>| 0.1 + 0.4 * (x - Vector3::x()).norm();
    let ball = P1::new(octahedron())
        .graded_onto(size, "all", onto_sphere)
        .unwrap();
    check_sphere(ball.hierarchy());
    assert!(ball.hierarchy().level_count() > 3);
}

/// Vertices off the part stay midpoints, also those of edges inside of the body that join two points of the part.
#[test]
fn only_the_part_is_moved() {
    let square = P1::grid([1.0, 1.0], [1, 1]).unwrap().mesh().clone();
    let corner = |x: f64, y: f64| {
        let found = square
            .vertices()
            .iter()
            .position(|v| *v == Vector2::new(x, y));
        found.unwrap() as u32
    };
    let bottom = [[corner(0.0, 0.0), corner(1.0, 0.0)]];
    let right = [[corner(1.0, 0.0), corner(1.0, 1.0)]];
    // The diagonal joins the ends of both.
    let mesh = square
        .clone()
        .with_part("two", &[bottom, right].concat())
        .unwrap();
    let lowered = |x: &Vector2<f64>| x + Vector2::new(0.0, -0.1 * x[0] * (1.0 - x[0]));
    let space = P1::new(mesh).refined_onto(1, "two", lowered).unwrap();
    assert!(space.vertex_at([0.5, 0.5]).is_some());
    assert!(space.vertex_at([0.5, -0.025]).is_some());
    assert!(space.vertex_at([1.0, 0.5]).is_some());
    // Nothing moves: the same mesh as without a curve.
    let flat = P1::new(named(square)).refined(3).unwrap();
    let same = P1::new(flat.hierarchy().coarsest().clone())
        .refined_onto(3, "all", |x| *x)
        .unwrap();
    assert_eq!(same.mesh(), flat.mesh());
    assert_eq!(
        same.hierarchy().prolongations(),
        flat.hierarchy().prolongations()
    );
}

#[test]
fn what_turns_over_is_refused() {
    let triangle = || {
        let points = vec![Vector2::zeros(), Vector2::x(), Vector2::y()];
        named(Mesh::new(points, vec![0, 1, 2]).unwrap())
    };
    let unknown = P1::new(triangle())
        .refined_onto(1, "circle", |x| *x)
        .map(|_| ());
    let known = vec!["all".to_owned()];
    assert_eq!(
        unknown,
        Err(FemError::Unknown {
            what: "part of the boundary",
            name: "circle".to_owned(),
            known
        })
    );

    let refused = |onto: fn(&Vector2<f64>) -> Vector2<f64>| match P1::new(triangle())
        .refined_onto(1, "all", onto)
        .map(|_| ())
    {
        Err(FemError::MovedAway {
            level: 0,
            at,
            edge: 1.0,
            by,
        }) if at == [0.5, 0.0] => by,
        other => panic!("{other:?}"),
    };
    assert!(refused(|x| x * f64::NAN).is_nan());
    assert_eq!(
        refused(|x| x + Vector2::repeat(f64::INFINITY)),
        f64::INFINITY
    );
    assert_eq!(refused(|x| x - Vector2::new(0.0, 0.75)), 0.75);

    // The first level is well, the second is not: the middle of half of the bottom is pushed over a part of
    // its cell.
    let pushed = |x: &Vector2<f64>| {
        if x[1] == 0.0 && x[0] == 0.25 {
            Vector2::new(0.45, 0.1)
        } else {
            *x
        }
    };
    let turned = |found: Result<(), FemError>| {
        let Err(FemError::DegenerateCell {
            level: Some(level),
            cell,
            volume,
        }) = found
        else {
            panic!("{found:?}")
        };
        assert_eq!(level, 1);
        let once = P1::new(triangle()).refined(1).unwrap();
        let corners = once
            .mesh()
            .cell(cell)
            .iter()
            .map(|&p| once.mesh().vertices()[p as usize]);
        assert!(corners.into_iter().any(|x| x == Vector2::new(0.0, 0.0)));
        volume
    };
    // Of the part with the moved point, (1/2, 0) and (1/4, 1/4).
    let volume = turned(
        P1::new(triangle())
            .refined_onto(2, "all", pushed)
            .map(|_| ()),
    );
    assert!((volume - 0.5 * (0.05 * 0.15 - 0.1 * 0.2)).abs() < 1e-15);
    let flat = |x: &Vector2<f64>| {
        if x[1] == 0.0 && x[0] == 0.25 {
            Vector2::new(0.25, 0.25)
        } else {
            *x
        }
    };
    assert_eq!(
        turned(P1::new(triangle()).refined_onto(2, "all", flat).map(|_| ())),
        0.0
    );
    // An edge that hardly becomes shorter, however often it is cut, ends in slivers.
    let points = vec![Vector2::zeros(), Vector2::x(), Vector2::y()];
    let bottom = Mesh::new(points, vec![0, 1, 2])
        .unwrap()
        .with_part("bottom", &[[0, 1]]);
    let length = std::cell::Cell::new(1.0);
    let slow = |x: &Vector2<f64>| {
        if x[0] == 0.5 * length.get() {
            length.set(0.95 * length.get());
            return Vector2::new(length.get(), 0.0);
        }
        *x
    };
    let endless = P1::new(bottom.unwrap()).graded_onto(|x| 1e-4 + 0.5 * x.norm(), "bottom", slow);
    let endless = endless.map(|_| ());
    assert!(matches!(
        endless,
        Err(FemError::DegenerateCell { level: Some(_), .. })
    ));
    let collapsed = P1::new(triangle()).graded_onto(|_| 0.1, "all", |x| Vector2::new(0.0, x[1]));
    assert!(matches!(
        collapsed.map(|_| ()),
        Err(FemError::DegenerateCell {
            level: Some(0),
            cell: 0,
            ..
        })
    ));
}
