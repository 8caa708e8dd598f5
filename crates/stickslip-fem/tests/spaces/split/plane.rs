//! Faults in the plane.

use nalgebra::{Rotation2, Vector2};
use stickslip_fem::{GridDiagonal, Mesh, P1};

use super::{check, euler};

/// A square of side 2 around the origin.
fn square(n: usize) -> Mesh<2> {
    let grid = Mesh::<2>::grid([2.0, 2.0], [n, n], GridDiagonal::Rising).unwrap();
    moved(&grid, |x| x - Vector2::new(1.0, 1.0))
}

fn moved(mesh: &Mesh<2>, to: impl Fn(&Vector2<f64>) -> Vector2<f64>) -> Mesh<2> {
    let cells = mesh.cells().flatten().copied().collect();
    Mesh::new(mesh.vertices().iter().map(to).collect(), cells).unwrap()
}

fn copies(before: &Mesh<2>, after: &Mesh<2>) -> usize {
    after.vertex_count() - before.vertex_count()
}

#[test]
fn a_fault_through_the_body_parts_it() {
    let mesh = square(4)
        .with_part("top", &[[20, 21]].map(|_| [4, 9]))
        .unwrap()
        .with_material("half", &[0, 1, 2])
        .unwrap()
        .with_surface_where("fault", |x| x[1] == 0.0)
        .unwrap();
    let after = mesh.clone().split("fault").unwrap();
    check(&mesh, &after, &["fault"]);
    assert_eq!(copies(&mesh, &after), 5);
    // Two disks instead of one.
    assert_eq!((euler(&mesh), euler(&after)), (1, 2));
    assert_eq!(after.surfaces().count(), 0);
    let space = P1::new(after);
    let plus = space.part("fault+").unwrap();
    assert!(plus.normals().iter().all(|n| n.as_slice() == [0.0, -1.0]));
    assert!(
        plus.opposite()
            .unwrap()
            .iter()
            .zip(plus.vertices())
            .all(|(p, q)| p != q)
    );
    // All faces at the place are no side, and neither is a part of one.
    assert_eq!(space.trace(|x| x[1] == 0.0).unwrap().opposite(), None);
    assert_eq!(space.trace(|x| x[1] == 1.0).unwrap().opposite(), None);
}

#[test]
fn a_fault_that_ends_inside_has_tips() {
    for (on, vertices, holes) in [(-0.5..0.5, 1, 1), (-1.0..0.5, 3, 0), (-1.0..-0.5, 1, 0)] {
        let mesh = square(4)
            .with_surface_where("fault", |x| {
                x[0] == 0.0 && on.start <= x[1] && x[1] <= on.end
            })
            .unwrap();
        let after = mesh.clone().split("fault").unwrap();
        check(&mesh, &after, &["fault"]);
        assert_eq!(copies(&mesh, &after), vertices);
        assert_eq!(euler(&after), 1 - holes);
        // The plus side is that of larger x, its outward normal points to the minus side.
        let space = P1::new(after);
        let plus = space.part("fault+").unwrap();
        assert!(plus.normals().iter().all(|n| n.as_slice() == [-1.0, 0.0]));
        let tips = plus.opposite().unwrap().iter().zip(plus.vertices());
        assert_eq!(
            tips.filter(|(p, q)| p == q).count(),
            plus.vertices().len() - vertices
        );
    }
}

/// The last component of the mean normal that is not zero counts, also where the fault turns over.
#[test]
fn bent_faults_have_one_plus_side() {
    let mesh = square(8)
        .with_surface_where("fault", |x| {
            let (along, down) = (x[1] == 0.0 && x[0] >= -0.75, x[0] == 0.0 && x[1] >= -0.75);
            along && x[0] <= 0.0 || down && x[1] <= 0.0
        })
        .unwrap();
    let after = mesh.clone().split("fault").unwrap();
    check(&mesh, &after, &["fault"]);
    assert_eq!((copies(&mesh, &after), euler(&after)), (5, 0));
    let space = P1::new(after);
    let minus = space.part("fault-").unwrap();
    for (x, n) in minus.points().iter().zip(minus.normals()) {
        assert!(
            n[1] > 0.0 || x[1] < 0.0 && n.as_slice() == [1.0, 0.0],
            "{x}{n}"
        );
    }
}

