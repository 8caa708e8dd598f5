//! Uniform refinement: nested meshes, exact transfers, few shapes.

use std::collections::BTreeSet;

use nalgebra::{SVector, Vector1};
use stickslip_fem::{BlockMatrix, Hierarchy, Mesh, P1, Prolongation, antiplane};

use crate::common::{levels, regularity, shapes, volume};

fn hierarchies_2d() -> [Hierarchy<2>; 3] {
    [
        P1::grid([5.0, 1.0], [5, 1])
            .unwrap()
            .hierarchy()
            .clone()
            .refined(3)
            .unwrap(),
        P1::mirrored_grid([1.0, 2.0], [2, 3])
            .unwrap()
            .hierarchy()
            .clone()
            .refined(2)
            .unwrap(),
        Hierarchy::new(crate::common::irregular_2d())
            .refined(3)
            .unwrap(),
    ]
}

fn hierarchies_3d() -> [Hierarchy<3>; 2] {
    [
        P1::grid([1.0, 2.0, 1.5], [1, 2, 1])
            .unwrap()
            .hierarchy()
            .clone()
            .refined(2)
            .unwrap(),
        Hierarchy::new(crate::common::irregular_3d())
            .refined(3)
            .unwrap(),
    ]
}

/// The cells of a mesh as sorted bits of the places of their corners.
fn places<const D: usize>(
    mesh: &Mesh<D>,
    place: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
) -> BTreeSet<Vec<Vec<u64>>> {
    let corner = |&p: &u32| {
        let x = place(&mesh.vertices()[p as usize]);
        x.iter().map(|x| (x + 0.0).to_bits()).collect()
    };
    let cell = |cell: &[u32]| {
        let mut corners: Vec<Vec<u64>> = cell.iter().map(corner).collect();
        corners.sort();
        corners
    };
    mesh.cells().map(cell).collect()
}

/// Vertices, cells and their diagonals, before and after a refinement.
#[test]
fn a_mirrored_grid_is_the_mirror_image_of_the_grid() {
    let plane = ([2.0, 1.0], [4, 1]);
    let space = ([2.0, 1.0, 0.5], [4, 1, 2]);
    for times in 0..3 {
        let [grid, mirrored] = [
            P1::<2>::grid(plane.0, plane.1),
            P1::<2>::mirrored_grid(plane.0, plane.1),
        ]
        .map(|grid| grid.unwrap().refined(times).unwrap());
        let cells = places(mirrored.mesh(), |x| *x);
        let image = |x: &SVector<f64, 2>| SVector::from([2.0 - x[0], x[1]]);
        assert_eq!(cells, places(grid.mesh(), image));
        assert_ne!(cells, places(grid.mesh(), |x| *x));

        let [grid, mirrored] = [
            P1::<3>::grid(space.0, space.1),
            P1::<3>::mirrored_grid(space.0, space.1),
        ]
        .map(|grid| grid.unwrap().refined(times).unwrap());
        let cells = places(mirrored.mesh(), |x| *x);
        let image = |x: &SVector<f64, 3>| SVector::from([2.0 - x[0], x[1], x[2]]);
        assert_eq!(cells, places(grid.mesh(), image));
        assert_ne!(cells, places(grid.mesh(), |x| *x));
    }
}

fn check_nested<const D: usize>(hierarchy: &Hierarchy<D>) {
    let levels = levels(hierarchy);
    assert_eq!(levels.len(), hierarchy.prolongations().len() + 1);
    assert_eq!(hierarchy.mesh(levels.len()).map(Mesh::vertex_count), None);
    for (meshes, prolongation) in levels.windows(2).zip(hierarchy.prolongations()) {
        let [coarse, fine] = meshes else {
            unreachable!()
        };
        assert_eq!(fine.cell_count(), coarse.cell_count() << D);
        assert!((0..fine.cell_count()).all(|cell| fine.volume(cell) > 0.0));
        assert!((volume(fine) - volume(coarse)).abs() < 1e-13 * volume(coarse));
        // A refined mesh is a valid mesh: it passes the checks for the user's own, and has the same boundary.
        let again = Mesh::new(
            fine.vertices().to_vec(),
            fine.cells().flatten().copied().collect(),
        )
        .unwrap();
        let faces = |mesh: &Mesh<D>| {
            mesh.boundary()
                .iter()
                .map(|face| face.map(|p| p as usize))
                .map(sorted)
                .collect::<BTreeSet<_>>()
        };
        assert_eq!(faces(&again), faces(fine));
        check_interpolation(prolongation, coarse, fine);
    }
}

fn sorted<const D: usize>(mut face: [usize; D]) -> [usize; D] {
    face.sort_unstable();
    face
}

/// Linear functions, hence the coordinates themselves, are reproduced.
fn check_interpolation<const D: usize>(
    prolongation: &Prolongation,
    coarse: &Mesh<D>,
    fine: &Mesh<D>,
) {
    assert_eq!(
        prolongation.shape(),
        (fine.vertex_count(), coarse.vertex_count())
    );
    for (row, x) in prolongation.outer_iterator().zip(fine.vertices()) {
        let from_coarse: SVector<f64, D> = row
            .iter()
            .map(|(p, &weight)| coarse.vertices()[p] * weight)
            .sum();
        assert!((from_coarse - x).norm() < 1e-14);
        assert!(matches!(row.data(), [1.0] | [0.5, 0.5]));
        assert!(row.indices().is_sorted());
    }
}

