//! The entries of a matrix that is known by its modes.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, SMatrix};
use realfft::num_complex::Complex;

use super::layers::{Layers, RowMemory};

impl Layers {
    /// `A_ij`, by a sum over the modes.
    pub(crate) fn entry<const O: usize, const C: usize>(
        &self,
        i: usize,
        j: usize,
    ) -> SMatrix<f64, O, C> {
        let (receiver, source) = (i / self.columns, j / self.columns);
        let apart = (i % self.columns) as f64 - (j % self.columns) as f64;
        let length = self.forward.len();
        let mut entry = SMatrix::zeros();
        for (block, ([to, from], odd)) in self.blocks().enumerate() {
            let sum: f64 = (0..self.modes())
                .map(|mode| {
                    // All modes but the first and the last stand for two.
                    let twice = if mode == 0 || 2 * mode == length {
                        1.0
                    } else {
                        2.0
                    };
                    let angle = TAU * mode as f64 * apart / length as f64;
                    let wave = if odd { -angle.sin() } else { angle.cos() };
                    twice * wave * self.get(block, mode, receiver, source)
                })
                .sum();
            entry[(to, from)] += sum;
        }
        entry
    }

    /// Adds the entries to a dense matrix, by transforms.
    pub(crate) fn add_to_dense<const O: usize, const C: usize>(
        &self,
        factor: f64,
        dense: &mut DMatrix<f64>,
    ) {
        let (columns, length) = (self.columns, self.forward.len());
        let RowMemory {
            values,
            modes,
            scratch,
        } = &mut self.row_memory();
        for (block, ([to, from], odd)) in self.blocks().enumerate() {
            for (receiver, source) in
                (0..self.rows).flat_map(|r| (0..self.rows).map(move |s| (r, s)))
            {
                for (mode, value) in modes.iter_mut().enumerate() {
                    let entry = self.get(block, mode, receiver, source);
                    *value = match odd {
                        true => Complex::new(0.0, entry),
                        false => Complex::new(entry, 0.0),
                    };
                }
                // Real by symmetry; the inverse refuses what rounding might leave.
                modes[0].im = 0.0;
                let last = modes.len() - 1;
                modes[last].im = 0.0;
                let done = self.inverse.process_with_scratch(modes, values, scratch);
                debug_assert!(done.is_ok(), "{done:?}");
                for (i, j) in (0..columns).flat_map(|i| (0..columns).map(move |j| (i, j))) {
                    let place = (
                        O * (receiver * columns + i) + to,
                        C * (source * columns + j) + from,
                    );
                    dense[place] += factor * values[(i + length - j) % length];
                }
            }
        }
    }
}
