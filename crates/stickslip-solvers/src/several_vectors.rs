//! Passes over columns for [`WIDTH`] right-hand sides at once, stored row by row.

use pulp::Simd;

/// The number of right-hand sides.
pub(crate) const WIDTH: usize = 8;

/// A row: one number per right-hand side.
pub(crate) type Row = [f64; WIDTH];

/// Rows that stay in the fastest cache while the numbers of all vectors are copied into them.
const ROWS: usize = 64;

/// Stores vectors row by row, with zeros for missing ones.
pub(crate) fn lay<'a>(vectors: impl IntoIterator<Item = &'a [f64]>, rows: &mut [Row]) {
    let mut abreast: [&[f64]; WIDTH] = [&[]; WIDTH];
    for (place, vector) in abreast.iter_mut().zip(vectors) {
        *place = vector;
    }
    for (k, rows) in rows.chunks_mut(ROWS).enumerate() {
        for (c, vector) in abreast.iter().enumerate() {
            let part = vector.get(k * ROWS..).unwrap_or(&[]);
            let (there, absent) = rows.split_at_mut(rows.len().min(part.len()));
            for (row, value) in there.iter_mut().zip(part) {
                row[c] = *value;
            }
            absent.iter_mut().for_each(|row| row[c] = 0.0);
        }
    }
}

/// Stores them one after the other again.
pub(crate) fn stack(rows: &[Row], size: usize, vectors: &mut [f64]) {
    for (k, rows) in rows[..size].chunks(ROWS).enumerate() {
        for (c, vector) in vectors.chunks_exact_mut(size).enumerate() {
            for (row, value) in rows.iter().zip(&mut vector[k * ROWS..]) {
                *value = row[c];
            }
        }
    }
}

// Loops, not closures: these would not be compiled for the wide registers.

/// `x -= columns * known`.
#[inline(always)]
pub(crate) fn subtract<S: Simd, const N: usize>(
    simd: S,
    columns: [&[f64]; N],
    known: &[Row; N],
    x: &mut [Row],
) {
    let registers = WIDTH / S::F64_LANES;
    let mut factors = [[simd.splat_f64s(0.0); WIDTH]; N];
    for k in 0..N {
        let (known, _) = S::as_simd_f64s(&known[k]);
        factors[k][..registers].copy_from_slice(&known[..registers]);
    }
    let columns = columns.map(|column| &column[..x.len()]);
    for (i, x) in x.iter_mut().enumerate() {
        let (x, _) = S::as_mut_simd_f64s(x);
        for r in 0..registers {
            let mut left = x[r];
            for k in 0..N {
                let entry = simd.splat_f64s(columns[k][i]);
                left = simd.negate_mul_add_e_f64s(entry, factors[k][r], left);
            }
            x[r] = left;
        }
    }
}

/// `sum of values * x[places]`.
#[inline(always)]
pub(crate) fn combine<S: Simd>(simd: S, values: &[f64], places: &[u32], x: &[Row]) -> Row {
    let registers = WIDTH / S::F64_LANES;
    let mut totals = [simd.splat_f64s(0.0); WIDTH];
    for (value, &place) in values.iter().zip(places) {
        let entry = simd.splat_f64s(*value);
        let (x, _) = S::as_simd_f64s(&x[place as usize]);
        for r in 0..registers {
            totals[r] = simd.mul_add_e_f64s(entry, x[r], totals[r]);
        }
    }
    let mut sums = [0.0; WIDTH];
    let (into, _) = S::as_mut_simd_f64s(&mut sums);
    into.copy_from_slice(&totals[..registers]);
    sums
}

/// Products of the columns with each of the vectors, added to `sums`.
#[inline(always)]
pub(crate) fn multiply<S: Simd, const N: usize>(
    simd: S,
    columns: [&[f64]; N],
    x: &[Row],
    sums: &mut [Row; N],
) {
    let registers = WIDTH / S::F64_LANES;
    let mut totals = [[simd.splat_f64s(0.0); WIDTH]; N];
    let columns = columns.map(|column| &column[..x.len()]);
    for (i, x) in x.iter().enumerate() {
        let (x, _) = S::as_simd_f64s(x);
        for r in 0..registers {
            for k in 0..N {
                let entry = simd.splat_f64s(columns[k][i]);
                totals[k][r] = simd.mul_add_e_f64s(entry, x[r], totals[k][r]);
            }
        }
    }
    for k in 0..N {
        let (sums, _) = S::as_mut_simd_f64s(&mut sums[k]);
        for r in 0..registers {
            sums[r] = simd.add_f64s(sums[r], totals[k][r]);
        }
    }
}
