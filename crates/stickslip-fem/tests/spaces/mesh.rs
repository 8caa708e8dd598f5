//! Meshes: what is accepted, what boxes are, what is refused with which numbers.

use crate::{empty, illegal, not_positive, repeated};
use nalgebra::{Vector2, Vector3};
use stickslip_fem::{FemError, GridDiagonal, Mesh, P1};

fn square() -> Vec<Vector2<f64>> {
    [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        .map(|(x, y)| Vector2::new(x, y))
        .to_vec()
}

fn volume<const D: usize>(mesh: &Mesh<D>) -> f64 {
    (0..mesh.cell_count()).map(|cell| mesh.volume(cell)).sum()
}

#[test]
fn bad_meshes_are_refused() {
    let new = |cells: &[u32]| Mesh::new(square(), cells.to_vec()).map(|_| ());
    assert_eq!(new(&[0, 1, 2, 0, 2, 3]), Ok(()));
    assert_eq!(new(&[]), Err(empty("cells")));
    assert_eq!(
        new(&[0, 1, 2, 0]),
        Err(FemError::Length {
            what: "vertex indices, which are not those of whole cells",
            expected: 6,
            found: 4
        })
    );
    assert_eq!(
        new(&[0, 1, 2, 0, 2, 4]),
        Err(FemError::OutOfRange {
            what: "vertex",
            index: 4,
            count: 4,
            by: "cell 1".into()
        })
    );
    assert_eq!(
        new(&[0, 1, 2]),
        Err(FemError::Point {
            what: "vertex",
            index: 3,
            requirement: "a cell"
        })
    );
    assert_eq!(
        new(&[0, 1, 2, 0, 3, 2]),
        Err(FemError::DegenerateCell {
            level: None,
            cell: 1,
            volume: -0.5
        })
    );
    assert_eq!(
        new(&[0, 1, 2, 0, 3, 3]),
        Err(FemError::DegenerateCell {
            level: None,
            cell: 1,
            volume: 0.0
        })
    );
    assert_eq!(
        new(&[0, 1, 2, 0, 2, 3, 1, 2, 0, 2, 3, 0]),
        Err(repeated("cells", [0, 2]))
    );

    let mut points = square();
    points[2][1] = f64::NAN;
    assert_eq!(
        Mesh::new(points, vec![0, 1, 2, 0, 2, 3]),
        Err(FemError::Point {
            what: "vertex",
            index: 2,
            requirement: "finite coordinates"
        })
    );
}

/// A tetrahedron on the triangle 0 1 2 with its tip above or below it.
fn on_triangle(tip: u32, above: bool) -> [u32; 4] {
    if above {
        [0, 1, 2, tip]
    } else {
        [1, 0, 2, tip]
    }
}

#[test]
fn folded_meshes_are_refused() {
    // Three triangles over the edge 0 1, one below it.
    let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.7, 0.6), (0.3, -1.0)];
    let points = points.map(|(x, y)| Vector2::new(x, y)).to_vec();
    let new = |cells: &[[u32; 3]]| {
        let vertices = 1 + cells.iter().flatten().max().copied().unwrap_or(0);
        let points = points[..vertices as usize].to_vec();
        Mesh::new(points, cells.concat()).map(|mesh| mesh.boundary().len())
    };
    let (up, down) = ([0, 1, 2], [4, 1, 0]);
    assert_eq!(new(&[up, [0, 1, 3]]), folded(&[0, 1], &[0, 1]));
    assert_eq!(new(&[up, [3, 0, 1], down]), folded(&[0, 1, 2], &[0, 1]));
    assert_eq!(new(&[up, [1, 2, 0]]), Err(repeated("cells", [0, 1])));
    // The same cell at a face that a third one shares.
    assert_eq!(
        new(&[[1, 3, 2], up, [1, 2, 0]]),
        Err(repeated("cells", [1, 2]))
    );
    assert_eq!(new(&[up, [1, 3, 2]]), Ok(4));

    let points = [
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (0.2, 0.2),
        (0.3, 0.3),
        (0.1, 0.1),
    ];
    let heights = [0.0, 0.0, 0.0, 1.0, 0.5, -1.0];
    let points: Vec<_> = points
        .iter()
        .zip(heights)
        .map(|(&(x, y), z)| Vector3::new(x, y, z))
        .collect();
    let new = |cells: &[[u32; 4]]| {
        let vertices = 1 + cells.iter().flatten().max().copied().unwrap_or(0);
        let points = points[..vertices as usize].to_vec();
        Mesh::new(points, cells.concat()).map(|mesh| mesh.boundary().len())
    };
    let (high, low) = (on_triangle(3, true), on_triangle(4, true));
    assert_eq!(new(&[high, low]), folded(&[0, 1], &[0, 1, 2]));
    let [a, b, c, d] = low;
    assert_eq!(new(&[[c, a, b, d], high]), folded(&[0, 1], &[0, 1, 2]));
    assert_eq!(
        new(&[high, low, on_triangle(5, false)]),
        folded(&[0, 1, 2], &[0, 1, 2])
    );
    let [a, b, c, d] = high;
    assert_eq!(new(&[high, [b, c, a, d]]), Err(repeated("cells", [0, 1])));
    // Above and below the triangle, without the second tip: a mesh.
    let two = [points[0], points[1], points[2], points[3], points[5]];
    let mesh = Mesh::new(two.to_vec(), [high, on_triangle(4, false)].concat());
    assert_eq!(mesh.map(|mesh| mesh.boundary().len()), Ok(6));
}

