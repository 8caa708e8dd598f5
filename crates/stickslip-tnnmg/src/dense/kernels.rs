//! Passes over a dense symmetric matrix by columns, in the widest registers there are.

use pulp::{Arch, Simd, WithSimd};

use crate::field::dots;

/// Sums that run side by side in a product of two columns.
const LANES: usize = 8;
/// Columns that one pass over a vector takes together.
const WIDTH: usize = 4;

/// `y -= S x`, from the triangle on and below the diagonal.
pub(super) fn subtract_product(matrix: &[f64], x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(SubtractProduct { matrix, x, y });
}

/// `y -= column * x`.
pub(super) fn subtract(column: &[f64], x: f64, y: &mut [f64]) {
    Arch::new().dispatch(Subtract { column, x, y });
}

/// `x . y`.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    Arch::new().dispatch(Dot { x, y })
}

/// `x . S x`, from the triangle on and below the diagonal.
pub(super) fn quadratic(matrix: &[f64], x: &[f64]) -> f64 {
    Arch::new().dispatch(Quadratic { matrix, x })
}

struct Quadratic<'a> {
    matrix: &'a [f64],
    x: &'a [f64],
}

impl WithSimd for Quadratic<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let Self { matrix, x } = self;
        let mut square = 0.0;
        for (j, column) in matrix.chunks_exact(x.len().max(1)).enumerate() {
            let [below] = dots::<LANES, 1>([&column[j + 1..]], &x[j + 1..]);
            square += x[j] * (2.0 * below + column[j] * x[j]);
        }
        square
    }
}

struct Subtract<'a> {
    column: &'a [f64],
    x: f64,
    y: &'a mut [f64],
}

impl WithSimd for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (y, entry) in self.y.iter_mut().zip(self.column) {
            *y -= entry * self.x;
        }
    }
}

struct Dot<'a> {
    x: &'a [f64],
    y: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let [sum] = dots::<LANES, 1>([self.x], self.y);
        sum
    }
}

struct SubtractProduct<'a> {
    matrix: &'a [f64],
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for SubtractProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix, x, y } = self;
        let count = x.len();
        let mut j = 0;
        while j + WIDTH <= count {
            let column = |k: usize| &matrix[(j + k) * count..][..count];
            // The block on the diagonal.
            for k in 0..WIDTH {
                for i in 0..WIDTH {
                    y[j + i] -= column(k)[j + i] * x[j + k];
                }
            }
            let below: [&[f64]; WIDTH] = std::array::from_fn(|k| &column(k)[j + WIDTH..]);
            let known: [f64; WIDTH] = std::array::from_fn(|k| x[j + k]);
            let (upper, lower) = y.split_at_mut(j + WIDTH);
            let sums = pass(below, known, &x[j + WIDTH..], lower);
            for k in 0..WIDTH {
                upper[j + k] -= sums[k];
            }
            j += WIDTH;
        }
        for j in j..count {
            let column = &matrix[j * count..][..count];
            for i in j..count {
                y[i] -= column[i] * x[j];
                if i > j {
                    y[j] -= column[i] * x[i];
                }
            }
        }
    }
}

/// `y -= columns * known`, and the products of the columns with `x`.
#[inline(always)]
fn pass(columns: [&[f64]; WIDTH], known: [f64; WIDTH], x: &[f64], y: &mut [f64]) -> [f64; WIDTH] {
    let mut sums = [[0.0; LANES]; WIDTH];
    let whole = x.len() - x.len() % LANES;
    let [a, b, c, d] = columns.map(|column| &column[..x.len()]);
    let y = &mut y[..x.len()];
    for i in (0..whole).step_by(LANES) {
        for l in 0..LANES {
            let (i, l) = (i + l, l);
            y[i] -= (a[i] * known[0] + b[i] * known[1]) + (c[i] * known[2] + d[i] * known[3]);
            sums[0][l] += a[i] * x[i];
            sums[1][l] += b[i] * x[i];
            sums[2][l] += c[i] * x[i];
            sums[3][l] += d[i] * x[i];
        }
    }
    for i in whole..x.len() {
        y[i] -= (a[i] * known[0] + b[i] * known[1]) + (c[i] * known[2] + d[i] * known[3]);
        for (sums, column) in sums.iter_mut().zip(columns) {
            sums[0] += column[i] * x[i];
        }
    }
    sums.map(|sums| sums.iter().sum())
}
