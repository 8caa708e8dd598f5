//! The norm of a change of the body that follows its frictional vertices.

use nalgebra::SVector;

use crate::cholesky::{Interior, Layout};
use crate::{BlockMatrix, Matrix};

/// The norm of changes `E y` of the body by the change `y` of its frictional vertices.
pub(super) struct Measure<'a, const C: usize> {
    pub(super) layout: &'a Layout<C>,
    /// `E^T N E` by columns, if it is known.
    pub(super) dense: Option<&'a [f64]>,
    /// The extension to the body that is measured where the dense form is unknown.
    pub(super) interior: Interior<'a>,
    pub(super) norm: &'a BlockMatrix<C>,
    pub(super) extension: &'a mut [f64],
    pub(super) field: &'a mut [SVector<f64, C>],
    pub(super) work: &'a mut [f64],
    /// The number of extensions.
    pub(super) substitutions: usize,
}

impl<const C: usize> Measure<'_, C> {
    /// The norm of a change of the frictional vertices, one vector per vertex.
    pub(super) fn of(&mut self, change: &[SVector<f64, C>]) -> f64 {
        self.layout.scatter_boundary(change, self.extension);
        let (interior, boundary) = self.extension.split_at_mut(self.layout.interior);
        if let Some(matrix) = self.dense {
            return norm(matrix, boundary);
        }
        interior.fill(0.0);
        self.interior.backward(self.extension, self.work);
        self.substitutions += 1;
        self.layout.scatter(self.extension, self.field);
        self.norm.norm(self.field)
    }
}

/// `sqrt(y . G y)`: zero for a square that rounding made negative, NaN for a NaN.
fn norm(matrix: &[f64], y: &[f64]) -> f64 {
    let columns = matrix.chunks_exact(y.len().max(1)).zip(y);
    let square: f64 = columns
        .map(|(column, y_j)| {
            let image: f64 = column.iter().zip(y).map(|(entry, y_i)| entry * y_i).sum();
            y_j * image
        })
        .sum();
    if square < 0.0 { 0.0 } else { square.sqrt() }
}
