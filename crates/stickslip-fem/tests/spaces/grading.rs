//! Graded meshes: conforming, nested, as fine as asked for and not much finer, of few shapes.

use std::collections::BTreeSet;

use nalgebra::{Matrix1x2, SMatrix, SVector, Vector1, Vector2};
use stickslip_fem::{Constraints, FemError, Hierarchy, Mesh, P1, antiplane, h1_error};

use crate::common::{Numbers, levels, regularity, shapes, solve, volume};

/// A box whose inner vertices are moved at random, by up to a sixth of a cell along each axis.
fn shaken<const D: usize>(cells: [usize; D], numbers: &mut Numbers) -> Mesh<D> {
    let size = cells.map(|n| n as f64);
    let mesh = P1::grid(size, cells).unwrap().mesh().clone();
    let mut vertices = mesh.vertices().to_vec();
    for x in &mut vertices {
        for c in 0..D {
            if x[c] > 0.0 && x[c] < size[c] {
                x[c] += (numbers.next() - 0.5) / 3.0;
            }
        }
    }
    Mesh::new(vertices, mesh.cells().flatten().copied().collect()).unwrap()
}

/// A size that grows from a random point, of random slope.
fn random_size<const D: usize>(
    mesh: &Mesh<D>,
    least: f64,
    numbers: &mut Numbers,
) -> impl Fn(&SVector<f64, D>) -> f64 + Clone + use<D> {
    let pick = (numbers.next() * mesh.vertex_count() as f64) as usize;
    let centre = mesh.vertices()[pick] + SVector::from_fn(|_, _| 0.3 * numbers.next());
    let slope = 0.3 + numbers.next();
    move |x| least + slope * (x - centre).norm()
}

fn corners<const D: usize>(mesh: &Mesh<D>, cell: usize) -> Vec<SVector<f64, D>> {
    let vertices = mesh.cell(cell).iter().map(|&p| mesh.vertices()[p as usize]);
    vertices.collect()
}

/// The barycentric coordinates of a point in a cell, by solving for them.
fn barycentric<const D: usize>(corners: &[SVector<f64, D>], x: &SVector<f64, D>) -> Vec<f64> {
    let edges = SMatrix::<f64, D, D>::from_fn(|i, j| corners[j + 1][i] - corners[0][i]);
    let inner = edges.try_inverse().unwrap() * (x - corners[0]);
    let mut all = vec![1.0 - inner.sum()];
    all.extend(inner.iter());
    all
}

/// The cell that holds a point, found by asking all, with the point's barycentric coordinates.
fn home<const D: usize>(mesh: &Mesh<D>, x: &SVector<f64, D>) -> (usize, Vec<f64>) {
    (0..mesh.cell_count())
        .map(|cell| (cell, barycentric(&corners(mesh, cell), x)))
        .find(|(_, at)| at.iter().all(|&share| share > -1e-12))
        .unwrap()
}

fn midpoint<const D: usize>(corners: &[SVector<f64, D>]) -> SVector<f64, D> {
    corners.iter().sum::<SVector<f64, D>>() / corners.len() as f64
}

/// Faces with their orientation, whatever vertex they begin with.
fn faces<const D: usize>(mesh: &Mesh<D>) -> BTreeSet<Vec<u32>> {
    let turned = |face: &[u32; D]| {
        let mut face = face.to_vec();
        let least = (0..D).min_by_key(|&k| face[k]).unwrap();
        if D == 3 || least == 0 {
            face.rotate_left(least);
        } else {
            // An edge is not the same when it is turned round.
            face.push(0);
        }
        face
    };
    mesh.boundary().iter().map(turned).collect()
}

fn boundary_area<const D: usize>(mesh: &Mesh<D>) -> f64 {
    let space = P1::new(mesh.clone());
    space.trace(|_| true).unwrap().weights().iter().sum()
}