#[test]
fn of_a_closed_surface_plus_is_the_outside() {
    let mesh = square(4);
    let all = mesh.clone().with_surface_where("all", |_| true).unwrap();
    let x = |p: u32| mesh.vertices()[p as usize];
    // A diagonal may join two of its sides.
    let (_, faces) = all.surfaces().next().unwrap();
    let on = |&&[p, q]: &&[u32; 2]| {
        [x(p), x(q), 0.5 * (x(p) + x(q))]
            .iter()
            .all(|x| x.amax() == 0.5)
    };
    let ring: Vec<[u32; 2]> = faces.iter().filter(on).copied().collect();
    let mesh = mesh.clone().with_surface("ring", &ring).unwrap();
    let after = mesh.clone().split("ring").unwrap();
    check(&mesh, &after, &["ring"]);
    assert_eq!((copies(&mesh, &after), euler(&after)), (8, 1));
    let space = P1::new(after);
    let minus = space.part("ring-").unwrap();
    assert!(
        minus
            .points()
            .iter()
            .zip(minus.normals())
            .all(|(x, n)| x.dot(n) > 0.0)
    );
}

/// Parts that are not connected, each with its own sides.
#[test]
fn a_surface_may_have_several_parts() {
    let mesh = square(4)
        .with_surface_where("faults", |x| x[0].abs() == 0.5)
        .unwrap();
    let after = mesh.clone().split("faults").unwrap();
    check(&mesh, &after, &["faults"]);
    assert_eq!((copies(&mesh, &after), euler(&after)), (10, 3));
}

/// A square turned so that its rows and diagonals meet at 60 degrees.
fn rhombic(n: usize) -> Mesh<2> {
    moved(&square(n), |x| {
        Vector2::new(x[0] - 0.5 * x[1], 0.75_f64.sqrt() * x[1])
    })
}

fn along(x: &Vector2<f64>, degrees: f64) -> (f64, bool) {
    let turned = Rotation2::new(-degrees.to_radians()) * x;
    (turned[0], turned[1].abs() < 1e-12)
}

#[test]
fn faults_that_cross_have_four_copies() {
    for reach in [0.6, 9.0] {
        let on = |degrees: f64| {
            move |x: &Vector2<f64>| {
                let (s, on) = along(x, degrees);
                on && s.abs() < reach
            }
        };
        let mesh = rhombic(8)
            .with_surface_where("first", on(0.0))
            .unwrap()
            .with_surface_where("second", on(60.0))
            .unwrap();
        let after = mesh.clone().split_all(["first", "second"]).unwrap();
        check(&mesh, &after, &["first", "second"]);
        let centre = (0..after.vertex_count()).filter(|&p| after.vertices()[p].norm() < 1e-9);
        assert_eq!(centre.count(), 4);
        // One hole, or four pieces.
        assert_eq!(euler(&after), if reach < 1.0 { 0 } else { 4 });
        let turned = mesh.split_all(["second", "first"]).unwrap();
        assert_eq!(turned.vertex_count(), after.vertex_count());
    }
}

