//! The cycle against one written down plainly: dense matrices, one sweep after the other, over vertices, slab after
//! slab, or over the sets that strong couplings tie.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use proptest::prelude::*;

use super::couplings::Couplings;
use super::{Linearization, Multigrid};
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Prolongation};

/// Vertices of the meshes of an interval, coarsest first. Cut finely, the last two have two and four wide slabs.
const SIZES: [usize; 4] = [5, 9, 17, 33];
/// The finest level.
const FINEST: usize = SIZES.len() - 1;

/// Linear interpolation from `coarse` vertices to the mesh with a vertex more between any two.
fn interpolation(coarse: usize) -> Prolongation {
    let mut weights = sprs::TriMatI::new((2 * coarse - 1, coarse));
    for i in 0..coarse {
        weights.add_triplet(2 * i, i, 1.0);
        if i + 1 < coarse {
            weights.add_triplet(2 * i + 1, i, 0.5);
            weights.add_triplet(2 * i + 1, i + 1, 0.5);
        }
    }
    weights.to_csr()
}

/// A positive definite matrix that couples vertices up to two apart, weakly where `weak` says so of one of them.
fn operator(values: &[f64], weak: &[bool]) -> BlockMatrix<2> {
    let size = SIZES[FINEST];
    let mut blocks = sprs::TriMatI::new((size, size));
    let mut values = values.iter().copied();
    let mut next = || values.next().unwrap_or(0.5);
    for i in 0..size {
        blocks.add_triplet(i, i, Matrix2::new(9.0 + next(), 0.5, 0.5, 9.0 + next()));
        for j in i + 1..size.min(i + 3) {
            let factor = if weak[i] || weak[j] { 0.02 } else { 1.0 };
            let block = Matrix2::new(-next(), next(), next(), -next()) * factor;
            blocks.add_triplet(i, j, block);
            blocks.add_triplet(j, i, block.transpose());
        }
    }
    blocks.to_csr()
}

fn dense(matrix: &BlockMatrix<2>) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(2 * matrix.rows(), 2 * matrix.cols());
    for (block, (i, j)) in matrix.iter() {
        dense
            .fixed_view_mut::<2, 2>(2 * i as usize, 2 * j as usize)
            .copy_from(block);
    }
    dense
}

/// Wide slabs, then narrow ones, vertex by vertex.
fn one_by_one(slabs: &Colouring) -> Vec<Vec<usize>> {
    let (mut wide, mut narrow) = (Vec::new(), Vec::new());
    slabs.for_each(|rows, is_narrow| {
        let visited = if is_narrow { &mut narrow } else { &mut wide };
        visited.extend(rows.map(|i| vec![i]));
    });
    [wide, narrow].concat()
}

/// The sets that a cycle sweeps over: all that a chain of strong couplings connects, unless that is one set of
/// more than half of the coupled vertices.
fn sets(matrix: &DMatrix<f64>, slabs: &Colouring) -> Vec<Vec<usize>> {
    let size = matrix.nrows() / 2;
    let coupling = |i: usize, j: usize| {
        let entry = |c: usize| matrix[(2 * i + c, 2 * j + c)].abs();
        if i == j { 0.0 } else { entry(0).max(entry(1)) }
    };
    let largest = |i: usize| (0..size).map(|j| coupling(i, j)).fold(0.0, f64::max);
    let strong = |i: usize, j: usize| {
        coupling(i, j) > 0.0 && coupling(i, j) >= largest(i).min(largest(j)) / 6.0
    };
    // The smallest vertex that each one is connected to.
    let mut root: Vec<usize> = (0..size).collect();
    for _ in 0..size {
        for i in 0..size {
            for j in (0..size).filter(|&j| strong(i, j)) {
                root[i] = root[i].min(root[j]);
            }
        }
    }
    let members = |r: usize| (0..size).filter(|&i| root[i] == r).collect::<Vec<_>>();
    let sets: Vec<_> = (0..size)
        .map(members)
        .filter(|set| !set.is_empty())
        .collect();
    let coupled = (0..size).filter(|&i| largest(i) > 0.0).count();
    let is_tied = sets.iter().any(|set| set.len() > 1);
    if !is_tied || sets.iter().any(|set| 2 * set.len() > coupled) {
        return one_by_one(slabs);
    }
    sets
}

