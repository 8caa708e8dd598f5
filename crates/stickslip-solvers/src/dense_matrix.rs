//! Dense matrices of nalgebra as operators.

use nalgebra::{DMatrix, SMatrix, SVector};

use crate::links::Elementary;
use crate::{Basis, Matrix, MatrixDefect, Operator};

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> Matrix<C> for DMatrix<f64> {
    fn vertex_count(&self) -> usize {
        self.nrows() / C
    }

    fn defect(&self) -> Option<MatrixDefect> {
        let (rows, columns) = self.shape();
        if rows != columns {
            Some(MatrixDefect::NotSquare { rows, columns })
        } else if !rows.is_multiple_of(C) {
            let components = C;
            Some(MatrixDefect::NoBlocks { rows, components })
        } else {
            None
        }
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        SVector::from_fn(|c, _| {
            let entry = |j: usize, r: usize| self[(C * i + c, C * j + r)];
            (x.iter().enumerate())
                .map(|(j, x)| (0..C).map(|r| entry(j, r) * x[r]).sum::<f64>())
                .sum()
        })
    }

    /// The products of some rows at a time: by columns, which are contiguous, in the order of
    /// [`product_at`](Matrix::product_at).
    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        const ROWS: usize = 8;
        let rows = self.nrows();
        for first in (0..rows).step_by(ROWS) {
            let count = ROWS.min(rows - first);
            let mut sums = [0.0; ROWS];
            for (j, x) in x.iter().enumerate() {
                let mut parts = [0.0; ROWS];
                for r in 0..C {
                    let column = &self.as_slice()[(C * j + r) * rows + first..][..count];
                    for (part, entry) in parts.iter_mut().zip(column) {
                        *part += entry * x[r];
                    }
                }
                for (sum, part) in sums.iter_mut().zip(parts) {
                    *sum += part;
                }
            }
            for (row, sum) in (first..).zip(&sums[..count]) {
                y[row / C][row % C] += sum * scale;
            }
        }
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.fixed_view::<C, C>(C * i, C * i).into_owned()
    }
}

impl<const C: usize> Operator<C> for DMatrix<f64> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn symmetric_part(&self) -> Option<Self> {
        Some((self + self.transpose()) * 0.5)
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        let mut own = self.fixed_view_mut::<C, C>(C * i, C * i);
        own += block;
    }

    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        basis.links.congruent(|step| match step {
            Elementary::Add { from, to, share } => {
                let rows = self.fixed_rows::<C>(C * from) * share;
                let mut target = self.fixed_rows_mut::<C>(C * to);
                target += rows;
                let columns = self.fixed_columns::<C>(C * from) * share;
                let mut target = self.fixed_columns_mut::<C>(C * to);
                target += columns;
            }
            Elementary::Negate(i) => {
                self.fixed_rows_mut::<C>(C * i).neg_mut();
                self.fixed_columns_mut::<C>(C * i).neg_mut();
            }
        });
        for (i, axes) in basis.axes.iter() {
            let rows = axes.tr_mul(&self.fixed_rows::<C>(C * i));
            self.fixed_rows_mut::<C>(C * i).copy_from(&rows);
            let columns = self.fixed_columns::<C>(C * i) * axes;
            self.fixed_columns_mut::<C>(C * i).copy_from(&columns);
        }
        true
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let first = terms.first().copied().or(mass);
        let size = first.map_or(0, |(_, term)| term.nrows());
        let mut sum = Self::zeros(size, size);
        Operator::<C>::set_combination_with(&mut sum, terms, mass);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.fill(0.0);
        for (factor, term) in terms.iter().copied().chain(mass) {
            for (sum, value) in self.iter_mut().zip(term.iter()) {
                *sum += factor * value;
            }
        }
    }

    fn format() -> &'static str {
        "DMatrix"
    }
}
