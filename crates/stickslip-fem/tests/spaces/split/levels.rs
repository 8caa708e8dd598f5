//! Pairs over refinement, grading and auxiliary levels.

use nalgebra::{Vector2, Vector3};
use stickslip_fem::{GridDiagonal, Hierarchy, Mesh, P1};

use super::{check_sides, euler};
use crate::common::volume;

fn plane(n: usize) -> Mesh<2> {
    Mesh::<2>::grid([2.0, 2.0], [n, n], GridDiagonal::Rising)
        .unwrap()
        .with_surface_where("main", |x| x[1] == 1.0)
        .unwrap()
        .with_surface_where("cross", |x| x[0] == x[1] && (0.5..=1.5).contains(&x[0]))
        .unwrap()
        .with_surface_where("splay", |x| x[0] == 0.5 && (0.5..=1.0).contains(&x[1]))
        .unwrap()
}

fn solid(n: usize) -> Mesh<3> {
    Mesh::<3>::grid([2.0; 3], [n; 3])
        .unwrap()
        .with_surface_where("main", |x| x[2] == 1.0)
        .unwrap()
        .with_surface_where("cross", |x| x[0] == x[2] && (0.5..=1.5).contains(&x[0]))
        .unwrap()
        .with_surface_where("splay", |x| x[0] == 0.5 && x[2] >= 1.0 && x[1] >= 0.5)
        .unwrap()
}

const NAMES: [&str; 3] = ["main", "cross", "splay"];

/// The number of pairs that are not tips.
fn open<const D: usize>(space: &P1<D>, name: &str) -> usize {
    let plus = space.part(&format!("{name}+")).unwrap();
    let pairs = plus.opposite().unwrap().iter().zip(plus.vertices());
    pairs.filter(|(p, q)| p != q).count()
}

fn follows<const D: usize>(whole: Mesh<D>) {
    let split = whole.clone().split_all(NAMES).unwrap();
    let number = euler(&split);
    let uniform = P1::new(split.clone()).refined(2).unwrap();
    let graded = P1::new(split.clone())
        .graded(|x| 0.1 + 0.3 * (x[0] - 0.7).abs() + 0.2 * (x[D - 1] - 1.0).abs())
        .unwrap();
    let mixed = P1::new(split.clone()).refined(1).unwrap();
    let mixed = mixed
        .graded(|x| 0.1 + 0.4 * x[0])
        .unwrap()
        .refined(1)
        .unwrap();
    // Both sides start from one mesh of bisected cells.
    let bisected = P1::new(whole).graded(|x| 0.2 + 0.2 * x[0]).unwrap();
    assert_eq!(bisected.mesh().surfaces().count(), 3);
    let bisected = P1::new(bisected.mesh().clone().split_all(NAMES).unwrap());
    let bisected = bisected.graded(|x| 0.1 + 0.2 * x[D - 1]).unwrap();
    for space in [uniform, graded, mixed, bisected] {
        for name in NAMES {
            check_sides(&space, name);
            let [own, first] = [open(&space, name), open(&P1::new(split.clone()), name)];
            assert!(own > first, "{name} {own} {first}");
        }
        let rounding = space.mesh().cell_count() as f64 * f64::EPSILON * volume(&split);
        assert!((volume(space.mesh()) - volume(&split)).abs() < rounding);
        assert_eq!(euler(space.mesh()), number);
        let cells = space.mesh().cells().flatten().copied().collect();
        let fresh = Mesh::new(space.mesh().vertices().to_vec(), cells).unwrap();
        assert_eq!(fresh.boundary().len(), space.mesh().boundary().len());
        // Merged, the sides have no hanging vertices.
        let cracks = space.mesh().nonconforming_nodes(1e-10).unwrap();
        assert!(cracks.hanging.is_empty());
    }
}

#[test]
fn pairs_are_refined_alike() {
    follows(plane(8));
    follows(solid(4));
}

