//! What an operator does between modes, and between them and the boundary.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use nalgebra::SVector;

use super::StaticResponses;
use super::modes::column;
use super::ordered::Ordered;
use crate::abreast::{Row, WIDTH, lay, stack};
use crate::cholesky::Interior;
use crate::{BlockMatrix, SolveError};

/// What of an operator modes meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// `E^T N phi` by columns, one for each mode.
    pub boundary: Vec<f64>,
    /// `phi_i . N phi_j` by columns.
    pub modes: Vec<f64>,
}

impl<const C: usize> StaticResponses<C> {
    /// `E^T N phi` and `phi_i . N phi_j` of fields that are zero on the boundary and where a component is fixed, as
    /// modes are, by an operator with the pattern of the stiffness.
    ///
    /// # Errors
    /// [`SolveError::SizeMismatch`] for another pattern.
    pub fn between(
        &self,
        operator: &BlockMatrix<C>,
        modes: &[Vec<SVector<f64, C>>],
    ) -> Result<Between, SolveError> {
        self.check_pattern(operator)?;
        crate::energy::expect(modes.iter().map(|mode| (self.layout.size(), mode.len())))?;
        let (layout, count) = (&self.layout, self.owners.len());
        let (unknowns, interior) = (layout.unknowns(), layout.interior);
        let operator = Ordered::new(layout, operator);
        let factor = Interior {
            symbolic: &self.analysis.symbolic,
            factor: &self.factor,
            columns: interior,
        };
        let mut inside = Mat::zeros(interior, modes.len());
        for (k, mode) in modes.iter().enumerate() {
            for (value, positions) in mode.iter().zip(&layout.positions) {
                let inner = positions.iter().zip(value.iter());
                for (&place, &value) in inner.filter(|(place, _)| (**place as usize) < interior) {
                    inside[(place as usize, k)] = value;
                }
            }
        }
        let (mut x, mut forces) = (vec![[0.0; WIDTH]; unknowns], vec![[0.0; WIDTH]; unknowns]);
        let mut work: Vec<Row> = vec![[0.0; WIDTH]; self.work.len()];
        let mut stacked = vec![0.0; interior * WIDTH];
        let mut boundary = Vec::with_capacity(count * modes.len());
        let mut between = Mat::zeros(modes.len(), modes.len());
        for first in (0..modes.len()).step_by(WIDTH) {
            let end = modes.len().min(first + WIDTH);
            lay((first..end).map(|k| column(&inside, k)), &mut x[..interior]);
            operator.multiply(&x, &mut forces);
            stack(&forces[..interior], interior, &mut stacked);
            // Half of it, and the rest of the blocks on the diagonal.
            matmul(
                between.submatrix_mut(0, first, end, end - first),
                Accum::Replace,
                inside.subcols(0, end).transpose(),
                MatRef::from_column_major_slice(&stacked, interior, WIDTH).subcols(0, end - first),
                1.0,
                Par::Seq,
            );
            factor.forward(&mut forces, &mut work);
            for c in 0..end - first {
                boundary.extend(self.places.iter().map(|&place| forces[place][c]));
            }
        }
        let modes = (0..modes.len()).flat_map(|k| {
            let (between, count) = (&between, modes.len());
            (0..count).map(move |i| between[(i.min(k), i.max(k))])
        });
        let modes = modes.collect();
        Ok(Between { boundary, modes })
    }
}
