//! Two-dimensional Fourier transforms of the cells of a plane.

use std::fmt;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use crate::convolution::fast_length;

/// Transforms of the cells of a plane: real ones along strike, complex ones down dip.
pub(crate) struct PlaneTransform {
    /// Cells along strike and down dip.
    pub(crate) counts: [usize; 2],
    /// Of the transforms: twice the counts or more, so that nothing meets its own beginning, or those of a period.
    pub(crate) lengths: [usize; 2],
    along_strike: (Arc<dyn RealToComplex<f64>>, Arc<dyn ComplexToReal<f64>>),
    down_dip: (Arc<dyn Fft<f64>>, Arc<dyn Fft<f64>>),
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    values: Vec<f64>,
    row: Vec<Complex<f64>>,
    /// Spectra of each component, `[k_strike][k_dip]`.
    pub(crate) modes: Vec<Vec<Complex<f64>>>,
    pub(crate) scratch: Vec<Complex<f64>>,
    /// Products of each component, by cells.
    pub(crate) products: Vec<Vec<f64>>,
}

impl PlaneTransform {
    /// The transforms of `counts` cells, on a period or not.
    pub(crate) fn new(counts: [usize; 2], periodic: [bool; 2]) -> Self {
        let lengths = [0, 1].map(|axis| match periodic[axis] {
            true => counts[axis],
            false => fast_length(2 * counts[axis] - 1),
        });
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        Self {
            counts,
            lengths,
            along_strike: (
                real.plan_fft_forward(lengths[0]),
                real.plan_fft_inverse(lengths[0]),
            ),
            down_dip: (
                complex.plan_fft_forward(lengths[1]),
                complex.plan_fft_inverse(lengths[1]),
            ),
        }
    }

    /// Transforms a field on the cells to the modes of a component.
    pub(crate) fn forward(
        &self,
        memory: &mut Memory,
        component: usize,
        field: impl Fn(usize) -> f64,
    ) {
        let [columns, rows] = self.counts;
        for modes in memory.modes[component].chunks_exact_mut(self.lengths[1]) {
            modes[rows..].fill(Complex::default());
        }
        for y in 0..rows {
            let (filled, rest) = memory.values.split_at_mut(columns);
            for (x, value) in filled.iter_mut().enumerate() {
                *value = field(y * columns + x);
            }
            rest.fill(0.0);
            self.row_to_modes(memory, component, y);
        }
        let Memory { modes, scratch, .. } = memory;
        self.down_dip
            .0
            .process_with_scratch(&mut modes[component], scratch);
    }

    /// Transforms the modes of a component to its products.
    pub(crate) fn inverse(&self, memory: &mut Memory, component: usize) {
        let Memory { modes, scratch, .. } = memory;
        self.down_dip
            .1
            .process_with_scratch(&mut modes[component], scratch);
        self.rows_to_products(memory, component);
    }

    /// Transforms modes down dip to rows, for some wave numbers along strike one after the other.
    pub(crate) fn columns_to_rows(
        &self,
        columns: &mut [Complex<f64>],
        scratch: &mut [Complex<f64>],
    ) {
        self.down_dip.1.process_with_scratch(columns, scratch);
    }

    /// Transforms the rows of a component, still modes along strike, to its products.
    pub(crate) fn rows_to_products(&self, memory: &mut Memory, component: usize) {
        let [columns, rows] = self.counts;
        for y in 0..rows {
            self.modes_to_row(memory, component, y);
            let Memory {
                values, products, ..
            } = memory;
            products[component][y * columns..][..columns].copy_from_slice(&values[..columns]);
        }
    }

    /// The spectrum of entries by the places down dip, then along strike, divided by the number of places.
    pub(crate) fn spectrum(&self, entries: &[f64]) -> Vec<Complex<f64>> {
        let [length, rows] = self.lengths;
        let mut memory = self.memory(1);
        for y in 0..rows {
            memory
                .values
                .copy_from_slice(&entries[y * length..][..length]);
            self.row_to_modes(&mut memory, 0, y);
        }
        let Memory { modes, scratch, .. } = &mut memory;
        self.down_dip.0.process_with_scratch(&mut modes[0], scratch);
        let share = 1.0 / (length * rows) as f64;
        modes[0].iter().map(|mode| mode * share).collect()
    }

    /// The entries of a spectrum.
    pub(crate) fn values(&self, spectrum: &[f64]) -> Vec<f64> {
        let [length, rows] = self.lengths;
        let mut memory = self.memory(1);
        for (mode, &value) in memory.modes[0].iter_mut().zip(spectrum) {
            *mode = Complex::new(value, 0.0);
        }
        let Memory { modes, scratch, .. } = &mut memory;
        self.down_dip.1.process_with_scratch(&mut modes[0], scratch);
        let mut values = Vec::with_capacity(length * rows);
        for y in 0..rows {
            self.modes_to_row(&mut memory, 0, y);
            values.extend_from_slice(&memory.values);
        }
        values
    }

    /// Transforms the values along strike to the modes of a row.
    fn row_to_modes(&self, memory: &mut Memory, component: usize, y: usize) {
        let Memory {
            values,
            row,
            modes,
            scratch,
            ..
        } = memory;
        let done = self
            .along_strike
            .0
            .process_with_scratch(values, row, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        let columns = modes[component].chunks_exact_mut(self.lengths[1]);
        for (column, mode) in columns.zip(row) {
            column[y] = *mode;
        }
    }

    /// Transforms the modes of a row to values along strike.
    fn modes_to_row(&self, memory: &mut Memory, component: usize, y: usize) {
        let Memory {
            values,
            row,
            modes,
            scratch,
            ..
        } = memory;
        let columns = modes[component].chunks_exact(self.lengths[1]);
        for (mode, column) in row.iter_mut().zip(columns) {
            *mode = column[y];
        }
        // Real by symmetry; the inverse refuses what rounding might leave.
        row[0].im = 0.0;
        let last = row.len() - 1;
        if self.lengths[0].is_multiple_of(2) {
            row[last].im = 0.0;
        }
        let done = self
            .along_strike
            .1
            .process_with_scratch(row, values, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
    }

    /// The memory of a product of so many components.
    pub(crate) fn memory(&self, components: usize) -> Memory {
        let (forward, inverse) = &self.along_strike;
        let scratch = [
            forward.get_scratch_len(),
            inverse.get_scratch_len(),
            self.down_dip.0.get_inplace_scratch_len(),
            self.down_dip.1.get_inplace_scratch_len(),
        ];
        let row = forward.make_output_vec();
        let modes = vec![Complex::default(); row.len() * self.lengths[1]];
        Memory {
            values: forward.make_input_vec(),
            row,
            modes: vec![modes; components],
            scratch: vec![Complex::default(); scratch.into_iter().max().unwrap_or(0)],
            products: vec![vec![0.0; self.counts[0] * self.counts[1]]; components],
        }
    }
}

impl fmt::Debug for PlaneTransform {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [columns, rows] = self.counts;
        write!(formatter, "PlaneTransform({columns} x {rows})")
    }
}
