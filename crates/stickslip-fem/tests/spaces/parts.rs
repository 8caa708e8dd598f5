//! A part of the boundary belongs to one mesh: that of another is refused, however alike they are.

use nalgebra::SVector;
use stickslip_fem::{
    Constraints, FemError, Impedance, Mesh, P1, Trace, antiplane, antiplane_dashpot, dashpot,
    traction,
};

/// Meshes of as many vertices and cells as the first: cut otherwise, of another size, with one vertex moved,
/// with cells in another order.
fn alike<const D: usize>(spaces: [P1<D>; 3]) -> (P1<D>, Vec<P1<D>>) {
    let [space, cut, stretched] = spaces;
    let (vertices, cells) = (space.mesh().vertices(), space.mesh().cells());
    let moved = vertices.iter().enumerate();
    let moved = moved.map(|(p, x)| x.map(|c| if p == 0 { c - 1e-15 } else { c }));
    let flat: Vec<u32> = cells.flatten().copied().collect();
    let mut turned = flat.clone();
    turned.rotate_left(D + 1);
    let moved = Mesh::new(moved.collect(), flat).unwrap();
    let turned = Mesh::new(vertices.to_vec(), turned).unwrap();
    let others = vec![cut, stretched, P1::new(moved), P1::new(turned)];
    for other in &others {
        assert_eq!(other.vertex_count(), space.vertex_count());
        assert_eq!(other.mesh().cell_count(), space.mesh().cell_count());
    }
    (space, others)
}

fn plane() -> (P1<2>, Vec<P1<2>>) {
    let spaces = [
        P1::grid([3.0, 2.0], [3, 2]),
        P1::mirrored_grid([3.0, 2.0], [3, 2]),
        P1::grid([3.0, 4.0], [3, 2]),
    ];
    alike(spaces.map(|space| space.unwrap().refined(1).unwrap()))
}

fn solid() -> (P1<3>, Vec<P1<3>>) {
    let spaces = [[3.0, 2.0, 1.0], [2.0, 3.0, 1.0], [3.0, 2.0, 4.0]];
    let [space, cut, stretched] = spaces.map(|size| {
        let cells = if size[0] < size[1] {
            [2, 3, 1]
        } else {
            [3, 2, 1]
        };
        P1::grid(size, cells).unwrap().refined(1).unwrap()
    });
    alike([space, cut, stretched])
}

fn bottom<const D: usize>(space: &P1<D>) -> Trace<D> {
    space.trace(|x| x[D - 1] < 1e-14).unwrap()
}

fn check<const D: usize>((space, others): (P1<D>, Vec<P1<D>>)) {
    let impedance = Impedance {
        normal: 2.0,
        tangential: 1.0,
    };
    let uses = |part: &Trace<D>| {
        [
            Constraints::<D>::none(&space).fix(part, [true; D]),
            traction(&space, part, |_| SVector::<f64, D>::zeros()).map(|_| ()),
            dashpot(&space, part, |_| impedance).map(|_| ()),
            antiplane_dashpot(&space, part, |_| 1.0).map(|_| ()),
        ]
    };
    let expected = space.mesh().identity();
    let again = P1::new(space.clone().mesh().clone());
    for own in [&space, &again] {
        assert!(uses(&bottom(own)).iter().all(Result::is_ok));
    }
    for other in &others {
        assert_ne!(other.mesh(), space.mesh());
        let found = other.mesh().identity();
        assert_ne!(found, expected);
        let matrix = antiplane(other, 1.0).unwrap();
        assert_eq!(matrix.check_mesh(other.mesh()), Ok(()));
        assert!(matches!(
            matrix.check_mesh(space.mesh()),
            Err(FemError::Mesh { what: "matrix", .. })
        ));
        for refused in uses(&bottom(other)) {
            let error = FemError::Mesh {
                what: "part of the boundary",
                expected,
                found,
            };
            let text = error.to_string();
            for mesh in [space.mesh(), other.mesh()] {
                for size in [mesh.vertex_count(), mesh.cell_count()] {
                    assert!(text.contains(&size.to_string()), "{text}");
                }
            }
            assert_eq!(refused, Err(error));
        }
    }
}

#[test]
fn parts_of_other_meshes_are_refused() {
    check(plane());
    check(solid());
}

#[test]
fn equal_meshes_have_equal_fingerprints() {
    let mesh = |low: f64| {
        let mut points = crate::common::irregular_2d().vertices().to_vec();
        points[0][0] = low;
        let mesh = crate::common::irregular_2d();
        Mesh::new(points, mesh.cells().flatten().copied().collect()).unwrap()
    };
    assert_eq!(mesh(0.0), mesh(-0.0));
    assert_eq!(mesh(0.0).fingerprint(), mesh(-0.0).fingerprint());
}
