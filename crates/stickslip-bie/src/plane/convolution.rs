//! Products of matrices of the differences of cells, by two-dimensional Fourier transforms.

use std::fmt;
use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use super::whole_space::{Block, between};
use crate::convolution::fast_length;

/// The symmetric matrix of cells on a plane whose entries depend on the difference of the cells alone, and are even in
/// it: their spectrum is real.
pub(crate) struct Convolution {
    /// Cells along strike and down dip.
    counts: [usize; 2],
    /// Of the transforms.
    lengths: [usize; 2],
    along_strike: (Arc<dyn RealToComplex<f64>>, Arc<dyn ComplexToReal<f64>>),
    down_dip: (Arc<dyn Fft<f64>>, Arc<dyn Fft<f64>>),
    /// Of the pairs of components: (0, 0), then (0, 1), (1, 1).
    pairs: Vec<Pair>,
}

/// The entries between two components.
struct Pair {
    /// By the difference down dip, then along strike, both on their periods.
    entries: Vec<f64>,
    /// By the wave number along strike, then down dip.
    spectrum: Vec<f64>,
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    values: Vec<f64>,
    row: Vec<Complex<f64>>,
    /// Of each component, by the wave number along strike, then down dip.
    modes: Vec<Vec<Complex<f64>>>,
    scratch: Vec<Complex<f64>>,
    /// Of each component, by cells.
    products: Vec<Vec<f64>>,
}

/// The place of a pair of components.
fn place(a: usize, b: usize) -> usize {
    let (low, high) = (a.min(b), a.max(b));
    high * (high + 1) / 2 + low
}

/// A distance on a period as a difference of two of `count` cells; none if there is no such pair.
fn difference(place: usize, length: usize, count: usize, periodic: bool) -> Option<isize> {
    if place < count || periodic {
        Some(place as isize)
    } else if place > length - count {
        Some(place as isize - length as isize)
    } else {
        None
    }
}

impl Convolution {
    fn empty(counts: [usize; 2], periodic: [bool; 2]) -> Self {
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
            pairs: Vec::new(),
        }
    }

    /// From the blocks by the difference of cells, receiver less source, and a correction of diagonal neighbours. On a
    /// periodic axis differences are from 0 to the number of cells.
    pub(crate) fn of_differences<const C: usize>(
        counts: [usize; 2],
        periodic: [bool; 2],
        directions: &[[f64; 2]; C],
        block: impl Fn([isize; 2]) -> Block,
        cross_correction: f64,
    ) -> Self {
        let mut own = Self::empty(counts, periodic);
        let [length, rows] = own.lengths;
        let mut blocks = vec![[0.0; 3]; length * rows];
        for y in 0..rows {
            let Some(down) = difference(y, rows, counts[1], periodic[1]) else {
                continue;
            };
            for x in 0..length {
                if let Some(along) = difference(x, length, counts[0], periodic[0]) {
                    blocks[y * length + x] = block([along, down]);
                }
            }
        }
        // A neighbour exists among two cells, and on a period always.
        if (0..2).all(|axis| counts[axis] > 1 || periodic[axis]) {
            for (along, down, sign) in [(1, 1, 1.0), (1, rows - 1, -1.0)] {
                for (x, y) in [(along, down), (length - along, (rows - down) % rows)] {
                    blocks[(y % rows) * length + x % length][2] += sign * cross_correction;
                }
            }
        }
        for (a, b) in pairs_of::<C>() {
            let entries: Vec<f64> = blocks
                .iter()
                .map(|block| between(block, directions[a], directions[b]))
                .collect();
            let spectrum = own.spectrum(&entries);
            own.pairs.push(Pair { entries, spectrum });
        }
        own
    }

    /// On a plane that is periodic in both directions, from the blocks of its modes by waves per period.
    pub(crate) fn of_modes<const C: usize>(
        counts: [usize; 2],
        directions: &[[f64; 2]; C],
        block: impl Fn([usize; 2]) -> Block,
    ) -> Self {
        let mut own = Self::empty(counts, [true; 2]);
        let share = 1.0 / (counts[0] * counts[1]) as f64;
        for (a, b) in pairs_of::<C>() {
            let mut spectrum = Vec::new();
            for along in 0..counts[0] / 2 + 1 {
                for down in 0..counts[1] {
                    let block = block([along, down]);
                    spectrum.push(share * between(&block, directions[a], directions[b]));
                }
            }
            let entries = own.values(&spectrum);
            own.pairs.push(Pair { entries, spectrum });
        }
        own
    }

    /// The real spectrum of even entries, divided by the number of places.
    fn spectrum(&self, entries: &[f64]) -> Vec<f64> {
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
        modes[0].iter().map(|mode| share * mode.re).collect()
    }

    /// The entries of a spectrum.
    fn values(&self, spectrum: &[f64]) -> Vec<f64> {
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

    /// `A_ij`.
    pub(crate) fn entry<const C: usize>(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        let [columns, _] = self.counts;
        let [length, rows] = self.lengths;
        // Both directions give the same entry.
        let x = (i % columns + length - j % columns) % length;
        let y = (i / columns + rows - j / columns) % rows;
        SMatrix::from_fn(|a, b| self.pairs[place(a, b)].entries[y * length + x])
    }

    /// Passes on `(A x)_i` of each cell. Allocates nothing.
    pub(crate) fn product<const C: usize>(
        &self,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, C>),
    ) {
        let [columns, rows] = self.counts;
        for c in 0..C {
            for modes in memory.modes[c].chunks_exact_mut(self.lengths[1]) {
                modes[rows..].fill(Complex::default());
            }
            for (y, cells) in x.chunks_exact(columns).enumerate() {
                let (filled, rest) = memory.values.split_at_mut(columns);
                for (value, x) in filled.iter_mut().zip(cells) {
                    *value = x[c];
                }
                rest.fill(0.0);
                self.row_to_modes(memory, c, y);
            }
            let Memory { modes, scratch, .. } = memory;
            self.down_dip.0.process_with_scratch(&mut modes[c], scratch);
        }
        self.multiply::<C>(&mut memory.modes);
        for c in 0..C {
            let Memory { modes, scratch, .. } = memory;
            self.down_dip.1.process_with_scratch(&mut modes[c], scratch);
            for y in 0..rows {
                self.modes_to_row(memory, c, y);
                let Memory {
                    values, products, ..
                } = memory;
                products[c][y * columns..][..columns].copy_from_slice(&values[..columns]);
            }
        }
        for i in 0..columns * rows {
            show(i, SVector::from_fn(|c, _| memory.products[c][i]));
        }
    }

    fn multiply<const C: usize>(&self, modes: &mut [Vec<Complex<f64>>]) {
        for mode in 0..modes[0].len() {
            let x: [Complex<f64>; C] = std::array::from_fn(|c| modes[c][mode]);
            for (a, modes) in modes.iter_mut().enumerate() {
                let terms = x.iter().enumerate();
                modes[mode] = terms
                    .map(|(b, x)| x * self.pairs[place(a, b)].spectrum[mode])
                    .sum();
            }
        }
    }
}

/// The pairs of components in the order of their places.
fn pairs_of<const C: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..C).flat_map(|high| (0..=high).map(move |low| (low, high)))
}

impl fmt::Debug for Convolution {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [columns, rows] = self.counts;
        write!(formatter, "Convolution({columns} x {rows})")
    }
}