/// Before a split the surfaces have the children of their faces.
#[test]
fn surfaces_are_refined() {
    let area = |mesh: &Mesh<3>, name: &str| {
        let split = P1::new(mesh.clone().split(name).unwrap());
        split.part(&format!("{name}+")).unwrap().measure()
    };
    let whole = solid(4);
    let uniform = P1::new(whole.clone()).refined(1).unwrap();
    let graded = P1::new(whole.clone())
        .graded(|x| 0.25 + 0.3 * x[0])
        .unwrap();
    for name in NAMES {
        let first = area(&whole, name);
        assert!((area(uniform.mesh(), name) - first).abs() < 1e-12);
        assert!((area(graded.mesh(), name) - first).abs() < 1e-12);
    }
    let after = whole.split("main").unwrap();
    let space = P1::new(after).refined(1).unwrap();
    let after = space.mesh().clone().split_all(["cross", "splay"]).unwrap();
    let space = P1::new(after);
    NAMES.iter().for_each(|name| check_sides(&space, name));
}

/// New vertices of one side are moved onto a curve: those of the other follow.
#[test]
fn both_sides_follow_a_curve() {
    let mesh = Mesh::<2>::grid([2.0, 2.0], [4, 4], GridDiagonal::Rising).unwrap();
    let mesh = mesh
        .with_surface_where("fault", |x| x[1] == 1.0 && x[0] <= 1.5)
        .unwrap();
    let space = P1::new(mesh.split("fault").unwrap());
    let onto = |x: &Vector2<f64>| Vector2::new(x[0], 1.0 + 0.05 * (4.0 * x[0]).sin());
    let uniform = space.clone().refined_onto(2, "fault+", onto).unwrap();
    let graded = space
        .graded_onto(|x| 0.1 + 0.2 * x[0], "fault-", onto)
        .unwrap();
    for space in [uniform, graded] {
        check_sides(&space, "fault");
        let plus = space.part("fault+").unwrap();
        assert!(plus.points().iter().any(|x| (x[1] - 1.0).abs() > 0.02));
    }
}

/// Coinciding vertices are kept together.
fn keeps_pairs<const D: usize>(mesh: &Mesh<D>) {
    let hierarchy = Hierarchy::new(mesh.clone())
        .with_auxiliary_levels()
        .unwrap();
    assert!(!hierarchy.prolongations().is_empty());
    let space = P1::new(mesh.clone());
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for name in NAMES {
        let plus = space.part(&format!("{name}+")).unwrap();
        let both = plus.vertices().iter().zip(plus.opposite().unwrap());
        pairs.extend(both.map(|(&p, &q)| [p, q]).filter(|[p, q]| p != q));
    }
    for prolongation in hierarchy.prolongations().iter().rev() {
        let mut coarse = vec![None; prolongation.rows()];
        for (fine, row) in prolongation.outer_iterator().enumerate() {
            if let [only] = *row.indices() {
                assert_eq!(row.data(), [1.0]);
                coarse[fine] = Some(only as usize);
            }
        }
        let kept = pairs.iter().filter_map(|&[p, q]| {
            assert_eq!(coarse[p].is_some(), coarse[q].is_some());
            Some([coarse[p]?, coarse[q]?])
        });
        let kept: Vec<_> = kept.collect();
        assert!(10 * kept.len() < 8 * pairs.len());
        pairs = kept;
    }
    assert!(!pairs.is_empty());
}

#[test]
fn coarser_levels_keep_pairs() {
    let moved = |x: &Vector2<f64>| {
        x.map(|c| c + 0.3 * (c * (2.0 - c)) * (7.0 * x[0] + 3.0 * x[1]).sin() / 16.0)
    };
    let grid = P1::new(plane(8).split_all(NAMES).unwrap())
        .refined(2)
        .unwrap();
    keeps_pairs(grid.mesh());
    let graded = P1::new(plane(8).split_all(NAMES).unwrap());
    let graded = graded.graded(|x| 0.02 + 0.3 * (moved(x) - Vector2::new(0.5, 1.0)).norm());
    keeps_pairs(graded.unwrap().mesh());
    let block = P1::new(solid(4).split_all(NAMES).unwrap())
        .refined(1)
        .unwrap();
    keeps_pairs(block.mesh());
    let graded = P1::new(solid(4).split_all(NAMES).unwrap());
    let graded = graded.graded(|x| 0.15 + 0.4 * (x - Vector3::new(0.5, 1.0, 1.0)).norm());
    keeps_pairs(graded.unwrap().mesh());
}
