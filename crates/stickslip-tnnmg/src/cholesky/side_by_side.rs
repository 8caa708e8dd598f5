//! The two triangular solves for vectors abreast: the factor is read once for all.

use pulp::{Arch, Simd, WithSimd};

use crate::abreast::{Row, WIDTH, multiply, subtract};

use super::substitution::{Interior, Panel};

/// Columns that one pass over the entries below them takes together.
const COLUMNS: usize = 4;

impl Interior<'_> {
    /// [`forward`](Self::forward) of every vector; `work` holds a row for each one of the tallest supernode.
    pub(crate) fn forward_all(&self, x: &mut [Row], work: &mut [Row]) {
        Arch::new().dispatch(Forward {
            factor: self,
            x,
            work,
        });
    }

    /// [`backward`](Self::backward) of every vector, likewise.
    pub(crate) fn backward_all(&self, x: &mut [Row], work: &mut [Row]) {
        Arch::new().dispatch(Backward {
            factor: self,
            x,
            work,
        });
    }
}

struct Forward<'a> {
    factor: &'a Interior<'a>,
    x: &'a mut [Row],
    work: &'a mut [Row],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factor, x, work } = self;
        for s in 0..factor.panels() {
            let panel = factor.panel(s);
            let work = &mut work[..panel.height];
            let own = &mut x[panel.begin..][..panel.own];
            work[..panel.own].copy_from_slice(own);
            work[panel.own..].fill([0.0; WIDTH]);
            panel.forward_all(simd, work);
            own.copy_from_slice(&work[..panel.own]);
            for (&row, values) in panel.below.iter().zip(&work[panel.own..]) {
                for r in 0..WIDTH {
                    x[row][r] += values[r];
                }
            }
        }
    }
}

struct Backward<'a> {
    factor: &'a Interior<'a>,
    x: &'a mut [Row],
    work: &'a mut [Row],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factor, x, work } = self;
        for s in (0..factor.panels()).rev() {
            let panel = factor.panel(s);
            let work = &mut work[..panel.height];
            work[..panel.own].copy_from_slice(&x[panel.begin..][..panel.own]);
            for (values, &row) in work[panel.own..].iter_mut().zip(panel.below) {
                *values = x[row];
            }
            panel.backward_all(simd, work);
            x[panel.begin..][..panel.columns].copy_from_slice(&work[..panel.columns]);
        }
    }
}

impl Panel<'_> {
    #[inline(always)]
    fn forward_all<S: Simd>(&self, simd: S, x: &mut [Row]) {
        let whole = self.columns - self.columns % COLUMNS;
        for j in (0..whole).step_by(COLUMNS) {
            self.forward_columns::<S, COLUMNS>(simd, j, x);
        }
        for j in whole..self.columns {
            self.forward_columns::<S, 1>(simd, j, x);
        }
    }

    #[inline(always)]
    fn forward_columns<S: Simd, const N: usize>(&self, simd: S, j: usize, x: &mut [Row]) {
        let columns: [&[f64]; N] = std::array::from_fn(|k| self.column(j + k));
        let (own, x) = x[j..].split_at_mut(N);
        let mut known = [[0.0; WIDTH]; N];
        for k in 0..N {
            for r in 0..WIDTH {
                known[k][r] = own[k][r] / columns[k][j + k];
            }
            for i in k + 1..N {
                for r in 0..WIDTH {
                    own[i][r] -= columns[k][j + i] * known[k][r];
                }
            }
        }
        own.copy_from_slice(&known);
        subtract(simd, columns.map(|column| &column[j + N..]), &known, x);
    }

    #[inline(always)]
    fn backward_all<S: Simd>(&self, simd: S, x: &mut [Row]) {
        let whole = self.columns - self.columns % COLUMNS;
        for j in (whole..self.columns).rev() {
            self.backward_columns::<S, 1>(simd, j, x);
        }
        for j in (0..whole).step_by(COLUMNS).rev() {
            self.backward_columns::<S, COLUMNS>(simd, j, x);
        }
    }

    #[inline(always)]
    fn backward_columns<S: Simd, const N: usize>(&self, simd: S, j: usize, x: &mut [Row]) {
        let columns: [&[f64]; N] = std::array::from_fn(|k| self.column(j + k));
        let (own, x) = x[j..].split_at_mut(N);
        let mut sums = [[0.0; WIDTH]; N];
        multiply(simd, columns.map(|column| &column[j + N..]), x, &mut sums);
        for k in (0..N).rev() {
            for r in 0..WIDTH {
                let mut value = own[k][r] - sums[k][r];
                for i in k + 1..N {
                    value -= columns[k][j + i] * own[i][r];
                }
                own[k][r] = value / columns[k][j + k];
            }
        }
    }
}
