//! Levels below a mesh: some of its vertices, and linear interpolation between them.

use nalgebra::SVector;
use stickslip_fem::{GridDiagonal, Hierarchy, Mesh, P1, Prolongation};

/// The coarse vertices: each is one fine vertex, whose row is a single 1.
fn copies(prolongation: &Prolongation) -> Vec<usize> {
    let mut copies = vec![None; prolongation.cols()];
    for (fine, row) in prolongation.outer_iterator().enumerate() {
        if let [coarse] = *row.indices() {
            assert_eq!(row.data(), [1.0]);
            assert_eq!(copies[coarse as usize].replace(fine), None);
        }
    }
    copies.into_iter().map(Option::unwrap).collect()
}

fn check<const D: usize>(mesh: &Mesh<D>) {
    let hierarchy = Hierarchy::new(mesh.clone())
        .with_auxiliary_levels()
        .unwrap();
    assert_eq!(hierarchy.finest(), mesh);
    let mut points = mesh.vertices().to_vec();
    let diameter = points
        .iter()
        .map(|x| (x - points[0]).norm())
        .fold(0.0, f64::max);
    for prolongation in hierarchy.prolongations().iter().rev() {
        assert_eq!(prolongation.rows(), points.len());
        assert!(10 * prolongation.cols() <= 7 * prolongation.rows());
        let coarse: Vec<SVector<f64, D>> = copies(prolongation)
            .into_iter()
            .map(|p| points[p])
            .collect();
        for (row, x) in prolongation.outer_iterator().zip(&points) {
            let sum: f64 = row.data().iter().sum();
            assert!((sum - 1.0).abs() < 1e-9);
            let absolute: f64 = row.data().iter().map(|w| w.abs()).sum();
            assert!(absolute <= 2.0);
            let there: SVector<f64, D> = row.iter().map(|(q, w)| coarse[q] * *w).sum();
            assert!(
                (there - x).norm() <= 1e-9 * diameter,
                "{row:?} gives {there}, not {x}"
            );
            assert!(row.indices().is_sorted());
        }
        points = coarse;
    }
}

/// Reproducible numbers in [-1, 1) (splitmix64).
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 5_u64;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A mesh with its vertices elsewhere.
fn moved<const D: usize>(
    mesh: &Mesh<D>,
    to: impl FnMut(&SVector<f64, D>) -> SVector<f64, D>,
) -> Mesh<D> {
    Mesh::new(
        mesh.vertices().iter().map(to).collect(),
        mesh.cells().flatten().copied().collect(),
    )
    .unwrap()
}

#[test]
fn linear_functions_are_reproduced_on_every_level() {
    let mut number = numbers();
    let plane = P1::grid([5.0, 1.0], [60, 12]).unwrap();
    check(plane.mesh());
    check(&moved(plane.mesh(), |x| x.map(|x| x + 0.02 * number())));
    // Graded by a factor of 300 towards the bottom.
    check(&moved(plane.mesh(), |x| {
        [x[0], (6.0 * (x[1] - 1.0)).exp()].into()
    }));
    // A ring segment, and one that is nearly closed and one cell thick at the second level.
    for (thickness, angle) in [(1.0, 2.0), (0.05, 6.0)] {
        let ring = |x: &SVector<f64, 2>| {
            let (radius, angle) = (1.0 + thickness * x[1], angle * x[0] / 5.0);
            [-radius * angle.cos(), radius * angle.sin()].into()
        };
        check(&moved(plane.mesh(), ring));
    }
    let solid = P1::<3>::grid([2.0, 1.0, 1.0], [14, 7, 7]).unwrap();
    check(solid.mesh());
    check(&moved(solid.mesh(), |x| x.map(|x| x + 0.03 * number())));
    let turned = nalgebra::Rotation3::from_euler_angles(0.3, 0.7, 1.1);
    check(&moved(solid.mesh(), |x| turned * x));
    let bent = |x: &SVector<f64, 3>| {
        let radius = 1.0 + x[1];
        [-radius * x[0].cos(), radius * x[0].sin(), x[2]].into()
    };
    check(&moved(solid.mesh(), bent));
}

