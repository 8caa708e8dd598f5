//! Products of an operator with fields such as modes, and with the boundary.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use nalgebra::{DMatrix, SVector};

use super::ordered::Ordered;
use super::{StaticResponses, substitution};
use crate::several_vectors::{Row, WIDTH, lay, stack};
use crate::{BlockMatrix, SolveError};

/// The matrix of an operator between fields, and between fields and the boundary.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// `E^T N phi` by columns, one per field.
    pub boundary: Vec<f64>,
    /// `phi_i . N phi_j`.
    pub fields: DMatrix<f64>,
}

impl<const C: usize> StaticResponses<C> {
    /// `E^T N phi` and `phi_i . N phi_j` of fields that vanish on fixed components, as modes do, for an operator with
    /// the pattern of the stiffness.
    ///
    /// # Errors
    /// [`SolveError::SizeMismatch`] for another pattern.
    pub fn between(
        &self,
        operator: &BlockMatrix<C>,
        fields: &[Vec<SVector<f64, C>>],
    ) -> Result<Between, SolveError> {
        self.check_pattern(operator)?;
        crate::energy::expect(fields.iter().map(|field| (self.layout.size(), field.len())))?;
        let (layout, count) = (&self.layout, self.owners.len());
        let unknowns = layout.unknowns();
        let operator = Ordered::new(layout, operator);
        let factor = substitution(&self.analysis, &self.factor, layout);
        let mut ordered = vec![0.0; unknowns * fields.len()];
        for (ordered, field) in ordered.chunks_exact_mut(unknowns).zip(fields) {
            layout.gather_free(field, ordered);
        }
        let (mut x, mut forces) = (vec![[0.0; WIDTH]; unknowns], vec![[0.0; WIDTH]; unknowns]);
        let mut work: Vec<Row> = vec![[0.0; WIDTH]; self.work.len()];
        let mut stacked = vec![0.0; unknowns * WIDTH];
        let mut boundary = Vec::with_capacity(count * fields.len());
        let mut between = Mat::zeros(fields.len(), fields.len());
        for (k, group) in ordered.chunks(unknowns * WIDTH).enumerate() {
            let (first, group) = (k * WIDTH, group.chunks_exact(unknowns));
            let end = first + group.len();
            lay(group, &mut x);
            operator.multiply(&x, &mut forces);
            stack(&forces, unknowns, &mut stacked);
            // Half of it, and the rest of the blocks on the diagonal.
            let images = &stacked[..unknowns * (end - first)];
            multiply(
                &ordered[..unknowns * end],
                images,
                unknowns,
                &mut between,
                first,
            );
            factor.forward_abreast(&mut forces, &mut work);
            for c in 0..end - first {
                boundary.extend(self.places.iter().map(|&place| forces[place][c]));
            }
        }
        let count = fields.len();
        let fields = DMatrix::from_fn(count, count, |i, k| between[(i.min(k), i.max(k))]);
        Ok(Between { boundary, fields })
    }
}

/// The products of fields, stored one after the other, with `images`, in as many rows and the columns from `first` on.
fn multiply(fields: &[f64], images: &[f64], size: usize, into: &mut Mat<f64>, first: usize) {
    let (rows, columns) = (fields.len() / size, images.len() / size);
    matmul(
        into.submatrix_mut(0, first, rows, columns),
        Accum::Replace,
        MatRef::from_column_major_slice(fields, size, rows).transpose(),
        MatRef::from_column_major_slice(images, size, columns),
        1.0,
        Par::Seq,
    );
}