#[test]
fn refinements_are_nested_and_transfers_reproduce_linear_functions() {
    hierarchies_2d().iter().for_each(check_nested);
    hierarchies_3d().iter().for_each(check_nested);
}

/// P^T A P, by its definition.
fn galerkin(fine: &BlockMatrix<1>, prolongation: &Prolongation) -> Vec<Vec<f64>> {
    let mut coarse = vec![vec![0.0; prolongation.cols()]; prolongation.cols()];
    for (p, row) in fine.outer_iterator().enumerate() {
        for (q, block) in row.iter() {
            for (i, weight_p) in prolongation.outer_view(p).unwrap().iter() {
                for (j, weight_q) in prolongation.outer_view(q).unwrap().iter() {
                    coarse[i][j] += weight_p * block[0] * weight_q;
                }
            }
        }
    }
    coarse
}

fn check_galerkin<const D: usize>(hierarchy: &Hierarchy<D>) {
    let stiffness: Vec<_> = levels(hierarchy)
        .into_iter()
        .map(|mesh| antiplane(&P1::new(mesh.clone()), 2.0).unwrap())
        .collect();
    for (pair, prolongation) in stiffness.windows(2).zip(hierarchy.prolongations()) {
        for (i, row) in galerkin(&pair[1], prolongation).iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                let assembled = pair[0].get(i, j).map_or(0.0, |block| block[0]);
                assert!(
                    (entry - assembled).abs() < 1e-12,
                    "({i}, {j}): {entry} for {assembled}"
                );
            }
        }
    }
}

#[test]
fn galerkin_products_are_the_coarse_stiffness() {
    hierarchies_2d().iter().for_each(check_galerkin);
    hierarchies_3d().iter().for_each(check_galerkin);
}

#[test]
fn a_tetrahedron_has_at_most_three_shapes_on_all_levels() {
    let mesh = crate::common::irregular_3d();
    for cell in mesh.cells() {
        let corners = cell.iter().map(|&p| mesh.vertices()[p as usize]).collect();
        let hierarchy = Hierarchy::new(Mesh::new(corners, vec![0, 1, 2, 3]).unwrap())
            .refined(4)
            .unwrap();
        let levels = levels(&hierarchy);
        let all: BTreeSet<_> = levels.iter().flat_map(|mesh| shapes(mesh)).collect();
        assert_eq!(all.len(), 3);
        // The first refinement shows the worst shape already.
        let worst = levels
            .iter()
            .map(|mesh| regularity(mesh))
            .fold(1.0, f64::min);
        assert!(worst > (1.0 - 1e-12) * regularity(levels[1]));
    }
}

#[test]
fn triangles_and_kuhn_tetrahedra_keep_their_shape() {
    let pentagon = Hierarchy::new(crate::common::irregular_2d())
        .refined(3)
        .unwrap();
    assert_eq!(shapes(pentagon.finest()), shapes(pentagon.coarsest()));
    let cube = P1::grid([1.0; 3], [1; 3]).unwrap().refined(3).unwrap();
    assert_eq!(shapes(cube.mesh()).len(), 1);
    assert_eq!(shapes(cube.mesh()), shapes(cube.hierarchy().coarsest()));
}

#[test]
fn refining_a_grid_gives_the_finer_grid() {
    let refined = P1::grid([5.0, 1.0], [5, 1]).unwrap().refined(3).unwrap();
    let direct = P1::grid([5.0, 1.0], [40, 8]).unwrap();
    assert!(refined.mesh().vertices() == direct.mesh().vertices());
    let u = |space: &P1<2>| antiplane(space, 1.0).unwrap().into_matrix();
    assert!(u(&refined) == u(&direct));

    let refined = P1::grid([2.0, 4.0, 1.0], [2, 4, 1])
        .unwrap()
        .refined(2)
        .unwrap();
    let direct = P1::grid([2.0, 4.0, 1.0], [8, 16, 4]).unwrap();
    assert!(refined.mesh().vertices() == direct.mesh().vertices());
    let (refined, direct) = (
        antiplane(&refined, 1.0).unwrap(),
        antiplane(&direct, 1.0).unwrap(),
    );
    assert!(refined.indices() == direct.indices());
}

#[test]
fn the_strip_of_the_slider_refines_eight_times() {
    let start = std::time::Instant::now();
    let space = P1::grid([5.0, 1.0], [5, 1]).unwrap().refined(8).unwrap();
    println!("refinement: {:.3} s", start.elapsed().as_secs_f64());
    assert_eq!(space.vertex_count(), 1281 * 257);
    assert_eq!(space.interpolate(|_| Vector1::new(0.0)).len(), 1281 * 257);
    assert_eq!(space.trace(|x| x[1] == 0.0).unwrap().vertices().len(), 1281);
    let start = std::time::Instant::now();
    let stiffness = stickslip_fem::elasticity(
        &space,
        &stickslip_fem::Elastic {
            young_modulus: 5e7,
            poisson_ratio: 0.3,
        },
    )
    .unwrap();
    println!(
        "elasticity: {:.3} s, {} blocks",
        start.elapsed().as_secs_f64(),
        stiffness.nnz()
    );
    assert_eq!(stiffness.rows(), space.vertex_count());
    let start = std::time::Instant::now();
    let mass = stickslip_fem::mass::<2, 2>(&space, 5e3).unwrap();
    println!("mass: {:.3} s", start.elapsed().as_secs_f64());
    assert!(mass.indices() == stiffness.indices());
}