fn folded(cells: &[usize], face: &[u32]) -> Result<usize, FemError> {
    Err(FemError::FoldedCells {
        cells: cells.to_vec(),
        face: face.to_vec(),
    })
}

#[test]
fn cells_flat_up_to_rounding_are_refused() {
    let points = vec![
        Vector2::new(0.1, 0.1),
        Vector2::new(0.2, 0.2),
        Vector2::new(0.3, 0.3 + 1e-17),
        Vector2::new(0.3, 0.3 + 1e-16),
    ];
    let flat = Mesh::new(points, vec![0, 1, 2, 0, 1, 3]);
    assert!(
        matches!(flat, Err(FemError::DegenerateCell { volume, .. }) if volume.abs() < 1e-16),
        "{flat:?}"
    );
    let inverted = vec![Vector3::zeros(), Vector3::x(), Vector3::z(), Vector3::y()];
    assert_eq!(
        Mesh::new(inverted, vec![0, 1, 2, 3]),
        Err(FemError::DegenerateCell {
            level: None,
            cell: 0,
            volume: -1.0 / 6.0
        })
    );
}

#[test]
fn bad_boxes_are_refused() {
    let size = |size| P1::grid([1.0, size], [1, 1]).map(|_| ());
    assert_eq!(size(0.0), Err(not_positive("size [m] along axis 1", 0.0)));
    assert_eq!(size(-2.0), Err(not_positive("size [m] along axis 1", -2.0)));
    assert!(matches!(
        size(f64::NAN),
        Err(FemError::Value {
            what: "size [m] along axis 1",
            ..
        })
    ));
    assert!(matches!(
        size(f64::INFINITY),
        Err(FemError::Value {
            what: "size [m] along axis 1",
            ..
        })
    ));
    let cells = |cells| Mesh::<3>::grid([1.0; 3], cells).map(|_| ());
    assert_eq!(
        cells([1, 0, 1]),
        Err(illegal("number of cells along axis 1", "at least 1", 0.0))
    );
    assert_eq!(
        cells([1625, 1625, 1625]),
        Err(FemError::TooMany {
            what: "vertices",
            count: 1626_u64.pow(3)
        })
    );
    assert_eq!(
        cells([usize::MAX; 3]),
        Err(FemError::TooMany {
            what: "vertices",
            count: u64::MAX
        })
    );
}

#[test]
fn refinement_beyond_32_bits_is_refused_at_once() {
    let space = P1::grid([5.0, 1.0], [5, 1]).unwrap();
    assert!(matches!(
        space.clone().refined(15),
        Err(FemError::TooMany {
            what: "vertices",
            ..
        })
    ));
    assert!(matches!(
        space.refined(1000),
        Err(FemError::TooMany {
            what: "vertices",
            ..
        })
    ));
}

