//! Smooth matrices of rows, one per mode along strike, as sums of products of columns and rows.

use pulp::Simd;
use realfft::num_complex::Complex;

use super::mode_matrices::{Double, ModeMatrices, PANEL, padded};
use super::modes::add_whole_panel;

/// The largest error of a number, as a share of the largest number of all modes: that of an entry is some times larger,
/// below the rounding of transforms down dip.
const TOLERANCE: f64 = 1e-13;

/// `sum_k u_k(i) v_k(j)` for each mode.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ranks {
    rows: usize,
    modes: Vec<Mode>,
    /// `v`: by mode, then panel of pairs, then slipping row. `u`: by mode, then panel of receiving rows, then pair.
    panels: Vec<Double>,
}

/// The pairs of a mode.
#[derive(Debug, Clone, PartialEq)]
struct Mode {
    rank: usize,
    /// Its first panel.
    first: usize,
}

impl Ranks {
    /// Approximates every number to [`TOLERANCE`] of the largest; none if products would take more than so many
    /// multiplications.
    pub(super) fn of(
        matrices: &ModeMatrices,
        [modes, rows]: [usize; 2],
        largest: f64,
        most: usize,
    ) -> Option<Self> {
        let mut own = Self {
            rows,
            modes: Vec::new(),
            panels: Vec::new(),
        };
        let mut left = vec![0.0; rows * rows];
        for mode in 0..modes {
            for (i, row) in left.chunks_exact_mut(rows).enumerate() {
                for (j, value) in row.iter_mut().enumerate() {
                    *value = matrices.get(mode, i, j);
                }
            }
            own.add_mode(&mut left, TOLERANCE * largest);
            if own.multiplications() > most {
                return None;
            }
        }
        Some(own)
    }

    /// Eliminates with complete pivoting until no number is larger than a bound. The rank is that of the numbers, and
    /// the error known.
    fn add_mode(&mut self, left: &mut [f64], bound: f64) {
        let rows = self.rows;
        let (mut columns, mut pivots): (Vec<f64>, Vec<f64>) = Default::default();
        loop {
            let places = left.iter().enumerate();
            let pivot = places.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
            let Some((place, &value)) = pivot.filter(|(_, value)| value.abs() > bound) else {
                break;
            };
            let (i, j) = (place / rows, place % rows);
            let begin = columns.len();
            columns.extend(left.chunks_exact(rows).map(|row| row[j] / value));
            pivots.extend_from_slice(&left[i * rows..][..rows]);
            let (u, v) = (&columns[begin..], &pivots[begin..]);
            for (row, u) in left.chunks_exact_mut(rows).zip(u) {
                for (left, v) in row.iter_mut().zip(v) {
                    *left -= u * v;
                }
            }
            // Rounding leaves no pivot that could be met again.
            left[i * rows..][..rows].fill(0.0);
            left.chunks_exact_mut(rows).for_each(|row| row[j] = 0.0);
        }
        let rank = columns.len() / rows;
        let value = |of: &[f64], k: usize, i: usize| {
            let inside = k < rank && i < rows;
            if inside { of[k * rows + i] } else { 0.0 }
        };
        self.modes.push(Mode {
            rank,
            first: self.panels.len(),
        });
        for k in (0..rank).step_by(PANEL) {
            let panel =
                (0..rows).map(|j| Double(std::array::from_fn(|lane| value(&pivots, k + lane, j))));
            self.panels.extend(panel);
        }
        for i in (0..padded(rows)).step_by(PANEL) {
            let panel =
                (0..rank).map(|k| Double(std::array::from_fn(|lane| value(&columns, k, i + lane))));
            self.panels.extend(panel);
        }
    }

    /// The multiplications of a complex number by a real one in the products of all modes.
    pub(super) fn multiplications(&self) -> usize {
        PANEL * self.panels.len()
    }

    /// The largest rank of a mode.
    pub(super) fn largest(&self) -> usize {
        let ranks = self.modes.iter().map(|mode| mode.rank);
        ranks.max().unwrap_or(0)
    }

    /// The mean rank of a mode.
    pub(super) fn mean(&self) -> f64 {
        let sum: usize = self.modes.iter().map(|mode| mode.rank).sum();
        sum as f64 / self.modes.len() as f64
    }

