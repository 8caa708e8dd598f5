//! One matrix per mode along strike.

use std::ops::Range;

/// Receiving rows whose sums are in registers together, with two sources at a time: 8 sums of 4 numbers.
pub(crate) const PANEL: usize = 8;

/// The share of the largest number of a matrix below which numbers are in single precision. Rounding them moves an entry
/// by less than 1e-13 of the largest, and a quarter of the memory is saved, which a product reads once.
const SINGLE: f64 = 1.0 / (1 << 20) as f64;

/// The share below which they are left out, far from the diagonal at short waves: an entry is a sum over modes, which that
/// moves by less than 1e-14 of the largest one for a thousand of them.
const NOTHING: f64 = 1.0 / (1_u64 << 56) as f64;

/// One real matrix of rows per mode, for the spectrum of an even function, or for the spectrum of an odd one divided by
/// the imaginary unit.
#[derive(Debug, Clone)]
pub(crate) struct ModeMatrices {
    /// The receiving and the slipping component.
    pub(crate) components: [usize; 2],
    pub(crate) odd: bool,
    rows: usize,
    /// Panels `[mode][panel of receiving rows]`.
    panels: Vec<Panel>,
    pub(super) double: Vec<Double>,
    pub(super) single: Vec<Single>,
}

/// Where the numbers of a panel are: those of the slipping rows `rows` in double precision, the others of `stored` in
/// single precision. The numbers of rows before and in between are even.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub(super) stored: Range<usize>,
    pub(super) rows: Range<usize>,
    pub(super) double: usize,
    pub(super) single: usize,
}

/// The numbers of the receiving rows of a panel due to a slipping row, in one line of the cache.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Double(pub(super) [f64; PANEL]);

/// The same in half a line.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Single([f32; PANEL]);

/// Numbers of a panel in either precision.
pub(crate) trait Numbers {
    fn numbers(&self) -> [f64; PANEL];
}

impl Numbers for Double {
    #[inline(always)]
    fn numbers(&self) -> [f64; PANEL] {
        self.0
    }
}

impl Numbers for Single {
    #[inline(always)]
    fn numbers(&self) -> [f64; PANEL] {
        self.0.map(f64::from)
    }
}

/// The rows of an output, filled up to whole panels.
pub(crate) fn padded(rows: usize) -> usize {
    rows.next_multiple_of(PANEL)
}

impl ModeMatrices {
    /// Zeros, in double precision.
    pub(crate) fn new(components: [usize; 2], odd: bool, modes: usize, rows: usize) -> Self {
        let panels = (0..modes * (padded(rows) / PANEL)).map(|panel| Panel {
            stored: 0..rows,
            rows: 0..rows,
            double: panel * rows,
            single: 0,
        });
        let panels: Vec<_> = panels.collect();
        Self {
            components,
            odd,
            rows,
            double: vec![Double([0.0; PANEL]); panels.len() * rows],
            single: Vec::new(),
            panels,
        }
    }

    /// The panel of a receiving row.
    fn panel(&self, mode: usize, receiver: usize) -> &Panel {
        &self.panels[mode * (padded(self.rows) / PANEL) + receiver / PANEL]
    }

    pub(crate) fn get(&self, mode: usize, receiver: usize, source: usize) -> f64 {
        let panel = self.panel(mode, receiver);
        let Panel { stored, rows, .. } = panel;
        let numbers = if rows.contains(&source) {
            self.double[panel.double + source - rows.start].numbers()
        } else if stored.contains(&source) {
            let skipped = if source < rows.start { 0 } else { rows.len() };
            self.single[panel.single + source - stored.start - skipped].numbers()
        } else {
            return 0.0;
        };
        numbers[receiver % PANEL]
    }

    /// Sets a number, before any is in single precision.
    pub(crate) fn set(&mut self, mode: usize, receiver: usize, source: usize, value: f64) {
        let place = self.panel(mode, receiver).double + source;
        self.double[place].0[receiver % PANEL] = value;
    }

