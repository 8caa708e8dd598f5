//! The unknowns of a body by rows and by columns of their change.

use std::collections::BTreeMap;

use nalgebra::{SMatrix, SVector};
use stickslip_fem::ElementStiffness;

use crate::{Basis, BasisRows};

/// A change of basis `x = T x'`, at the vertices that it changes.
#[derive(Debug)]
pub(super) struct Changed<const C: usize> {
    /// `T`.
    pub(super) basis: Basis<C>,
    /// The rows of `T`.
    rows: BasisRows<C>,
    /// Its columns.
    columns: BasisRows<C>,
}

impl<const C: usize> Changed<C> {
    pub(super) fn of(basis: &Basis<C>) -> Self {
        let rows = basis.rows();
        let mut columns: BasisRows<C> = BTreeMap::new();
        for (&i, row) in &rows {
            for &(unknown, block) in row {
                columns.entry(unknown).or_default().push((i, block));
            }
        }
        Self {
            basis: basis.clone(),
            rows,
            columns,
        }
    }

    /// The vertices with axes, links or linked copies.
    pub(super) fn vertices(&self) -> impl Iterator<Item = usize> {
        self.rows.keys().copied()
    }

    /// The vector of a vertex, of a field of unknowns.
    fn at(&self, p: usize, unknowns: &impl Fn(usize) -> SVector<f64, C>) -> SVector<f64, C> {
        match self.rows.get(&p) {
            None => unknowns(p),
            Some(row) => (row.iter())
                .map(|(unknown, block)| block * unknowns(*unknown))
                .sum(),
        }
    }

    /// `(T^T A T x')_i` of a stiffness.
    pub(super) fn product_at(
        &self,
        stiffness: &ElementStiffness<C>,
        i: usize,
        unknowns: &impl Fn(usize) -> SVector<f64, C>,
    ) -> SVector<f64, C> {
        let force = |j: usize| stiffness.product_with(j, |p| self.at(p, unknowns));
        match self.columns.get(&i) {
            None => force(i),
            Some(column) => column
                .iter()
                .map(|(j, block)| block.tr_mul(&force(*j)))
                .sum(),
        }
    }

    /// The highest level of local steps of the cells that an unknown moves.
    pub(super) fn level_at(&self, stiffness: &ElementStiffness<C>, i: usize) -> usize {
        match self.columns.get(&i) {
            None => stiffness.level_at(i),
            Some(column) => {
                let levels = column.iter().map(|(j, _)| stiffness.level_at(*j));
                levels.max().unwrap_or(0)
            }
        }
    }

    /// The diagonal block of an unknown in `T^T A T`.
    pub(super) fn diagonal_block(
        &self,
        stiffness: &ElementStiffness<C>,
        i: usize,
    ) -> SMatrix<f64, C, C> {
        if !self.columns.contains_key(&i) {
            return stiffness.diagonal_block(i);
        }
        let mut block = SMatrix::<f64, C, C>::zeros();
        for c in 0..C {
            let unit = |p: usize| SVector::from_fn(|r, _| f64::from(u8::from(p == i && r == c)));
            block.set_column(c, &self.product_at(stiffness, i, &unit));
        }
        block
    }
}