/// Each level passes the checks for a user's mesh, fills the same body and has the same boundary; a piecewise linear
/// function of the coarser level is one of the finer, with the values that the prolongation gives.
fn check_nested<const D: usize>(hierarchy: &Hierarchy<D>, numbers: &mut Numbers) {
    let all = levels(hierarchy);
    for (meshes, prolongation) in all.windows(2).zip(hierarchy.prolongations()) {
        let [coarse, fine] = meshes else {
            unreachable!()
        };
        let cells = fine.cells().flatten().copied().collect();
        let again = Mesh::new(fine.vertices().to_vec(), cells).unwrap();
        assert_eq!(faces(&again), faces(fine));
        assert_eq!(again.fingerprint(), fine.fingerprint());
        assert!((volume(fine) - volume(coarse)).abs() < 1e-12 * volume(coarse));
        let (before, after) = (boundary_area(coarse), boundary_area(fine));
        assert!((after - before).abs() < 1e-12 * before);

        let shape = (fine.vertex_count(), coarse.vertex_count());
        assert_eq!(prolongation.shape(), shape);
        let values: Vec<f64> = (0..shape.1).map(|_| numbers.next()).collect();
        let mut fine_values = Vec::new();
        for (row, x) in prolongation.outer_iterator().zip(fine.vertices()) {
            assert!(row.indices().is_sorted() && row.nnz() <= D + 1);
            assert!(row.data().iter().all(|&weight| weight > 0.0));
            let from_coarse: SVector<f64, D> = (row.iter())
                .map(|(p, &weight)| coarse.vertices()[p] * weight)
                .sum();
            assert!((from_coarse - x).norm() < 1e-13);
            fine_values.push(
                row.iter()
                    .map(|(p, weight)| values[p] * weight)
                    .sum::<f64>(),
            );
        }
        for cell in 0..fine.cell_count() {
            // Of a sample of the cells, one in a hundred of large meshes.
            if fine.cell_count() > 1000 && numbers.next() > 0.01 {
                continue;
            }
            let own = corners(fine, cell);
            let mut shares: Vec<f64> = own.iter().map(|_| numbers.next()).collect();
            let sum: f64 = shares.iter().sum();
            shares.iter_mut().for_each(|share| *share /= sum);
            let x: SVector<f64, D> = own.iter().zip(&shares).map(|(x, &share)| x * share).sum();
            let of_fine: f64 = (fine.cell(cell).iter().zip(&shares))
                .map(|(&p, share)| fine_values[p as usize] * share)
                .sum();
            let (home, at) = home(coarse, &x);
            let of_coarse: f64 = (coarse.cell(home).iter().zip(&at))
                .map(|(&p, share)| values[p as usize] * share)
                .sum();
            assert!((of_fine - of_coarse).abs() < 1e-10);
        }
    }
}

fn diameter<const D: usize>(corners: &[SVector<f64, D>]) -> f64 {
    let pairs = corners
        .iter()
        .flat_map(|x| corners.iter().map(move |y| (x - y).norm()));
    pairs.fold(0.0, f64::max)
}

/// No cell exceeds the size at its vertices and midpoint; levels grow at least by two, or are four times as fine at a
/// point.
fn check_sizes<const D: usize>(
    hierarchy: &Hierarchy<D>,
    first: usize,
    size: impl Fn(&SVector<f64, D>) -> f64,
) {
    let finest = hierarchy.finest();
    for cell in 0..finest.cell_count() {
        let corners = corners(finest, cell);
        let least = corners
            .iter()
            .map(&size)
            .fold(size(&midpoint(&corners)), f64::min);
        assert!(diameter(&corners) <= least * (1.0 + 1e-12));
    }
    let counts: Vec<usize> = levels(hierarchy)[first..]
        .iter()
        .map(|mesh| mesh.vertex_count())
        .collect();
    assert!(counts.is_sorted());
    let finer = |level: usize| {
        let [before, after] = [level, level + 1].map(|l| hierarchy.mesh(first + l).unwrap());
        // D bisections halve all edges of a cell, two times D leave 4^-D of its volume.
        let deep = |cell| {
            let x = midpoint(&corners(after, cell));
            let home = home(before, &x).0;
            before.volume(home) > 0.99 * f64::powi(4.0, D as i32) * after.volume(cell)
        };
        counts[level + 1] >= 2 * counts[level] || (0..after.cell_count()).any(deep)
    };
    let before_last = counts.len().saturating_sub(2);
    assert!((0..before_last).all(finer), "{counts:?}");
    if (0..before_last).all(|level| counts[level + 1] >= 2 * counts[level]) {
        assert!(counts.iter().sum::<usize>() <= 3 * counts[counts.len() - 1]);
    }
}

