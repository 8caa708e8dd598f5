//! The owned vertices that unknowns of a basis move.

use std::collections::BTreeMap;

use nalgebra::SMatrix;
use stickslip::solvers::Basis;

/// A change of basis `x = T x'` by rows and by columns, at the vertices that it changes.
#[derive(Debug)]
pub(crate) struct Unknowns<const C: usize> {
    /// `T`.
    pub(crate) basis: Basis<C>,
    /// The columns of `T`.
    columns: BTreeMap<usize, Vec<(usize, SMatrix<f64, C, C>)>>,
}

impl<const C: usize> Unknowns<C> {
    pub(crate) fn of(basis: &Basis<C>) -> Self {
        let mut columns: BTreeMap<usize, Vec<(usize, SMatrix<f64, C, C>)>> = BTreeMap::new();
        for (vertex, row) in basis.rows() {
            for (unknown, block) in row {
                columns.entry(unknown).or_default().push((vertex, block));
            }
        }
        Self {
            basis: basis.clone(),
            columns,
        }
    }

    /// The vertices that an unknown moves, with the blocks of `T`; none where it moves its own vertex alone as it is.
    pub(crate) fn moved_by(&self, unknown: usize) -> Option<&[(usize, SMatrix<f64, C, C>)]> {
        self.columns.get(&unknown).map(Vec::as_slice)
    }
}