    /// The rank of a mode, the panels of `v`, and those of `u`.
    fn of_mode(&self, mode: usize) -> (usize, &[Double], &[Double]) {
        let Mode { rank, first } = self.modes[mode];
        let (pairs, rows) = (padded(rank) / PANEL, padded(self.rows) / PANEL);
        let panels = &self.panels[first..][..pairs * self.rows + rows * rank];
        let (v, u) = panels.split_at(pairs * self.rows);
        (rank, v, u)
    }

    /// The number between two rows at a mode.
    pub(super) fn get(&self, mode: usize, receiver: usize, source: usize) -> f64 {
        let (rank, v, u) = self.of_mode(mode);
        let u = &u[receiver / PANEL * rank..][..rank];
        let terms = u
            .iter()
            .enumerate()
            .map(|(k, u)| u.0[receiver % PANEL] * v[k / PANEL * self.rows + source].0[k % PANEL]);
        terms.sum()
    }

    /// Adds the products of a mode, times the imaginary unit if they are odd: real parts and imaginary parts apart. The
    /// memory has room for twice the largest rank, up to whole panels, and for as many complex numbers.
    #[inline(always)]
    pub(super) fn add<S: Simd, const ODD: bool>(
        &self,
        simd: S,
        mode: usize,
        x: &[Complex<f64>],
        (parts, pairs): (&mut [f64], &mut [Complex<f64>]),
        y: &mut [f64],
    ) {
        let (rank, v, u) = self.of_mode(mode);
        let width = padded(rank);
        let (real, imaginary) = parts[..2 * width].split_at_mut(width);
        real.fill(0.0);
        imaginary.fill(0.0);
        let outputs = real.chunks_exact_mut(PANEL);
        let outputs = outputs.zip(imaginary.chunks_exact_mut(PANEL));
        for (panel, (real, imaginary)) in v.chunks_exact(self.rows).zip(outputs) {
            add_whole_panel::<S, ODD>(simd, panel, x, real, imaginary);
        }
        let pairs = &mut pairs[..rank];
        for ((pair, &re), &im) in pairs.iter_mut().zip(&*real).zip(&*imaginary) {
            *pair = Complex::new(re, im);
        }
        if rank > 0 {
            let (real, imaginary) = y.split_at_mut(padded(self.rows));
            let outputs = real.chunks_exact_mut(PANEL);
            let outputs = outputs.zip(imaginary.chunks_exact_mut(PANEL));
            for (panel, (real, imaginary)) in u.chunks_exact(rank).zip(outputs) {
                add_whole_panel::<S, false>(simd, panel, pairs, real, imaginary);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Images `1/(1 + i + j)`, that decay with the mode.
    #[test]
    fn numbers_are_kept_to_the_tolerance() {
        let (modes, rows) = (5, 40);
        let mut matrices = ModeMatrices::new([0, 0], false, modes, rows);
        let number = |mode: usize, i: usize, j: usize| {
            (-0.1 * (mode * (i + j)) as f64).exp() / (1 + i + j) as f64
        };
        for (mode, i) in (0..modes).flat_map(|mode| (0..rows).map(move |i| (mode, i))) {
            (0..rows).for_each(|j| matrices.set(mode, i, j, number(mode, i, j)));
        }
        let ranks = Ranks::of(&matrices, [modes, rows], 1.0, usize::MAX).expect("no limit");
        // A Hilbert matrix has some ln(1/eps) ln(n) singular values above eps.
        assert!(ranks.largest() < 24, "{}", ranks.largest());
        for (mode, i) in (0..modes).flat_map(|mode| (0..rows).map(move |i| (mode, i))) {
            for j in 0..rows {
                let error = ranks.get(mode, i, j) - number(mode, i, j);
                assert!(error.abs() < 2.0 * TOLERANCE, "{mode} {i} {j} {error:e}");
            }
        }
        let affordable = ranks.multiplications();
        assert!(Ranks::of(&matrices, [modes, rows], 1.0, affordable).is_some());
        assert!(Ranks::of(&matrices, [modes, rows], 1.0, affordable - 1).is_none());
    }
}