    /// Adds a part that depends on the difference of rows, by mode, then difference from the least on; it may be empty.
    pub(crate) fn add_differences(&mut self, differences: &[f64]) {
        let rows = self.rows;
        for (mode, of_mode) in differences.chunks_exact(2 * rows - 1).enumerate() {
            for (i, j) in (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j))) {
                let value = self.get(mode, i, j) + of_mode[i + rows - 1 - j];
                self.set(mode, i, j, value);
            }
        }
    }

    /// The largest modulus of its numbers.
    pub(crate) fn largest(&self) -> f64 {
        let numbers = self.double.iter().flat_map(|numbers| numbers.0);
        numbers.fold(0.0, |largest, number| largest.max(number.abs()))
    }

    /// Stores small numbers in single precision, or leaves them out, beside the largest one of all matrices.
    pub(crate) fn compress(&mut self, largest: f64) {
        let mut double = Vec::new();
        for panel in &mut self.panels {
            let numbers = &self.double[panel.double..][..self.rows];
            let stored = extent(numbers, NOTHING * largest);
            let mut rows = extent(numbers, SINGLE * largest);
            if rows.is_empty() {
                rows = stored.start..stored.start;
            }
            panel.double = double.len();
            panel.single = self.single.len();
            double.extend_from_slice(&numbers[rows.clone()]);
            let before = &numbers[stored.start..rows.start];
            let others = before.iter().chain(&numbers[rows.end..stored.end]);
            let others = others.map(|numbers| Single(numbers.0.map(|x| x as f32)));
            self.single.extend(others);
            (panel.stored, panel.rows) = (stored, rows);
        }
        self.double = double;
    }

    /// The panels of a mode.
    pub(crate) fn of_mode(&self, mode: usize) -> &[Panel] {
        let count = padded(self.rows) / PANEL;
        &self.panels[mode * count..][..count]
    }
}

/// The rows from the first to the last with a number above a bound, widened to pairs.
fn extent(numbers: &[Double], bound: f64) -> Range<usize> {
    let exceeds = |numbers: &Double| numbers.0.iter().any(|x| x.abs() > bound);
    let first = numbers.iter().position(exceeds).unwrap_or(0);
    let last = numbers.iter().rposition(exceeds);
    let end = last.map_or(0, |last| last + 1);
    (first & !1)..end.next_multiple_of(2).min(numbers.len())
}

#[cfg(test)]
mod tests {
    use realfft::num_complex::Complex;

    use super::*;
    use crate::plane::modes::Product;

    /// Rows that fill no panel; numbers that fall away from the diagonal, below rounding of single precision.
    fn matrices(modes: usize, rows: usize) -> ModeMatrices {
        let mut own = ModeMatrices::new([0, 0], true, modes, rows);
        for (mode, i) in (0..modes).flat_map(|mode| (0..rows).map(move |i| (mode, i))) {
            for j in 0..rows {
                let decay = (-0.3 * mode as f64 * i.abs_diff(j) as f64).exp();
                own.set(mode, i, j, decay * (1.0 + i as f64).recip());
            }
        }
        own
    }

    #[test]
    fn numbers_in_single_precision_are_small() {
        let exact = matrices(12, 21);
        let mut own = exact.clone();
        own.compress(own.largest());
        assert!(own.double.len() < exact.double.len() && !own.single.is_empty());
        assert!(own.double.len() + own.single.len() < exact.double.len());
        let bound = SINGLE * f64::from(f32::EPSILON);
        for (mode, i) in (0..12).flat_map(|mode| (0..21).map(move |i| (mode, i))) {
            for j in 0..21 {
                let [stored, given] = [&own, &exact].map(|matrices| matrices.get(mode, i, j));
                assert!((stored - given).abs() <= bound, "{mode} {i} {j}");
                assert!(stored == given || given.abs() <= SINGLE);
            }
        }
    }

    /// The sums of what is stored, in either order of the modes.
    #[test]
    fn products_are_those_of_the_numbers() {
        let mut own = matrices(12, 21);
        own.compress(own.largest());
        let x: Vec<_> = (0..11 * 21)
            .map(|k| Complex::new((k % 7) as f64 - 3.0, (k % 5) as f64))
            .collect();
        let width = padded(21);
        for backwards in [false, true] {
            let mut y = vec![f64::NAN; 11 * 2 * width];
            let product = Product {
                blocks: std::slice::from_ref(&own),
                rows: 21,
                first: 1,
                inputs: 1,
                outputs: 1,
                backwards,
                x: &x,
                y: &mut y,
            };
            product.run();
            for (mode, i) in (0..11).flat_map(|mode| (0..21).map(move |i| (mode, i))) {
                let terms = (0..21).map(|j| x[mode * 21 + j] * own.get(mode + 1, i, j));
                let exact: Complex<f64> = Complex::<f64>::i() * terms.sum::<Complex<f64>>();
                let y = &y[mode * 2 * width..];
                let found: Complex<f64> = Complex::new(y[i], y[width + i]);
                let error = (found - exact).norm();
                assert!(error < 1e-14 * 21.0 * 5.0, "{mode} {i}: {error:e}");
            }
        }
    }
}
