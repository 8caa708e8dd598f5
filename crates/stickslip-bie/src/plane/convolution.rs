//! Products of matrices of the differences of cells, by two-dimensional Fourier transforms.

use nalgebra::{SMatrix, SVector};
use realfft::num_complex::Complex;

use super::transform::{Memory, PlaneTransform};
use super::whole_space::{Block, between};

/// The symmetric matrix of cells on a plane whose entries depend on the difference of the cells alone, and are even in
/// it: their spectrum is real.
#[derive(Debug)]
pub(crate) struct Convolution {
    transform: PlaneTransform,
    /// The pairs of components: (0, 0), then (0, 1), (1, 1).
    pairs: Vec<Pair>,
}

/// The entries between two components.
#[derive(Debug)]
struct Pair {
    /// Entries `[down dip][along strike]` by differences, both on their periods.
    entries: Vec<f64>,
    /// The spectrum `[k_strike][k_dip]`.
    spectrum: Vec<f64>,
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
    /// From the blocks by the difference of cells, receiver less source, and a correction of diagonal neighbours. On a
    /// periodic axis differences are from 0 to the number of cells.
    pub(crate) fn of_differences<const C: usize>(
        counts: [usize; 2],
        periodic: [bool; 2],
        directions: &[[f64; 2]; C],
        block: impl Fn([isize; 2]) -> Block,
        cross_correction: f64,
    ) -> Self {
        let transform = PlaneTransform::new(counts, periodic);
        let [length, rows] = transform.lengths;
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
        let mut pairs = Vec::new();
        for (a, b) in pairs_of::<C>() {
            let entries: Vec<f64> = blocks
                .iter()
                .map(|block| between(block, directions[a], directions[b]))
                .collect();
            let spectrum = transform.spectrum(&entries);
            let spectrum = spectrum.iter().map(|mode| mode.re).collect();
            pairs.push(Pair { entries, spectrum });
        }
        Self { transform, pairs }
    }

    /// On a plane that is periodic in both directions, from the blocks of its modes by waves per period.
    pub(crate) fn of_modes<const C: usize>(
        counts: [usize; 2],
        directions: &[[f64; 2]; C],
        block: impl Fn([usize; 2]) -> Block,
    ) -> Self {
        let transform = PlaneTransform::new(counts, [true; 2]);
        let mut pairs = Vec::new();
        let share = 1.0 / (counts[0] * counts[1]) as f64;
        for (a, b) in pairs_of::<C>() {
            let mut spectrum = Vec::new();
            for along in 0..counts[0] / 2 + 1 {
                for down in 0..counts[1] {
                    let block = block([along, down]);
                    spectrum.push(share * between(&block, directions[a], directions[b]));
                }
            }
            let entries = transform.values(&spectrum);
            pairs.push(Pair { entries, spectrum });
        }
        Self { transform, pairs }
    }

    /// The memory of a product of so many components.
    pub(crate) fn memory(&self, components: usize) -> Memory {
        self.transform.memory(components)
    }

    /// `A_ij`.
    pub(crate) fn entry<const C: usize>(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        let [columns, _] = self.transform.counts;
        let [length, rows] = self.transform.lengths;
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
        let [columns, rows] = self.transform.counts;
        debug_assert_eq!(x.len(), columns * rows);
        for c in 0..C {
            self.transform.forward(memory, c, |i| x[i][c]);
        }
        self.multiply::<C>(&mut memory.modes);
        for c in 0..C {
            self.transform.inverse(memory, c);
        }
        for i in 0..columns * rows {
            show(i, SVector::from_fn(|c, _| memory.products[c][i]));
        }
    }

    /// The transforms.
    pub(crate) fn transform(&self) -> &PlaneTransform {
        &self.transform
    }

    /// The spectrum between two components, by the wave number along strike, then down dip.
    pub(crate) fn spectrum(&self, a: usize, b: usize) -> &[f64] {
        &self.pairs[place(a, b)].spectrum
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
