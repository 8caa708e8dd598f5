//! The values of a level: from the operator on the finest, from the finer level on the others.

use nalgebra::SMatrix;

use super::Level;
use crate::block::inverse;
use crate::block_matrix::Rows;
use crate::multigrid::entries::Entries;
use crate::multigrid::galerkin::{Product, RowsMut};
use crate::multigrid::linearization::Linearization;
use crate::multigrid::transfer::Transfer;
use crate::{BlockMatrix, Frames, SolveError};

impl<const C: usize> Level<C> {
    /// Keeps the matrix of the finest level from now on.
    pub(in crate::multigrid) fn keep_matrix(&mut self, operator: &BlockMatrix<C>) {
        if self.matrix.is_none() {
            let mut matrix = operator.clone();
            for i in 0..self.size() {
                copy_row(&mut matrix, self.of_operator(operator), i);
            }
            self.matrix = Some(matrix);
        }
    }

    /// Takes all values of the operator, with the fixed components dropped.
    pub(in crate::multigrid) fn restore(&mut self, operator: &BlockMatrix<C>) {
        self.dropped.copy_from_slice(&self.fixed);
        self.hessians.clear();
        for i in 0..self.size() {
            self.take_row(operator, i);
        }
    }

    /// Updates the strip of the finest level.
    pub(in crate::multigrid) fn linearize(
        &mut self,
        operator: &BlockMatrix<C>,
        linearization: &Linearization<'_, C>,
    ) -> Result<(), SolveError> {
        for (&vertex, dropped) in linearization.vertices.iter().zip(linearization.dropped) {
            self.dropped[vertex] = *dropped;
        }
        self.hessians.clear();
        self.hessians.extend_from_slice(linearization.hessians);
        for s in 0..self.strip.len() {
            let vertex = self.strip[s] as usize;
            if !self.take_row(operator, vertex) {
                return Err(SolveError::IndefiniteBlock { vertex });
            }
        }
        self.refresh_sets();
        Ok(())
    }

    /// Takes a row of the operator; false if its diagonal block is not positive definite.
    fn take_row(&mut self, operator: &BlockMatrix<C>, i: usize) -> bool {
        let entries = Entries {
            rows: Rows::of(operator),
            dropped: &self.dropped,
            frictional: &self.frictional,
            hessians: &self.hessians,
        };
        if let Some(matrix) = &mut self.matrix {
            copy_row(matrix, entries, i);
        }
        let diagonal = self.couplings.set_row(i, entries.row(i));
        self.invert(i, &diagonal)
    }

    /// Completes a row of a coarse level for cycles.
    fn complete(&mut self, i: usize) {
        if let Some(matrix) = &self.matrix {
            let row = Rows::of(matrix).row(i).map(|(j, block)| (j, *block));
            let diagonal = self.couplings.set_row(i, row);
            self.invert(i, &diagonal);
        }
    }

    fn refresh_sets(&mut self) {
        if let Some(matrix) = &self.matrix {
            self.sets.refresh(&Rows::of(matrix), &self.dropped);
        }
    }

    /// Computes all values from the finer level.
    pub(in crate::multigrid) fn assemble(
        &mut self,
        fine: Entries<'_, C>,
        frames: &Frames<C>,
        transfer: &Transfer,
    ) {
        self.dropped.copy_from_slice(&self.fixed);
        let product = Product {
            fine,
            frames,
            transfer,
            dropped: &self.dropped,
        };
        if let Some(matrix) = &mut self.matrix {
            product.assemble(&self.cuts, RowsMut::of(matrix), &mut self.positions);
        }
        for row in 0..self.size() {
            self.complete(row);
        }
    }

    /// Computes the values of the strip from the finer level.
    pub(in crate::multigrid) fn refresh(
        &mut self,
        finer: &Self,
        operator: &BlockMatrix<C>,
        transfer: &Transfer,
    ) {
        for &(coarse, fine) in &self.copies {
            let fine = fine as usize;
            self.dropped[coarse as usize] = finer.seen(fine, &finer.dropped[fine]);
        }
        for s in 0..self.strip.len() {
            let row = self.strip[s] as usize;
            let product = Product {
                fine: finer.entries(operator),
                frames: &finer.frames,
                transfer,
                dropped: &self.dropped,
            };
            if let Some(matrix) = &mut self.matrix {
                product.renew(row, RowsMut::of(matrix), &mut self.positions);
            }
            self.complete(row);
        }
        self.refresh_sets();
    }

    /// Finds the sets of the line smoother: vertices that stretched cells couple strongly.
    pub(in crate::multigrid) fn tie(&mut self, operator: &BlockMatrix<C>) {
        let entries = match &self.matrix {
            Some(matrix) => Entries {
                rows: Rows::of(matrix),
                dropped: &self.dropped,
                frictional: &[],
                hessians: &[],
            },
            None => Entries {
                rows: Rows::of(operator),
                dropped: &self.dropped,
                frictional: &self.frictional,
                hessians: &self.hessians,
            },
        };
        if self.sets.find_all(entries) {
            self.keep_matrix(operator);
            if let Some(matrix) = &self.matrix {
                let rows = Rows::of(matrix);
                self.sets.factorize_all(&rows, &self.dropped, &self.strip);
            }
        }
    }

    /// Inverts the diagonal block of a row; false if it is not positive definite.
    fn invert(&mut self, i: usize, block: &SMatrix<f64, C, C>) -> bool {
        let inverse = inverse(block, &self.dropped[i]);
        // A row without an inverse is not smoothed on this level: the other levels reduce its error.
        (self.couplings).set_inverse(i, &inverse.unwrap_or_else(SMatrix::zeros));
        inverse.is_some()
    }
}

/// Copies a row of the finest level.
fn copy_row<const C: usize>(matrix: &mut BlockMatrix<C>, entries: Entries<'_, C>, i: usize) {
    let range = entries.rows.range(i);
    for (target, (_, block)) in matrix.data_mut()[range].iter_mut().zip(entries.row(i)) {
        *target = block;
    }
}
