//! Compressed block rows: sprs storage, nalgebra blocks.

mod compiled;
mod rows;
mod sums;

use nalgebra::{SMatrix, SVector};

use crate::{Basis, MassMatrix, Matrix, MatrixDefect, Operator};
use compiled::{add_product, change_basis, combination, combine, half_norm, square};
#[cfg(any(feature = "multigrid", feature = "condensed"))]
pub(crate) use rows::Graph;
#[cfg(feature = "multigrid")]
pub(crate) use rows::{Block, add_transposed_row, partial_product, sum_products};
pub use rows::{BlockMatrix, Prolongation};
pub(crate) use rows::{Rows, row_product, row_product_behind};
pub(crate) use sums::{add, on_patterns};

impl<const C: usize> Matrix<C> for BlockMatrix<C> {
    fn vertex_count(&self) -> usize {
        self.rows()
    }

    fn defect(&self) -> Option<MatrixDefect> {
        let (rows, columns) = self.shape();
        if rows != columns {
            Some(MatrixDefect::NotSquare { rows, columns })
        } else if !self.is_csr() {
            Some(MatrixDefect::ByColumns)
        } else {
            None
        }
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        row_product(&Rows::of(self), i, x)
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.get(i, i).copied().unwrap_or_else(SMatrix::zeros)
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        add_product(self, scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        square(self, x)
    }

    /// From half of the symmetric matrix. It reads less than [`quadratic`](Matrix::quadratic). Smooth fields lose
    /// digits, which a norm can spare.
    fn norm(&self, x: &[SVector<f64, C>]) -> f64 {
        half_norm(self, x)
    }
}

impl<const C: usize> Operator<C> for BlockMatrix<C> {
    type Mass = MassMatrix<C>;

    fn into_mass(self) -> MassMatrix<C> {
        self.into()
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        if let Some(own) = self.get_mut(i, i) {
            *own += block;
        }
    }

    /// Rotates by rows and by the corresponding columns, in time proportional to the rotated vertices, after a product
    /// with the links, if any.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        change_basis(self, basis);
        true
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &MassMatrix<C>)>) -> Self {
        combination(terms, mass)
    }

    fn set_combination_with(
        &mut self,
        terms: &[(f64, &Self)],
        mass: Option<(f64, &MassMatrix<C>)>,
    ) {
        combine(self, terms, mass);
    }

    fn format() -> &'static str {
        "BlockMatrix"
    }
}