#[test]
fn boxes_fill_their_size_with_positive_cells() {
    for diagonal in [GridDiagonal::Rising, GridDiagonal::Falling] {
        let mesh = Mesh::<2>::grid([0.7, 1.9], [3, 4], diagonal).unwrap();
        assert_eq!(
            (
                mesh.vertex_count(),
                mesh.cell_count(),
                mesh.boundary().len()
            ),
            (20, 24, 14)
        );
        assert!((0..24).all(|cell| (mesh.volume(cell) - 0.7 * 1.9 / 24.0).abs() < 1e-15));
        assert!((volume(&mesh) - 0.7 * 1.9).abs() < 1e-14);
    }
    let mesh = Mesh::<3>::grid([0.7, 1.9, 0.4], [3, 4, 2]).unwrap();
    assert_eq!((mesh.vertex_count(), mesh.cell_count()), (60, 144));
    assert_eq!(mesh.boundary().len(), 2 * 2 * (12 + 8 + 6));
    assert!((volume(&mesh) - 0.7 * 1.9 * 0.4).abs() < 1e-14);
}

#[test]
fn diagonals_run_as_named() {
    let joins = |diagonal, a, b| {
        let mesh = Mesh::<2>::grid([1.0, 1.0], [1, 1], diagonal).unwrap();
        let at = |x| {
            mesh.vertices()
                .iter()
                .position(|y| *y == Vector2::from(x))
                .unwrap() as u32
        };
        mesh.cells()
            .all(|cell| cell.contains(&at(a)) && cell.contains(&at(b)))
    };
    assert!(joins(GridDiagonal::Rising, [0.0, 0.0], [1.0, 1.0]));
    assert!(joins(GridDiagonal::Falling, [0.0, 1.0], [1.0, 0.0]));
}

#[test]
fn far_ends_of_boxes_are_exact() {
    // 49 is a number of cells for which size * 49 / 49 differs from some sizes.
    for size in [0.1, 0.7, 1.0 / 3.0, 1e-3, 12345.6789] {
        let space = P1::grid([size, 2.0 * size], [49, 7])
            .unwrap()
            .refined(1)
            .unwrap();
        assert_eq!(space.trace(|x| x[0] == size).unwrap().vertices().len(), 15);
        assert_eq!(
            space
                .trace(|x| x[1] == 2.0 * size)
                .unwrap()
                .vertices()
                .len(),
            99
        );
    }
}

/// The integral of x . n over the boundary is D times the volume.
fn boundary_flux<const D: usize>(
    mesh: &Mesh<D>,
    normal: impl Fn([nalgebra::SVector<f64, D>; D]) -> nalgebra::SVector<f64, D>,
) -> f64 {
    let flux = |face: &[u32; D]| {
        let corners = face.map(|p| mesh.vertices()[p as usize]);
        corners
            .iter()
            .sum::<nalgebra::SVector<f64, D>>()
            .dot(&normal(corners))
            / D as f64
    };
    mesh.boundary().iter().map(flux).sum()
}

#[test]
fn boundary_normals_point_outward_on_every_level() {
    let space = P1::new(crate::common::irregular_2d()).refined(2).unwrap();
    for level in 0..3 {
        let mesh = space.hierarchy().mesh(level).unwrap();
        let flux = boundary_flux(mesh, |[a, b]| Vector2::new(b[1] - a[1], a[0] - b[0]));
        assert!((flux - 2.0 * volume(mesh)).abs() < 1e-13);
    }
    for space in [
        P1::new(crate::common::irregular_3d()),
        P1::grid([1.0, 2.0, 3.0], [1, 2, 1]).unwrap(),
    ] {
        let space = space.refined(2).unwrap();
        for level in 0..3 {
            let mesh = space.hierarchy().mesh(level).unwrap();
            let flux = boundary_flux(mesh, |[a, b, c]| 0.5 * (b - a).cross(&(c - a)));
            assert!((flux - 3.0 * volume(mesh)).abs() < 1e-13);
        }
    }
}