/// The lips of a slit share no cell. A function of one of them is not seen on the other.
#[test]
fn nothing_is_interpolated_across_a_slit() {
    let plane = P1::grid([1.0, 1.0], [20, 20]).unwrap();
    let size = plane.vertex_count() as u32;
    // Every cell above y = 1/2 has vertices of its own.
    let (mut vertices, mut cells) = (plane.mesh().vertices().to_vec(), Vec::new());
    vertices.extend_from_within(..);
    for cell in plane.mesh().cells() {
        let middle = cell.iter().map(|&p| vertices[p as usize][1]).sum::<f64>() / 3.0;
        cells.extend(
            cell.iter()
                .map(|&p| if middle > 0.5 { p + size } else { p }),
        );
    }
    let mut used: Vec<u32> = cells.clone();
    used.sort_unstable();
    used.dedup();
    let vertices = used.iter().map(|&p| vertices[p as usize]).collect();
    let above: Vec<bool> = used.iter().map(|&p| p >= size).collect();
    let cells = cells
        .iter()
        .map(|p| used.partition_point(|q| q < p) as u32)
        .collect();
    let cut = Mesh::new(vertices, cells).unwrap();
    check(&cut);
    let hierarchy = Hierarchy::new(cut).with_auxiliary_levels().unwrap();
    let mut above = above;
    for prolongation in hierarchy.prolongations().iter().rev() {
        let coarse: Vec<bool> = copies(prolongation).into_iter().map(|p| above[p]).collect();
        for (row, &above) in prolongation.outer_iterator().zip(&above) {
            assert!(row.indices().iter().all(|&q| coarse[q as usize] == above));
        }
        above = coarse;
    }
}

#[test]
fn split_meshes_have_levels() {
    let plane = Mesh::<2>::grid([2.0, 2.0], [8, 8], GridDiagonal::Rising)
        .unwrap()
        .with_surface_where("main", |x| x[1] == 1.0 && x[0] <= 1.5)
        .unwrap()
        .with_surface_where("splay", |x| x[1] == x[0] && x[0] >= 1.0 && x[0] <= 1.5)
        .unwrap()
        .split_all(["main", "splay"])
        .unwrap();
    let graded = P1::new(plane).graded(|x| 0.01 + 0.2 * (x[0] - 1.0).abs());
    check(graded.unwrap().mesh());
    let solid = Mesh::<3>::grid([2.0; 3], [8; 3])
        .unwrap()
        .with_surface_where("fault", |x| x[2] == 1.0 && x[0] <= 1.0)
        .unwrap()
        .split("fault")
        .unwrap();
    check(&solid);
}

#[test]
fn levels_are_added_once_below_the_coarsest_mesh() {
    let space = P1::grid([5.0, 1.0], [40, 8]).unwrap();
    let (_, none) = space.transfers();
    assert!(none.is_empty());
    let space = space.refined(1).unwrap().with_auxiliary_levels().unwrap();
    let (mesh, transfers) = space.transfers();
    assert_eq!(mesh, space.mesh().identity());
    let below = transfers.len() - 1;
    assert!(below > 0);
    assert!(
        transfers
            .windows(2)
            .all(|pair| pair[0].rows() == pair[1].cols())
    );
    assert_eq!(transfers[below].shape(), (81 * 17, 41 * 9));
    assert_eq!(space.hierarchy().level_count(), 2);
    let again = space.clone().with_auxiliary_levels().unwrap();
    assert_eq!(again.transfers().1.len(), transfers.len());
    // Refined afterwards, the space has the same levels below.
    let first = P1::grid([5.0, 1.0], [40, 8])
        .unwrap()
        .with_auxiliary_levels()
        .unwrap();
    assert_eq!(first.refined(1).unwrap().transfers(), space.transfers());
    let small = P1::grid([1.0, 1.0], [9, 9])
        .unwrap()
        .with_auxiliary_levels()
        .unwrap();
    assert!(small.transfers().1.is_empty());
}

#[cfg(feature = "gmsh")]
#[test]
fn meshes_of_the_examples_have_levels() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/meshes");
    check(&stickslip_fem::gmsh::read::<2>(folder.join("slider.msh")).unwrap());
    let block = stickslip_fem::gmsh::read::<3>(folder.join("block.msh")).unwrap();
    check(P1::new(block).refined(1).unwrap().mesh());
}
