//! The two triangular solves for several right-hand sides: the factor is read once for all.

use pulp::Simd;

use crate::several_vectors::{Row, WIDTH, multiply, subtract};

use super::substitution::{Entry, Panel};

/// Columns per pass over the entries below them.
const COLUMNS: usize = 4;

impl Entry for Row {
    const ZERO: Row = [0.0; WIDTH];

    #[inline(always)]
    fn add(&mut self, other: Row) {
        for r in 0..WIDTH {
            self[r] += other[r];
        }
    }

    #[inline(always)]
    fn forward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [Row]) {
        let whole = panel.columns - panel.columns % COLUMNS;
        for j in (0..whole).step_by(COLUMNS) {
            panel.forward_columns::<S, COLUMNS>(simd, j, x);
        }
        match panel.columns - whole {
            3 => panel.forward_columns::<S, 3>(simd, whole, x),
            2 => panel.forward_columns::<S, 2>(simd, whole, x),
            1 => panel.forward_columns::<S, 1>(simd, whole, x),
            _ => (),
        }
    }

    #[inline(always)]
    fn backward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [Row]) {
        let whole = panel.columns - panel.columns % COLUMNS;
        match panel.columns - whole {
            3 => panel.backward_columns::<S, 3>(simd, whole, x),
            2 => panel.backward_columns::<S, 2>(simd, whole, x),
            1 => panel.backward_columns::<S, 1>(simd, whole, x),
            _ => (),
        }
        for j in (0..whole).step_by(COLUMNS).rev() {
            panel.backward_columns::<S, COLUMNS>(simd, j, x);
        }
    }
}

impl Panel<'_> {
    #[inline(always)]
    fn forward_columns<S: Simd, const N: usize>(&self, simd: S, j: usize, x: &mut [Row]) {
        let columns: [&[f64]; N] = std::array::from_fn(|k| self.column(j + k));
        let (own, x) = x[j..].split_at_mut(N);
        let mut known = [[0.0; WIDTH]; N];
        for k in 0..N {
            let pivot = simd.splat_f64s(columns[k][j + k]);
            let (taken, _) = S::as_mut_simd_f64s(&mut own[k]);
            for taken in taken {
                *taken = simd.div_f64s(*taken, pivot);
            }
            known[k] = own[k];
            for i in k + 1..N {
                take(simd, columns[k][j + i], &known[k], &mut own[i]);
            }
        }
        subtract(simd, columns.map(|column| &column[j + N..]), &known, x);
    }

    #[inline(always)]
    fn backward_columns<S: Simd, const N: usize>(&self, simd: S, j: usize, x: &mut [Row]) {
        let columns: [&[f64]; N] = std::array::from_fn(|k| self.column(j + k));
        let (own, x) = x[j..].split_at_mut(N);
        let mut sums = [[0.0; WIDTH]; N];
        multiply(simd, columns.map(|column| &column[j + N..]), x, &mut sums);
        for k in (0..N).rev() {
            let (before, solved) = own.split_at_mut(k + 1);
            let own = &mut before[k];
            take(simd, 1.0, &sums[k], own);
            for (i, solved) in solved.iter().enumerate() {
                take(simd, columns[k][j + k + 1 + i], solved, own);
            }
            let pivot = simd.splat_f64s(columns[k][j + k]);
            let (own, _) = S::as_mut_simd_f64s(own);
            for own in own {
                *own = simd.div_f64s(*own, pivot);
            }
        }
    }
}

/// `x -= entry * known`.
#[inline(always)]
fn take<S: Simd>(simd: S, entry: f64, known: &Row, x: &mut Row) {
    let entry = simd.splat_f64s(entry);
    let ((known, _), (x, _)) = (S::as_simd_f64s(known), S::as_mut_simd_f64s(x));
    for (x, known) in x.iter_mut().zip(known) {
        *x = simd.negate_mul_add_e_f64s(entry, *known, *x);
    }
}
