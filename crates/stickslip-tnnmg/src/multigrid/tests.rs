//! The cycle against one written down plainly: dense matrices, one sweep after the other.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use proptest::prelude::*;

use super::{Linearization, Multigrid};
use crate::{BlockMatrix, Prolongation};

/// Vertices of the meshes of an interval, coarsest first.
const SIZES: [usize; 3] = [3, 5, 9];

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

/// A positive definite matrix that couples vertices up to two apart.
fn operator(values: &[f64]) -> BlockMatrix<2> {
    let size = SIZES[SIZES.len() - 1];
    let mut blocks = sprs::TriMatI::new((size, size));
    let mut values = values.iter().copied();
    let mut next = || values.next().unwrap_or(0.5);
    for i in 0..size {
        blocks.add_triplet(i, i, Matrix2::new(9.0 + next(), 0.5, 0.5, 9.0 + next()));
        for j in i + 1..size.min(i + 3) {
            let block = Matrix2::new(-next(), next(), next(), -next());
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

/// One V(pre, post) cycle on level `l` for the right-hand side `b`.
fn cycle(
    l: usize,
    matrix: &DMatrix<f64>,
    b: &DVector<f64>,
    pre: usize,
    post: usize,
) -> DVector<f64> {
    if l == 0 {
        return matrix.clone().lu().solve(b).expect("definite");
    }
    let sweep = |x: &mut DVector<f64>, i: usize| {
        let rest = (b - matrix * &*x).fixed_rows::<2>(2 * i).into_owned();
        let block = matrix.fixed_view::<2, 2>(2 * i, 2 * i).into_owned();
        let step = block.try_inverse().expect("definite") * rest;
        let mut part = x.fixed_rows_mut::<2>(2 * i);
        part += step;
    };
    let mut x = DVector::zeros(b.len());
    for _ in 0..pre {
        (0..SIZES[l]).for_each(|i| sweep(&mut x, i));
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
    x += prolongation * cycle(l - 1, &coarse, &rest, pre, post);
    for _ in 0..post {
        (0..SIZES[l]).rev().for_each(|i| sweep(&mut x, i));
    }
    x
}

proptest! {
    /// So is the product of the matrix and the correction that comes with it.
    #[test]
    fn the_cycle_is_that_of_sweeps_one_after_the_other(
        values in prop::collection::vec(0.0..1.0, 80),
        rest in prop::collection::vec(-1.0..1.0, 18),
        pre in 0_usize..4,
        post in 0_usize..4,
    ) {
        let operator = operator(&values);
        let size = operator.rows();
        let transfers: Vec<_> = SIZES[..2].iter().map(|&coarse| interpolation(coarse)).collect();
        let mut multigrid = Multigrid::<2>::new(&transfers, pre, post);
        multigrid.prepare(&operator, &vec![[false; 2]; size], &[])?;
        let none = Linearization { vertices: &[], hessians: &[], dropped: &[] };
        multigrid.refresh(&operator, &none)?;
        let residual: Vec<_> = rest.chunks(2).map(Vector2::from_column_slice).collect();
        // What is there before does not matter.
        let (mut correction, mut image) = (vec![Vector2::repeat(7.0); size], vec![Vector2::repeat(5.0); size]);
        multigrid.cycle(&residual, &mut correction, &mut image);

        let matrix = dense(&operator);
        let expected = cycle(2, &matrix, &DVector::from_vec(rest), pre, post);
        let product = &matrix * &expected;
        for i in 0..size {
            for c in 0..2 {
                prop_assert!((correction[i][c] - expected[2 * i + c]).abs() < 1e-12);
                prop_assert!((image[i][c] - product[2 * i + c]).abs() < 1e-11);
            }
        }
    }
}
