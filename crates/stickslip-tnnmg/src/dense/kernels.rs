//! Passes over a dense symmetric matrix by columns, in the widest registers there are.

use pulp::{Arch, Simd, WithSimd};

use crate::wide;

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
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { matrix, x } = self;
        let mut square = 0.0;
        for (j, column) in matrix.chunks_exact(x.len().max(1)).enumerate() {
            let below = wide::product(simd, &column[j + 1..], &x[j + 1..]);
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
    fn with_simd<S: Simd>(self, simd: S) {
        wide::subtract(simd, [self.column], [self.x], self.y);
    }
}

struct Dot<'a> {
    x: &'a [f64],
    y: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        wide::product(simd, self.x, self.y)
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
    fn with_simd<S: Simd>(self, simd: S) {
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
            let sums = pass(simd, below, known, &x[j + WIDTH..], lower);
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
fn pass<S: Simd>(
    simd: S,
    columns: [&[f64]; WIDTH],
    known: [f64; WIDTH],
    x: &[f64],
    y: &mut [f64],
) -> [f64; WIDTH] {
    let count = x.len();
    let (ys, y) = S::as_mut_simd_f64s(&mut y[..count]);
    let (xs, x) = S::as_simd_f64s(x);
    let parts = columns.map(|column| S::as_simd_f64s(&column[..count]));
    let [a, b, c, d] = parts.map(|(whole, _)| whole);
    let mut factors = [simd.splat_f64s(0.0); WIDTH];
    for k in 0..WIDTH {
        factors[k] = simd.splat_f64s(known[k]);
    }
    let mut sums = [simd.splat_f64s(0.0); WIDTH];
    for (((((y, x), a), b), c), d) in ys.iter_mut().zip(xs).zip(a).zip(b).zip(c).zip(d) {
        let entries = [*a, *b, *c, *d];
        let mut left = *y;
        for k in 0..WIDTH {
            left = simd.negate_mul_add_e_f64s(entries[k], factors[k], left);
            sums[k] = simd.mul_add_e_f64s(entries[k], *x, sums[k]);
        }
        *y = left;
    }
    // A closure would not be compiled for the wide registers.
    let mut products = [0.0; WIDTH];
    for k in 0..WIDTH {
        products[k] = simd.reduce_sum_f64s(sums[k]);
        for ((y, x), entry) in y.iter_mut().zip(x).zip(parts[k].1) {
            *y -= entry * known[k];
            products[k] += entry * x;
        }
    }
    products
}
