//! Faults in space.

use nalgebra::Vector3;
use stickslip_fem::{Mesh, P1};

use super::{check, euler};

fn cube(n: usize) -> Mesh<3> {
    Mesh::<3>::grid([2.0; 3], [n; 3]).unwrap()
}

fn moved(mesh: &Mesh<3>, to: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Mesh<3> {
    let cells = mesh.cells().flatten().copied().collect();
    Mesh::new(mesh.vertices().iter().map(to).collect(), cells).unwrap()
}

#[test]
fn faults_end_inside_or_at_the_boundary() {
    type Case = (fn(&Vector3<f64>) -> bool, usize, i64);
    let cases: [Case; 3] = [
        (|x| x[2] == 1.0, 25, 2),
        // Around a penny a cavity: a ball without one has a shell for its boundary, too.
        (
            |x| x[2] == 1.0 && (0.5..=1.5).contains(&x[0]) && (0.5..=1.5).contains(&x[1]),
            1,
            2,
        ),
        // From the top to the middle: 3 x 5 vertices without the lowest row.
        (|x| x[0] == 1.0 && x[2] >= 1.0, 10, 1),
    ];
    for (on, copies, number) in cases {
        let mesh = cube(4).with_surface_where("fault", on).unwrap();
        let after = mesh.clone().split("fault").unwrap();
        check(&mesh, &after, &["fault"]);
        assert_eq!(after.vertex_count() - mesh.vertex_count(), copies);
        assert_eq!((euler(&mesh), euler(&after)), (1, number));
    }
}

#[test]
fn faults_cross_and_branch() {
    let mesh = cube(4)
        .with_surface_where("main", |x| x[2] == 1.0)
        .unwrap()
        .with_surface_where("cross", |x| x[0] == 1.0)
        .unwrap()
        .with_surface_where("branch", |x| x[0] == 1.0 && x[2] >= 1.0)
        .unwrap()
        .with_surface_where("slanted", |x| x[2] == x[0] && x[2] >= 1.0)
        .unwrap();
    let count = |mesh: &Mesh<3>| {
        let on = |x: &&Vector3<f64>| x[0] == 1.0 && x[2] == 1.0;
        mesh.vertices().iter().filter(on).count()
    };
    let after = mesh.clone().split_all(["main", "cross"]).unwrap();
    check(&mesh, &after, &["main", "cross"]);
    assert_eq!((count(&after), euler(&after)), (5 * 4, 4));
    for name in ["branch", "slanted"] {
        for names in [["main", name], [name, "main"]] {
            let after = mesh.clone().split_all(names).unwrap();
            check(&mesh, &after, &names);
            // The whole line is an edge of the branch, also its ends at the boundary.
            assert_eq!(count(&after), 5 * 2, "{names:?}");
            assert_eq!(after.vertex_count(), mesh.vertex_count() + 25 + 10);
        }
    }
}

/// A main fault that ends inside, and one across its tip line.
#[test]
fn a_tip_line_stays_one_where_another_fault_passes() {
    let mesh = cube(4)
        .with_surface_where("main", |x| x[2] == 1.0 && x[0] <= 1.0)
        .unwrap()
        .with_surface_where("cross", |x| x[1] == 1.0)
        .unwrap();
    for names in [["main", "cross"], ["cross", "main"]] {
        let after = mesh.clone().split_all(names).unwrap();
        check(&mesh, &after, &names);
        let tip = |x: &&Vector3<f64>| x[0] == 1.0 && x[2] == 1.0 && x[1] == 1.0;
        assert_eq!(after.vertices().iter().filter(tip).count(), 2);
        assert_eq!(after.vertex_count() - mesh.vertex_count(), 10 + 25 + 2);
    }
}

#[test]
fn normals_are_exact_on_a_sphere() {
    let mesh = moved(&cube(4), |x| {
        let (u, v, r) = (
            0.5 * (x[0] - 1.0),
            0.4 * (x[1] - 1.0) + 0.05 * x[0],
            1.0 + x[2],
        );
        Vector3::new(u, v, 1.0).normalize() * r
    });
    let mesh = mesh
        .with_surface_where("fault", |x| (x.norm() - 2.0).abs() < 1e-12)
        .unwrap();
    let space = P1::new(mesh.split("fault").unwrap());
    let minus = space.part("fault-").unwrap();
    let mut inner = 0;
    for (k, (x, n)) in minus.points().iter().zip(minus.normals()).enumerate() {
        let around = minus
            .faces()
            .iter()
            .filter(|face| face.contains(&k))
            .count();
        if around == 6 {
            inner += 1;
            assert!((n - x.normalize()).norm() < 1e-12);
        }
    }
    assert_eq!(inner, 9);
}
