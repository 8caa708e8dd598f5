//! Products of matrices of cells of a dipping plane: Fourier transforms along strike, dense down dip.

use std::fmt;
use std::sync::Arc;

use nalgebra::SVector;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::modes::{ModeMatrices, Product, padded};
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

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    pub(super) values: Vec<f64>,
    pub(super) row: Vec<Complex<f64>>,
    pub(super) scratch: Vec<Complex<f64>>,
    /// By component, then mode, then row.
    x: Vec<Vec<Complex<f64>>>,
    y: Vec<Vec<f64>>,
    /// By component, then cell.
    products: Vec<Vec<f64>>,
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
        memory: &mut Memory,
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
        let Memory {
            values,
            row,
            scratch,
            ..
        } = memory;
        let done = self.forward.process_with_scratch(values, row, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        let share = (length as f64).recip();
        for (mode, value) in row.iter().enumerate() {
            let value = share * if odd { value.im } else { value.re };
            self.blocks[block].set(mode, receiver, source, value);
        }
    }

    /// The memory of a product.
    pub(crate) fn memory(&self, outputs: usize, inputs: usize) -> Memory {
        let scratch = self
            .forward
            .get_scratch_len()
            .max(self.inverse.get_scratch_len());
        Memory {
            values: self.forward.make_input_vec(),
            row: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); scratch],
            x: vec![vec![Complex::default(); self.modes() * self.rows]; inputs],
            y: vec![vec![0.0; self.modes() * 2 * padded(self.rows)]; outputs],
            products: vec![vec![0.0; self.columns * self.rows]; outputs],
        }
    }

    /// Passes on `(A x)_i` of each cell. Allocates nothing.
    pub(crate) fn product<const O: usize, const C: usize>(
        &self,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, O>),
    ) {
        debug_assert_eq!(x.len(), self.columns * self.rows);
        let Memory {
            values,
            row,
            scratch,
            x: modes,
            y,
            products,
        } = memory;
        for (c, modes) in modes.iter_mut().enumerate() {
            for (place, cells) in x.chunks_exact(self.columns).enumerate() {
                let (filled, rest) = values.split_at_mut(self.columns);
                for (value, x) in filled.iter_mut().zip(cells) {
                    *value = x[c];
                }
                rest.fill(0.0);
                let done = self.forward.process_with_scratch(values, row, scratch);
                debug_assert!(done.is_ok(), "{done:?}");
                for (modes, value) in modes.chunks_exact_mut(self.rows).zip(row.iter()) {
                    modes[place] = *value;
                }
            }
        }
        let mut inputs = [&[][..]; 2];
        for (input, modes) in inputs.iter_mut().zip(modes.iter()) {
            *input = modes;
        }
        let mut outputs = [&mut [][..], &mut [][..]];
        for (output, y) in outputs.iter_mut().zip(y.iter_mut()) {
            *output = y;
        }
        let product = Product {
            blocks: &self.blocks,
            rows: self.rows,
            first: 0,
            x: inputs,
            y: outputs,
        };
        product.run();
        let width = padded(self.rows);
        for (y, products) in y.iter().zip(products.iter_mut()) {
            for (place, cells) in products.chunks_exact_mut(self.columns).enumerate() {
                for (value, y) in row.iter_mut().zip(y.chunks_exact(2 * width)) {
                    *value = Complex::new(y[place], y[width + place]);
                }
                // Real by symmetry; the inverse refuses what rounding might leave.
                row[0].im = 0.0;
                let last = row.len() - 1;
                row[last].im = 0.0;
                let done = self.inverse.process_with_scratch(row, values, scratch);
                debug_assert!(done.is_ok(), "{done:?}");
                cells.copy_from_slice(&values[..self.columns]);
            }
        }
        for i in 0..self.columns * self.rows {
            show(i, SVector::from_fn(|c, _| products[c][i]));
        }
    }
}

impl fmt::Debug for Layers {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Layers({} x {})", self.columns, self.rows)
    }
}
