//! Block-diagonal matrices.

use nalgebra::{SMatrix, SVector};

use super::unknowns::Unknowns;

/// A block-diagonal matrix on the unknowns, one block per vertex.
///
/// It is a diagonal if vertices have one unknown each, as on a flat contact in the plane: one number per unknown.
#[derive(Debug)]
pub(super) struct Blocks<const C: usize> {
    blocks: Vec<SMatrix<f64, C, C>>,
    diagonal: Option<Vec<f64>>,
}

impl<const C: usize> Blocks<C> {
    pub(super) fn new(unknowns: &Unknowns<C>) -> Self {
        let (vertices, count) = (unknowns.vertices(), unknowns.count());
        let single = (0..vertices).all(|p| unknowns.free(p).count() <= 1);
        let blocks = if single { 0 } else { vertices };
        Self {
            blocks: vec![SMatrix::zeros(); blocks],
            diagonal: single.then(|| vec![0.0; count]),
        }
    }

    /// Sets a block, unless the matrix is stored as a diagonal.
    pub(super) fn set(&mut self, p: usize, block: &SMatrix<f64, C, C>) {
        self.blocks[p] = *block;
    }

    /// The diagonal, if the matrix is stored as one.
    pub(super) fn diagonal_mut(&mut self) -> Option<&mut [f64]> {
        self.diagonal.as_deref_mut()
    }

    /// `to = D from`
    pub(super) fn multiply(&self, unknowns: &Unknowns<C>, from: &[f64], to: &mut [f64]) {
        match &self.diagonal {
            Some(diagonal) => {
                for ((to, from), entry) in to.iter_mut().zip(from).zip(diagonal) {
                    *to = entry * from;
                }
            }
            None => self.for_each(unknowns, from, |i, value| to[i] = value),
        }
    }

    /// `to -= D from`
    pub(super) fn subtract(&self, unknowns: &Unknowns<C>, from: &[f64], to: &mut [f64]) {
        match &self.diagonal {
            Some(diagonal) => {
                for ((to, from), entry) in to.iter_mut().zip(from).zip(diagonal) {
                    *to -= entry * from;
                }
            }
            None => self.for_each(unknowns, from, |i, value| to[i] -= value),
        }
    }

    /// The entries of the product, block by block.
    #[inline]
    fn for_each(&self, unknowns: &Unknowns<C>, from: &[f64], mut take: impl FnMut(usize, f64)) {
        for (p, block) in self.blocks.iter().enumerate() {
            let mut vector = SVector::zeros();
            for (c, i) in unknowns.free(p) {
                vector[c] = from[i];
            }
            let vector = block * vector;
            for (c, i) in unknowns.free(p) {
                take(i, vector[c]);
            }
        }
    }
}
