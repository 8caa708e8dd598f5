//! NonconformingNodes: what is whole has none, and what is open is found, wherever the mesh lies.

use crate::negative;
use nalgebra::{SMatrix, SVector};
use stickslip_fem::{FemError, Mesh, NonconformingNodes, P1};

/// Two meshes in one, with the vertices at one place merged or not.
fn union<const D: usize>(below: &Mesh<D>, above: &Mesh<D>, shift: f64, merge: bool) -> Mesh<D> {
    let mut points = below.vertices().to_vec();
    let mut places = Vec::new();
    for x in above.vertices() {
        let x = SVector::from_fn(|c, _| if c == D - 1 { x[c] + shift } else { x[c] });
        let same = below.vertices().iter().position(|y| merge && *y == x);
        places.push(same.unwrap_or(points.len()) as u32);
        if same.is_none() {
            points.push(x);
        }
    }
    let cells = below.cells().flatten().copied();
    let others = above.cells().flatten().map(|&p| places[p as usize]);
    Mesh::new(points, cells.chain(others).collect()).unwrap()
}

fn grid<const D: usize>(cells: usize) -> Mesh<D> {
    P1::grid([1.0; D], [cells; D]).unwrap().mesh().clone()
}

/// The mesh moved, turned and sheared.
fn elsewhere<const D: usize>(mesh: &Mesh<D>) -> Mesh<D> {
    let turn = SMatrix::<f64, D, D>::from_fn(|i, j| [0.9, -0.4, 0.3, 0.2, 0.8][(i * 2 + j) % 5]);
    let sign = turn.as_slice().iter().sum::<f64>().signum();
    let points = mesh
        .vertices()
        .iter()
        .map(|x| turn * x + SVector::repeat(3.0 * sign));
    let mut cells: Vec<u32> = mesh.cells().flatten().copied().collect();
    let points: Vec<_> = points.collect();
    if Mesh::new(points.clone(), cells.clone()).is_err() {
        cells
            .chunks_exact_mut(D + 1)
            .for_each(|cell| cell.swap(0, 1));
    }
    Mesh::new(points, cells).unwrap()
}

fn cracks<const D: usize>(mesh: &Mesh<D>) -> NonconformingNodes<D> {
    let found = mesh.nonconforming_nodes(1e-12).unwrap();
    let other = elsewhere(mesh).nonconforming_nodes(1e-12).unwrap();
    assert_eq!(found.vertices, other.vertices);
    assert_eq!(found.hanging.len(), other.hanging.len());
    assert_eq!(found.faces.len(), other.faces.len());
    found
}

fn check_whole<const D: usize>(meshes: &[Mesh<D>]) {
    for mesh in meshes {
        assert_eq!(cracks(mesh), NonconformingNodes::default());
        assert_eq!(
            mesh.nonconforming_nodes(0.0),
            Ok(NonconformingNodes::default())
        );
    }
}

#[test]
fn whole_meshes_have_no_cracks() {
    check_whole(&[grid::<2>(1), grid(5), crate::common::irregular_2d()]);
    check_whole(&[grid::<3>(1), grid(3), crate::common::irregular_3d()]);
    check_whole(&[union(&grid::<2>(3), &grid(3), 1.0, true)]);
    check_whole(&[union(&grid::<3>(2), &grid(2), 1.0, true)]);
    let slit = P1::new(crate::common::irregular_3d()).refined(2).unwrap();
    check_whole(&[slit.mesh().clone()]);
}

/// All vertices and faces of the interface are there twice.
fn check_unmerged<const D: usize>(vertices: usize, faces: usize) {
    let mesh = union(&grid::<D>(3), &grid(3), 1.0, false);
    let found = cracks(&mesh);
    assert_eq!((found.vertices.len(), found.faces.len()), (vertices, faces));
    assert!(found.hanging.is_empty());
    for [p, q] in &found.vertices {
        assert!(p < q);
        assert_eq!(mesh.vertices()[*p as usize], mesh.vertices()[*q as usize]);
    }
    for [below, above] in &found.faces {
        let points = |face: &[u32; D]| {
            let mut points = face.map(|p| mesh.vertices()[p as usize]);
            points.sort_by(|a, b| {
                a.partial_cmp(b)
                    .unwrap_or(a.as_slice().partial_cmp(b.as_slice()).unwrap())
            });
            points
        };
        assert_eq!(points(below), points(above));
    }
    // A slit that is wider than what counts as one point.
    let open = union(&grid::<D>(3), &grid(3), 1.0 + 1e-9, false);
    assert!(open.nonconforming_nodes(0.9e-9).unwrap().is_empty());
    let closed = open.nonconforming_nodes(1.1e-9).unwrap();
    assert_eq!(
        (closed.vertices.len(), closed.faces.len()),
        (vertices, faces)
    );
}

#[test]
fn unmerged_vertices_are_found() {
    check_unmerged::<2>(4, 3);
    check_unmerged::<3>(16, 18);
}

/// The side above the interface is cut twice as finely.
#[test]
fn hanging_vertices_are_found() {
    let found = cracks(&union(&grid::<2>(1), &grid(2), 1.0, true));
    assert_eq!(found.hanging.len(), 1);
    assert!(found.vertices.is_empty() && found.faces.is_empty());
    // Of eleven inner vertices above, two are corners below.
    let found = cracks(&union(&grid::<2>(3), &grid(12), 1.0, true));
    assert_eq!(found.hanging.len(), 9);

    let mesh = union(&grid::<3>(1), &grid(2), 1.0, true);
    let found = cracks(&mesh);
    // The midpoints of four edges, each on a face of the interface and on one beside it; that of the diagonal, on
    // two of the interface.
    assert_eq!(found.hanging.len(), 10);
    let mut vertices: Vec<u32> = found.hanging.iter().map(|hanging| hanging.vertex).collect();
    vertices.sort_unstable();
    vertices.dedup();
    assert_eq!(vertices.len(), 5);
    for hanging in &found.hanging {
        let x = mesh.vertices()[hanging.vertex as usize];
        assert!(x[2] == 1.0 && x.iter().filter(|&&c| c == 0.5).count() >= 1);
        assert!(!hanging.face.contains(&hanging.vertex));
    }
    assert!(found.vertices.is_empty() && found.faces.is_empty());

    // Neither merged nor equally fine: corners coincide, the other vertices hang.
    let found = cracks(&union(&grid::<3>(1), &grid(2), 1.0, false));
    assert_eq!(found.vertices.len(), 4);
    assert_eq!(found.hanging.len(), 10);
}

#[test]
fn distances_must_be_numbers() {
    let mesh = grid::<2>(1);
    for value in [-1e-12, f64::INFINITY] {
        assert_eq!(
            mesh.nonconforming_nodes(value),
            Err(negative("distance [m]", value))
        );
    }
    assert!(matches!(
        mesh.nonconforming_nodes(f64::NAN),
        Err(FemError::Value {
            what: "distance [m]",
            ..
        })
    ));
}
