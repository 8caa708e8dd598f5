//! The matrix of a level by rows, without storing it.

use nalgebra::{SMatrix, SVector};

use crate::block::without;
use crate::block_matrix::{Rows, row_product, sum_products};
use crate::parts::sum_parts;

/// A matrix without its dropped rows and columns, plus the slopes of friction on the diagonal.
///
/// The finest level is the caller's operator seen through this: a copy of it would be the largest array of a solver.
#[derive(Clone, Copy)]
pub(super) struct Entries<'a, const C: usize> {
    pub(super) rows: Rows<'a, SMatrix<f64, C, C>>,
    pub(super) dropped: &'a [[bool; C]],
    /// The vertices of `hessians`, increasing.
    pub(super) frictional: &'a [u32],
    pub(super) hessians: &'a [SMatrix<f64, C, C>],
}

impl<'a, const C: usize> Entries<'a, C> {
    /// Columns and blocks of a row, by increasing column.
    #[inline(always)]
    pub(super) fn row(
        &self,
        i: usize,
    ) -> impl Iterator<Item = (usize, SMatrix<f64, C, C>)> + Clone + use<'a, C> {
        let (dropped, hessian) = (self.dropped, self.hessian(i));
        self.rows.row(i).map(move |(j, block)| {
            let mut kept = kept(block, &dropped[i], &dropped[j]);
            if let Some(hessian) = hessian.filter(|_| i == j) {
                for c in (0..C).filter(|&c| !dropped[i][c]) {
                    for r in (0..C).filter(|&r| !dropped[i][r]) {
                        kept[(r, c)] += hessian[(r, c)];
                    }
                }
            }
            (j, kept)
        })
    }

    fn hessian(&self, i: usize) -> Option<&'a SMatrix<f64, C, C>> {
        if self.hessians.is_empty() {
            return None;
        }
        let place = self.frictional.binary_search(&(i as u32)).ok()?;
        self.hessians.get(place)
    }

    /// `x . H x` of a field without dropped components.
    pub(super) fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        sum_parts(0..x.len(), (), &|part, ()| {
            let product = |i: usize| match self.hessian(i) {
                None => row_product(&self.rows, i, x),
                Some(_) => sum_products(self.row(i), x),
            };
            part.map(|i| x[i].dot(&product(i))).sum()
        })
    }
}

/// A block without the dropped rows and columns, which few blocks have.
#[inline(always)]
fn kept<const C: usize>(
    block: &SMatrix<f64, C, C>,
    rows: &[bool; C],
    columns: &[bool; C],
) -> SMatrix<f64, C, C> {
    if *rows == [false; C] && *columns == [false; C] {
        *block
    } else {
        without(block, rows, columns)
    }
}
