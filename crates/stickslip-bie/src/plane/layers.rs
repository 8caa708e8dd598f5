//! Products of matrices of cells of a dipping plane: Fourier transforms along strike, dense down dip.

use std::fmt;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::mode_matrices::ModeMatrices;
use crate::convolution::fast_length;

/// A matrix of cells whose entries depend on the difference of columns and on both rows. An entry is the sum of a part
/// that is even in the difference of columns, with a real spectrum, and of an odd one, with an imaginary one: a real
/// number per mode and pair of rows and part.
pub(crate) struct Layers {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) forward: Arc<dyn RealToComplex<f64>>,
    pub(super) inverse: Arc<dyn ComplexToReal<f64>>,
    pub(super) blocks: Vec<ModeMatrices>,
}

/// The memory of a transform along strike.
#[derive(Clone)]
pub(crate) struct RowMemory {
    pub(crate) values: Vec<f64>,
    pub(crate) modes: Vec<Complex<f64>>,
    pub(crate) scratch: Vec<Complex<f64>>,
}

impl Layers {
    /// Without entries.
    pub(crate) fn new(columns: usize, rows: usize) -> Self {
        let length = fast_length(2 * columns - 1);
        let mut planner = RealFftPlanner::new();
        Self {
            columns,
            rows,
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            blocks: Vec::new(),
        }
    }

    pub(super) fn modes(&self) -> usize {
        self.forward.len() / 2 + 1
    }

    /// Room for the even or odd entries between components, the receiving one first; its place.
    pub(crate) fn add_block(&mut self, components: [usize; 2], odd: bool) -> usize {
        let block = ModeMatrices::new(components, odd, self.modes(), self.rows);
        self.blocks.push(block);
        self.blocks.len() - 1
    }

    /// Sets the entries of a block between two rows, by the column of the receiver less that of the source, from 0 on.
    pub(crate) fn set_entries(
        &mut self,
        block: usize,
        [receiver, source]: [usize; 2],
        entries: &[f64],
        memory: &mut RowMemory,
    ) {
        let length = self.forward.len();
        let odd = self.blocks[block].odd;
        let mirrored = if odd { -1.0 } else { 1.0 };
        memory.values.fill(0.0);
        for (apart, &entry) in entries.iter().enumerate().take(self.columns) {
            memory.values[apart] = entry;
            if apart > 0 {
                memory.values[length - apart] = mirrored * entry;
            }
        }
        let RowMemory {
            values,
            modes,
            scratch,
        } = memory;
        let done = self.forward.process_with_scratch(values, modes, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        let share = (length as f64).recip();
        for (mode, value) in modes.iter().enumerate() {
            let value = share * if odd { value.im } else { value.re };
            self.blocks[block].set(mode, receiver, source, value);
        }
    }

    /// Stores small numbers in single precision, once all entries are set.
    pub(crate) fn compress(&mut self) {
        let largest = self.blocks.iter().map(ModeMatrices::largest);
        let largest = largest.fold(0.0, f64::max);
        for block in &mut self.blocks {
            block.compress(largest);
        }
    }

    pub(crate) fn row_memory(&self) -> RowMemory {
        let (forward, inverse) = (
            self.forward.get_scratch_len(),
            self.inverse.get_scratch_len(),
        );
        RowMemory {
            values: self.forward.make_input_vec(),
            modes: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); forward.max(inverse)],
        }
    }
}

impl fmt::Debug for Layers {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Layers({} x {})", self.columns, self.rows)
    }
}
