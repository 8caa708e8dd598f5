//! The local problem of one vertex, with all others fixed.

use nalgebra::{SMatrix, SVector};

use super::Sweep;
use crate::block_matrix::{Rows, row_product_behind};
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy};

impl<const C: usize> Sweep<C> {
    /// The minimiser over vertex `i` alone, with its position among the frictional ones; `v` begins at vertex `first`.
    #[inline(always)]
    pub(super) fn renewed(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        (i, position): (usize, Option<usize>),
        first: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        match position {
            Some(position) => self.minimizer(energy, rows, position, first, v),
            None => {
                let rest = energy.load[i] - row_product_behind(rows, i, first, v);
                v[i - first] + self.inverses[i] * rest
            }
        }
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
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, 0, v) - v[energy.vertices[position]];
        change.dot(&(self.blocks[position] * change))
    }

    /// The largest component of the force that moves a frictional vertex to its local minimum.
    pub(crate) fn local_force(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, 0, v) - v[energy.vertices[position]];
        (self.blocks[position] * change).amax()
    }
}