/// One V(pre, post) cycle on level `l` for the right-hand side `b`.
fn cycle(
    l: usize,
    slabs: &[Colouring],
    matrix: &DMatrix<f64>,
    b: &DVector<f64>,
    pre: usize,
    post: usize,
) -> DVector<f64> {
    if l == 0 {
        return matrix.clone().lu().solve(b).expect("definite");
    }
    let sets = sets(matrix, &slabs[l]);
    let sweep = |x: &mut DVector<f64>, set: &Vec<usize>| {
        let rows: Vec<_> = set.iter().flat_map(|&i| [2 * i, 2 * i + 1]).collect();
        let rest = (b - matrix * &*x).select_rows(&rows);
        let block = matrix.select_rows(&rows).select_columns(&rows);
        let step = block.lu().solve(&rest).expect("definite");
        rows.iter()
            .zip(&step)
            .for_each(|(&row, step)| x[row] += step);
    };
    let mut x = DVector::zeros(b.len());
    for _ in 0..pre {
        sets.iter().for_each(|set| sweep(&mut x, set));
    }
    let weights = interpolation(SIZES[l - 1]);
    let mut prolongation = DMatrix::zeros(2 * SIZES[l], 2 * SIZES[l - 1]);
    for (&weight, (i, j)) in weights.iter() {
        for c in 0..2 {
            prolongation[(2 * i as usize + c, 2 * j as usize + c)] = weight;
        }
    }
    let restriction = prolongation.transpose();
    let coarse = &restriction * matrix * &prolongation;
    let rest = restriction * (b - matrix * &x);
    x += prolongation * cycle(l - 1, slabs, &coarse, &rest, pre, post);
    for _ in 0..post {
        sets.iter().rev().for_each(|set| sweep(&mut x, set));
    }
    x
}