fn check_random<const D: usize>(mesh: Mesh<D>, least: f64, numbers: &mut Numbers) {
    let size = random_size(&mesh, least, numbers);
    let graded = Hierarchy::new(mesh).graded(size.clone()).unwrap();
    check_nested(&graded, numbers);
    check_sizes(&graded, 0, &size);
    // Nothing is left to do.
    assert_eq!(
        graded.clone().graded(&size).unwrap().level_count(),
        graded.level_count()
    );
    // A second grading goes on from the first, and red refinement from both.
    let levels = graded.level_count();
    let again = graded.graded(|x| 0.7 * size(x)).unwrap();
    check_sizes(&again, levels - 1, |x| 0.7 * size(x));
    check_nested(&again.refined(1).unwrap(), numbers);
}

#[test]
fn meshes_are_conforming_nested_and_as_fine_as_asked_for() {
    let mut numbers = Numbers(1);
    for _ in 0..8 {
        check_random(crate::common::irregular_2d(), 0.02, &mut numbers);
        check_random(shaken([3, 2], &mut numbers), 0.02, &mut numbers);
        check_random(
            P1::mirrored_grid([2.0, 1.0], [2, 1])
                .unwrap()
                .mesh()
                .clone(),
            0.02,
            &mut numbers,
        );
    }
    for _ in 0..3 {
        check_random(crate::common::irregular_3d(), 0.1, &mut numbers);
        check_random(shaken([2, 2, 1], &mut numbers), 0.3, &mut numbers);
    }
    let refined = P1::new(shaken([1, 2, 2], &mut numbers)).refined(1).unwrap();
    check_random(refined.mesh().clone(), 0.3, &mut numbers);
}

/// Cells of a mesh that is bisected everywhere, on all levels.
fn bisected<const D: usize>(mesh: &Mesh<D>, size: f64) -> Hierarchy<D> {
    Hierarchy::new(mesh.clone()).graded(|_| size).unwrap()
}

#[test]
fn a_triangle_has_at_most_four_shapes_on_all_levels() {
    let mesh = crate::common::irregular_2d();
    for cell in 0..mesh.cell_count() {
        let triangle = Mesh::new(corners(&mesh, cell), vec![0, 1, 2]).unwrap();
        let hierarchy = bisected(&triangle, 0.02);
        let all: BTreeSet<_> = levels(&hierarchy)
            .iter()
            .flat_map(|mesh| shapes(mesh))
            .collect();
        assert!(all.len() <= 4, "{} shapes", all.len());
        // As with bisection by longest edges alone: M. Rosenberg, F. Stenger, SIAM J. Numer. Anal. 12 (1975).
        let least = |mesh: &Mesh<2>| {
            let angles = (0..mesh.cell_count()).flat_map(|cell| {
                let x = corners(mesh, cell);
                (0..3).map(move |i| (x[(i + 1) % 3] - x[i]).angle(&(x[(i + 2) % 3] - x[i])))
            });
            angles.fold(f64::INFINITY, f64::min)
        };
        assert!(least(hierarchy.finest()) >= 0.5 * least(&triangle));
    }
}

#[test]
fn a_tetrahedron_has_at_most_36_shapes_on_all_levels() {
    let mut numbers = Numbers(5);
    for _ in 0..6 {
        let corners: Vec<_> = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ]
        .map(|x| SVector::<f64, 3>::from(x) + SVector::from_fn(|_, _| 0.5 * numbers.next()))
        .to_vec();
        let Ok(tetrahedron) = Mesh::new(corners, vec![0, 1, 2, 3]) else {
            continue;
        };
        let hierarchy = bisected(&tetrahedron, 0.08);
        let all: BTreeSet<_> = levels(&hierarchy)
            .iter()
            .flat_map(|mesh| shapes(mesh))
            .collect();
        assert!(all.len() <= 36, "{} shapes", all.len());
        let half = bisected(&tetrahedron, 0.16);
        assert!(regularity(hierarchy.finest()) > (1.0 - 1e-9) * regularity(half.finest()));
    }
    // The tetrahedra of a grid have three shapes, as Kuhn's and Maubach's.
    let cube = P1::grid([1.0; 3], [1; 3]).unwrap().graded(|_| 0.2).unwrap();
    let all: BTreeSet<_> = levels(cube.hierarchy())
        .iter()
        .flat_map(|mesh| shapes(mesh))
        .collect();
    assert_eq!(all.len(), 3);
}