#[test]
fn a_branch_ends_on_the_fault() {
    // Of a mesh with 30 degrees between two of its lines.
    let mesh = moved(&square(8), |x| {
        Vector2::new(x[0] + 0.5 * (3.0_f64.sqrt() - 1.0) * x[1] - 0.0, 0.5 * x[1])
    });
    let mesh = mesh
        .with_surface_where("main", |x| x[1] == 0.0)
        .unwrap()
        .with_surface_where("splay", |x| {
            let (s, on) = along(
                x,
                (0.5_f64).atan2(0.5 * (3.0_f64.sqrt() + 1.0)).to_degrees(),
            );
            on && s > -1e-9 && s < 0.9
        })
        .unwrap();
    let splay = mesh.surfaces().nth(1).unwrap().1.len();
    assert!(splay > 1);
    let after = mesh.clone().split_all(["main", "splay"]).unwrap();
    check(&mesh, &after, &["main", "splay"]);
    // Both ends of the splay are tips.
    assert_eq!(copies(&mesh, &after), 9 + splay - 1);
    let space = P1::new(after);
    let centre = |p: &usize| space.mesh().vertices()[*p].norm() < 1e-9;
    let count = |part: &str| {
        let part = space.part(part).unwrap();
        part.vertices().iter().filter(|p| centre(p)).count()
    };
    assert_eq!(["main+", "main-", "splay+", "splay-"].map(count), [1; 4]);
    assert_eq!((0..space.vertex_count()).filter(centre).count(), 2);
    // Split in the other order, the splay has a tip on what is split through it.
    let turned = mesh.clone().split_all(["splay", "main"]).unwrap();
    check(&mesh, &turned, &["main", "splay"]);
    assert_eq!(turned.vertex_count(), space.vertex_count());
}

/// A branch that leaves the fault where that meets the surface of the body is free there.
#[test]
fn faults_may_meet_at_the_boundary() {
    let mesh = square(4)
        .with_surface_where("main", |x| x[1] == -1.0 + (x[0] + 1.0))
        .unwrap();
    let after = mesh.clone().split("main").unwrap();
    assert_eq!((copies(&mesh, &after), euler(&after)), (5, 2));
    let mesh = square(4)
        .with_surface_where("main", |x| x[0] == 0.0)
        .unwrap()
        .with_surface_where("splay", |x| x[1] == 1.0 + x[0] && x[0] <= 0.0)
        .unwrap();
    let after = mesh.clone().split_all(["main", "splay"]).unwrap();
    check(&mesh, &after, &["main", "splay"]);
    assert_eq!((copies(&mesh, &after), euler(&after)), (5 + 3, 3));
}

#[test]
fn other_surfaces_keep_their_faces() {
    let mesh = square(4)
        .with_surface_where("main", |x| x[1] == 0.0)
        .unwrap()
        .with_surface_where("cross", |x| x[0] == 0.0)
        .unwrap()
        .with_surface_where("half", |x| x[1] == 0.0 && x[0] <= 0.0)
        .unwrap();
    let after = mesh.clone().split("main").unwrap();
    let left: Vec<_> = after
        .surfaces()
        .map(|(name, faces)| (name, faces.len()))
        .collect();
    assert_eq!(left, [("cross", 4)]);
    let twice = after.clone().split("cross").unwrap();
    check(&mesh, &twice, &["main", "cross"]);
}

/// Uniform slip on a circle is a rotation: normals of its vertices must be exact on any polygon.
#[test]
fn normals_are_exact_on_a_circle() {
    let mesh = square(8);
    let step = |k: usize| 0.25 * k as f64 + 0.06 * (k as f64).sin();
    let ring = moved(&mesh, |x| {
        let (radius, angle) = (2.0 + x[1], step(((x[0] + 1.0) * 4.0).round() as usize));
        Vector2::new(-radius * angle.cos(), radius * angle.sin())
    });
    let ring = ring
        .with_surface_where("fault", |x| (x.norm() - 2.0).abs() < 1e-12)
        .unwrap();
    let space = P1::new(ring.split("fault").unwrap());
    let minus = space.part("fault-").unwrap();
    for (x, n) in minus.points().iter().zip(minus.normals()).skip(1) {
        let inner = minus
            .points()
            .iter()
            .filter(|y| (*y - x).norm() < 0.9)
            .count()
            == 3;
        let radial = x.normalize();
        assert!(!inner || (n - radial).norm() < 1e-12, "{n}{radial}");
    }
}
