//! The memory of products, which keeps the last ones.

use std::sync::{Mutex, PoisonError};

use nalgebra::SVector;

use crate::hmatrix::{HMatrix, HMatrixScratch};

/// The memory of a product: its slip, and its rows.
struct Memory {
    slip: Vec<f64>,
    /// By cell.
    rows: Vec<f64>,
    is_made: bool,
    scratch: HMatrixScratch,
}

impl Memory {
    fn new(matrix: &HMatrix) -> Self {
        let ([receivers, sources], [of_receiver, of_source]) = (matrix.cells(), matrix.shape());
        Self {
            slip: vec![0.0; sources * of_source],
            rows: vec![0.0; receivers * of_receiver],
            is_made: false,
            scratch: matrix.scratch(),
        }
    }

    fn is_of<const C: usize>(&self, slip: &[SVector<f64, C>]) -> bool {
        let mut known = self.slip.chunks_exact(C).zip(slip);
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        self.is_made && known.all(|(a, b)| a.iter().zip(b.iter()).all(same))
    }
}

/// Memories of products, as many as threads have needed at a time.
///
/// Forces and normal stress of one slip are rows of one product: whoever asks second finds it made.
pub(super) struct Memories(Mutex<Vec<Memory>>);

impl Memories {
    pub(super) fn of(matrix: &HMatrix) -> Self {
        Self(Mutex::new(vec![Memory::new(matrix)]))
    }

    /// The memory of this slip, else the one that was used longest ago.
    fn take<const C: usize>(&self, matrix: &HMatrix, slip: &[SVector<f64, C>]) -> Memory {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let own = all
            .iter()
            .position(|memory| memory.is_of(slip))
            .unwrap_or(0);
        if own < all.len() {
            return all.remove(own);
        }
        drop(all);
        Memory::new(matrix)
    }

    fn give(&self, memory: Memory) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.push(memory);
    }

    /// Passes on the rows of all cells due to slip. No lock is held during the product.
    pub(super) fn product<T, const C: usize>(
        &self,
        matrix: &HMatrix,
        slip: &[SVector<f64, C>],
        look: impl FnOnce(&[f64]) -> T,
    ) -> T {
        let mut memory = self.take(matrix, slip);
        if !memory.is_of(slip) {
            let Memory {
                slip: kept,
                rows,
                scratch,
                is_made,
            } = &mut memory;
            for (kept, slip) in kept.chunks_exact_mut(C).zip(slip) {
                kept.copy_from_slice(slip.as_slice());
            }
            let of_cell = matrix.shape()[0];
            matrix.product(
                scratch,
                |source| slip[source].as_slice(),
                |cell, found| {
                    rows[of_cell * cell..of_cell * (cell + 1)].copy_from_slice(found);
                },
            );
            *is_made = true;
        }
        let found = look(&memory.rows);
        self.give(memory);
        found
    }

    /// Passes on the places among them, the numbers and the rows of some cells, at the cost of the blocks they need.
    pub(super) fn product_at<const C: usize>(
        &self,
        matrix: &HMatrix,
        cells: impl Iterator<Item = usize> + Clone,
        slip: &[SVector<f64, C>],
        mut show: impl FnMut(usize, usize, &[f64]),
    ) {
        let mut memory = self.take(matrix, slip);
        let of_cell = matrix.shape()[0];
        if memory.is_of(slip) {
            for (place, cell) in cells.enumerate() {
                show(
                    place,
                    cell,
                    &memory.rows[of_cell * cell..of_cell * (cell + 1)],
                );
            }
        } else {
            let mut places = 0..;
            let scratch = &mut memory.scratch;
            let slip = |source: usize| slip[source].as_slice();
            matrix.product_at(cells, scratch, slip, |cell, rows| {
                show(places.next().unwrap_or_default(), cell, rows);
            });
        }
        self.give(memory);
    }
}