/// The cells h(x)^-D asks for. Of a cell that is halved because it is too large, of diameter d, the size is below d at a
/// point and so below (1 + c) d everywhere, c the slope of the size; its halves have the volume q d^D / 2 at least. A
/// half therefore takes q / (2 (1 + c)^D) of the integral of h^-D. To this the halves add that keep a mesh conforming,
/// as many again here. A cell, on the other hand, takes no more than the largest volume of a cell of diameter h.
fn check_count<const D: usize>(
    coarse: P1<D>,
    regularity: f64,
    least: f64,
    slope: f64,
    integral: f64,
) {
    let graded = coarse.graded(|x| least + slope * x[D - 1]).unwrap();
    let cells = graded.mesh().cell_count() as f64;
    let largest = if D == 2 { 0.25 } else { 2f64.sqrt() / 12.0 };
    let most = 2.0 * 2.0 * (1.0 + slope).powi(D as i32) / regularity * integral;
    assert!(cells >= integral / largest && cells <= most);
}

#[test]
fn the_number_of_cells_is_the_integral_that_the_size_asks_for() {
    for least in [1e-1, 1e-2, 1e-3] {
        // Over x of length 2, y from 0 to 1: int (h0 + c y)^-2 = (1/h0 - 1/(h0 + c)) / c. Right isosceles triangles.
        let slope = 0.5;
        let integral = 2.0 / slope * (1.0 / least - 1.0 / (least + slope));
        let coarse = P1::grid([2.0, 1.0], [2, 1]).unwrap();
        check_count(coarse, 0.25, least, slope, integral);
    }
    for least in [2e-1, 5e-2] {
        let slope = 0.7;
        let integral = 0.5 / slope * (f64::powi(least, -2) - f64::powi(least + slope, -2));
        let coarse = P1::grid([1.0; 3], [1; 3]).unwrap();
        let shapes = bisected(coarse.mesh(), 0.2);
        let worst = levels(&shapes)
            .iter()
            .map(|mesh| regularity(mesh))
            .fold(1.0, f64::min);
        check_count(coarse, worst, least, slope, integral);
    }
}

/// As in refinement of uniform meshes, by position.
fn check_names<const D: usize>(mesh: Mesh<D>, split: f64) {
    let left = |x: &SVector<f64, D>| x[0] < split;
    let middle = |mesh: &Mesh<D>, of: &[u32]| {
        let sum: SVector<f64, D> = of.iter().map(|&p| mesh.vertices()[p as usize]).sum();
        sum / of.len() as f64
    };
    let cells: Vec<usize> = (0..mesh.cell_count())
        .filter(|&k| left(&middle(&mesh, mesh.cell(k))))
        .collect();
    let faces: Vec<[u32; D]> = (mesh.boundary().iter().copied())
        .filter(|face| left(&middle(&mesh, face)))
        .collect();
    let mesh = mesh.with_part("left", &faces).unwrap();
    let mesh = mesh.with_material("left", &cells).unwrap();
    let graded = Hierarchy::new(mesh)
        .graded(|x| 0.1 + 0.5 * x.norm())
        .unwrap();
    for mesh in levels(&graded.refined(1).unwrap()) {
        let (_, places) = mesh.parts().next().unwrap();
        let (_, cells) = mesh.materials().next().unwrap();
        assert!(places.is_sorted() && cells.is_sorted());
        for (k, face) in mesh.boundary().iter().enumerate() {
            assert_eq!(places.binary_search(&k).is_ok(), left(&middle(mesh, face)));
        }
        for (k, cell) in mesh.cells().enumerate() {
            assert_eq!(cells.binary_search(&k).is_ok(), left(&middle(mesh, cell)));
        }
    }
}

#[test]
fn grading_hands_names_on() {
    check_names(
        P1::mirrored_grid([2.0, 1.0], [4, 2])
            .unwrap()
            .mesh()
            .clone(),
        1.0,
    );
    check_names(
        P1::grid([2.0, 1.0, 1.0], [2, 1, 2]).unwrap().mesh().clone(),
        1.0,
    );
}