proptest! {
    /// Whatever rows are computed side by side.
    #[test]
    fn coarse_matrices_are_products_of_dense_ones(
        values in prop::collection::vec(0.0..1.0, 330),
        cuts in prop::collection::vec(0.0..1.0, 0..5),
    ) {
        let operator = operator(&values, &[false; SIZES[FINEST]]);
        let transfers: Vec<_> = SIZES[..FINEST].iter().map(|&coarse| interpolation(coarse)).collect();
        let mut multigrid = Multigrid::<2>::new(&transfers.as_slice().into(), 1, 1);
        let fixed = [[false; 2]; SIZES[FINEST]];
        multigrid.prepare(&operator, &fixed, &[])?;
        for level in &mut multigrid.levels[..FINEST] {
            let size = level.size();
            let mut cuts: Vec<_> = cuts.iter().map(|cut| (cut * size as f64) as usize).collect();
            cuts.sort_unstable();
            level.cuts = [vec![0], cuts, vec![size]].concat();
            level.positions = vec![0; size * (level.cuts.len() - 1)];
            let matrix = level.matrix.as_mut().expect("coarse");
            matrix.data_mut().fill(Matrix2::repeat(7.0));
        }
        multigrid.prepare(&operator, &fixed, &[])?;
        let mut expected = dense(&operator);
        for (transfer, level) in transfers.iter().zip(&multigrid.levels).rev() {
            let prolongation = transfer.to_dense();
            let prolongation = DMatrix::from_fn(2 * transfer.rows(), 2 * transfer.cols(), |i, j| {
                if i % 2 == j % 2 { prolongation[[i / 2, j / 2]] } else { 0.0 }
            });
            expected = prolongation.tr_mul(&expected) * prolongation;
            let matrix = level.matrix.as_ref().expect("coarse");
            prop_assert!((dense(matrix) - &expected).amax() < 1e-12);
        }
    }

    /// So is the product of the matrix and the correction that comes with it.
    #[test]
    fn the_cycle_is_that_of_sweeps_one_after_the_other(
        values in prop::collection::vec(0.0..1.0, 330),
        weak in prop::collection::vec(prop::bool::weighted(0.3), 33),
        is_uniform in prop::bool::ANY,
        is_cut in prop::bool::ANY,
        rest in prop::collection::vec(-1.0..1.0, 66),
        pre in 0_usize..4,
        post in 0_usize..4,
    ) {
        let weak: Vec<_> = weak.iter().map(|&weak| weak && !is_uniform).collect();
        let operator = operator(&values, &weak);
        let size = operator.rows();
        let transfers: Vec<_> = SIZES[..FINEST].iter().map(|&coarse| interpolation(coarse)).collect();
        let mut multigrid = Multigrid::<2>::new(&transfers.as_slice().into(), pre, post);
        multigrid.cut = |rows, bandwidth| Colouring::of(rows, bandwidth, 0);
        if !is_cut {
            multigrid.cut = Colouring::new;
        }
        multigrid.prepare(&operator, &vec![[false; 2]; size], &[])?;
        let none = Linearization { vertices: &[], hessians: &[], dropped: &[] };
        multigrid.refresh(&operator, &none)?;
        let residual: Vec<_> = rest.chunks(2).map(Vector2::from_column_slice).collect();
        // What is there before does not matter.
        let (mut correction, mut image) = (vec![Vector2::repeat(7.0); size], vec![Vector2::repeat(5.0); size]);
        multigrid.cycle(&residual, &mut correction, &mut image);

        let matrix = dense(&operator);
        let slabs: Vec<_> = (multigrid.levels.iter())
            .map(|level| (multigrid.cut)(level.size(), level.entries(&operator).rows.bandwidth()))
            .collect();
        prop_assert_eq!(slabs[FINEST].wide_count(), if is_cut { 4 } else { 1 });
        let expected = cycle(FINEST, &slabs, &matrix, &DVector::from_vec(rest), pre, post);
        let product = &matrix * &expected;
        for i in 0..size {
            for c in 0..2 {
                prop_assert!((correction[i][c] - expected[2 * i + c]).abs() < 1e-12);
                prop_assert!((image[i][c] - product[2 * i + c]).abs() < 1e-11);
            }
        }
    }

    /// The matrix of couplings in single precision is symmetric, and differs from that in double precision by no more than
    /// its bound, whatever the unit of a row: also for a field that is large and nearly constant.
    #[test]
    fn rounded_couplings_are_within_their_bound(
        values in prop::collection::vec(0.0..1.0, 330),
        is_cut in prop::bool::ANY,
        rest in prop::collection::vec(-1.0..1.0, 66),
        exponent in -300..300_i32,
        shift in -1e4..1e4_f64,
    ) {
        let mut operator = operator(&values, &[false; SIZES[FINEST]]);
        let unit = 2f64.powi(exponent);
        operator.data_mut().iter_mut().for_each(|block| *block *= unit);
        let size = operator.rows();
        let slabs = if is_cut { Colouring::of(size, Rows::of(&operator).bandwidth(), 0) } else { Colouring::of(size, 0, size) };
        let mut couplings = Couplings::of(&operator, &slabs, true);
        let mut rounded = DMatrix::zeros(2 * size, 2 * size);
        for i in 0..size {
            let diagonal = couplings.set_row(i, Rows::of(&operator).row(i).map(|(j, block)| (j, *block)));
            rounded.fixed_view_mut::<2, 2>(2 * i, 2 * i).copy_from(&diagonal);
        }
        let Couplings::Single(packed) = &couplings else { unreachable!() };
        for i in 0..size {
            for (entry, &j) in packed.rows().columns(i).iter().enumerate() {
                for c in 0..2 {
                    let mut axis = Vector2::zeros();
                    axis[c] = 1.0;
                    let column = packed.rows().times(i, entry, &axis);
                    for r in 0..2 {
                        rounded[(2 * i + r, 2 * j as usize + c)] = column[r];
                        rounded[(2 * j as usize + c, 2 * i + r)] = column[r];
                    }
                }
            }
        }
        let changed = (rounded - dense(&operator)) / unit;
        prop_assert!(changed.amax() > 0.0);
        for shift in [0.0, shift] {
            let x = DVector::from_iterator(2 * size, rest.iter().map(|rest| shift + rest));
            let fields: Vec<_> = rest.chunks(2).map(|rest| Vector2::new(shift + rest[0], shift + rest[1])).collect();
            let change = x.dot(&(&changed * &x)).abs();
            let roundings = 1e-14 * x.norm_squared();
            let bound = couplings.rounding(&fields) / unit;
            prop_assert!(change <= bound + roundings, "{change:e}, {bound:e}");
        }
    }
}
