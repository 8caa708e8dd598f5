//! The local problem of one vertex, with all others fixed.

use nalgebra::{SMatrix, SVector};

use super::{Inverses, Sweep};
use crate::block::decouple;
use crate::block_matrix::{Rows, row_product_behind};
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy};

impl<const C: usize> Sweep<C> {
    /// The minimiser over vertex `i` alone, with its position among the frictional ones; `v` begins at vertex `first`.
    #[inline(always)]
    pub(super) fn renewed(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        (i, position): (usize, Option<usize>),
        first: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        match position {
            Some(position) => self.minimizer(energy, rows, position, first, v),
            None => {
                let rest = energy.load[i] - row_product_behind(rows, i, first, v);
                let step = match inverses {
                    Some(inverses) => inverses[i] * rest,
                    None => self.balanced(rows, &energy.fixed[i], i, rest),
                };
                v[i - first] + step
            }
        }
    }

    /// The step of a vertex without friction that balances a force.
    #[inline(always)]
    fn balanced(
        &self,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        fixed: &[bool; C],
        i: usize,
        mut force: SVector<f64, C>,
    ) -> SVector<f64, C> {
        // Preparation has checked that there is a diagonal block, and that it is positive definite.
        let block = &rows.values[self.behind[i] as usize - 1];
        let step = if *fixed == [false; C] {
            solve(block, &force)
        } else {
            clear_masked(&mut force, fixed);
            solve(&decouple(block, fixed), &force)
        };
        step.unwrap_or_else(SVector::zeros)
    }

    /// The minimiser over the frictional vertex number `position` alone; `v` begins at vertex `first`.
    #[inline]
    pub(super) fn minimizer(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        position: usize,
        first: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let vertex = energy.vertices[position];
        let (block, fixed, own) = (
            &self.blocks[position],
            &energy.fixed[vertex],
            &v[vertex - first],
        );
        let product = row_product_behind(rows, vertex, first, v);
        let mut force = energy.load[vertex] - product + block * own;
        clear_masked(&mut force, fixed);
        let minimizer = energy.potentials.minimize(position, block, &force);
        SVector::from_fn(|c, _| if fixed[c] { own[c] } else { minimizer[c] })
    }

    /// The squared distance, in the norm of the operator, between a frictional vertex and its local
    /// minimum.
    #[cfg(feature = "multigrid")]
    pub(crate) fn local_error(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let change = self.local_change(energy, position, v);
        change.dot(&(self.blocks[position] * change))
    }

    /// The largest component of the force that moves a frictional vertex to its local minimum.
    pub(crate) fn local_force(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        (self.blocks[position] * self.local_change(energy, position, v)).amax()
    }

    /// The way of a frictional vertex to its local minimum.
    fn local_change(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let rows = Rows::of(energy.operator);
        self.minimizer(energy, &rows, position, 0, v) - v[energy.vertices[position]]
    }
}

/// The solution of `block x = force` by elimination without square roots; `None` unless the block is positive definite.
#[inline(always)]
fn solve<const C: usize>(
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> Option<SVector<f64, C>> {
    let (mut left, mut shares, mut x) = (*block, SMatrix::<f64, C, C>::zeros(), *force);
    for k in 0..C {
        let pivot = left[(k, k)];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        let inverse = pivot.recip();
        for r in k + 1..C {
            shares[(r, k)] = left[(r, k)] * inverse;
            x[r] -= shares[(r, k)] * x[k];
            for c in k + 1..=r {
                left[(r, c)] -= shares[(r, k)] * left[(c, k)];
            }
        }
        x[k] *= inverse;
    }
    for k in (0..C).rev() {
        for r in k + 1..C {
            x[k] -= shares[(r, k)] * x[r];
        }
    }
    Some(x)
}