#[test]
fn sizes_out_of_range_are_refused() {
    let square = || P1::grid([1.0, 1.0], [1, 1]).unwrap();
    let least = 2f64.powi(-32);
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 0.5 * least] {
        match square()
            .graded(|x| if x[0] > 0.9 { value } else { 1.0 })
            .map(|_| ())
        {
            Err(FemError::CellSize {
                value: found,
                at,
                least: bound,
            }) => {
                assert!(found.to_bits() == value.to_bits() && bound == least);
                assert_eq!(at, [1.0, 0.0]);
            }
            other => panic!("{other:?}"),
        }
    }
    // What 32 bits do not number is known from a few thousand cells.
    for size in [1e-8, 1e-6] {
        let found = square().graded(|_| size).map(|_| ());
        // Half as many vertices as triangles.
        let expected = 0.5 / (0.75_f64.sqrt() / 2.0) * (1.0 / size).powi(2);
        let Err(FemError::TooMany {
            what: "vertices",
            count: vertices,
        }) = found
        else {
            panic!("{found:?}")
        };
        let ratio = vertices as f64 / expected;
        assert!((ratio - 1.0).abs() < 1e-6, "{ratio} at {size:e}");
    }
    let cube = P1::grid([1.0; 3], [1; 3]).unwrap();
    assert!(matches!(
        cube.graded(|_| 1e-5).map(|_| ()),
        Err(FemError::TooMany {
            what: "vertices",
            ..
        })
    ));
    // A deep hole at one point is none.
    let tip = square().graded(|x| (0.5 * x.norm()).max(least)).unwrap();
    assert!(tip.vertex_count() < 10_000, "{}", tip.vertex_count());
    let cube = P1::grid([1.0; 3], [1; 3]).unwrap();
    let tip = cube.graded(|x| x.norm().max(least)).unwrap();
    assert!(tip.vertex_count() < 10_000, "{}", tip.vertex_count());
}

/// Vertices, and the error in energy of u = r^(1/2) sin(phi/2) around (1, 0): locked ahead of the tip, free behind it.
fn at_a_crack_tip(space: &P1<2>) -> [f64; 2] {
    let polar = |x: &Vector2<f64>| {
        let x = x - Vector2::x();
        (x.norm(), x[1].atan2(x[0]))
    };
    let exact = space.interpolate(|x| {
        let (r, phi) = polar(x);
        Vector1::new(r.sqrt() * (0.5 * phi).sin())
    });
    let mut held = Constraints::none(space);
    let locked = |x: &Vector2<f64>| x[1] > 0.0 || x[0] >= 1.0;
    let sides = |x: &Vector2<f64>| x[0] == 0.0 || x[0] == 2.0 || x[1] == 1.0;
    held.fix(&space.trace(sides).unwrap(), [true]).unwrap();
    held.fix(&space.trace(|x| x[1] == 0.0 && locked(x)).unwrap(), [true])
        .unwrap();
    let none = vec![Vector1::zeros(); space.vertex_count()];
    let u = solve(&antiplane(space, 1.0).unwrap(), &none, &held, &exact);
    let error = h1_error(space, &u, |x| {
        let (r, phi) = polar(x);
        Matrix1x2::new(-(0.5 * phi).sin(), (0.5 * phi).cos()) * (0.5 / r.sqrt())
    });
    [space.vertex_count() as f64, error.unwrap()]
}

/// With h = H r^(3/4) the error of a cell, h r^(-3/2) times the root of its area, has the sum H^2 int r^(-1/2) dr of
/// squares, and there are H^-2 int r^(-1/2) dr cells: first order in the root of their number. A cell of size H^2 at the
/// tip adds the root of that. Uniform cells have order 1/2.
#[test]
fn grading_restores_the_order_at_a_crack_tip() {
    let order = |[before, after]: [[f64; 2]; 2]| {
        (before[1] / after[1]).ln() / (after[0] / before[0]).sqrt().ln()
    };
    let strip = || P1::grid([2.0, 1.0], [2, 1]).unwrap();
    let graded = order([0.125, 0.03125].map(|h: f64| {
        let size = |x: &Vector2<f64>| (h * (x - Vector2::x()).norm().powf(0.75)).max(h * h);
        at_a_crack_tip(&strip().graded(size).unwrap())
    }));
    let uniform = order([4, 6].map(|level| at_a_crack_tip(&strip().refined(level).unwrap())));
    assert!((graded - 1.0).abs() < 0.1, "order {graded}");
    assert!((uniform - 0.5).abs() < 0.05, "order {uniform}");
}
