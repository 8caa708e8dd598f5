//! Orthogonalisation of vectors.

use faer::Mat;
use pulp::{Arch, Simd, WithSimd};

use crate::several_vectors::{Row, WIDTH, lay, multiply, stack, subtract};
use crate::simd;

/// The relative remainder of a vector that rounding alone may leave.
const NOTHING: f64 = 1e-14;
/// The relative remainder whose direction rounding may have changed.
const LITTLE: f64 = 1e-3;

/// The largest component that is subtracted from a vector of length one in a single pass: its square remains.
const STRANGE: f64 = 1e-8;

/// Makes vectors, stored one after the other, orthonormal. Their lengths were `whole` before they were made orthogonal
/// to those of `others`. Drops dependent vectors, and returns the matrix from the rest back to the originals.
pub(super) fn orthonormalize(x: &mut Vec<f64>, whole: &[f64], others: [&[f64]; 2]) -> Mat<f64> {
    let (count, size) = (whole.len(), x.len() / whole.len());
    let mut back = Mat::zeros(count, count);
    let mut kept = 0;
    for c in 0..count {
        x.copy_within(c * size..(c + 1) * size, kept * size);
        let (before, rest) = x.split_at_mut(kept * size);
        let own = &mut rest[..size];
        for _ in 0..2 {
            for (i, before) in before.chunks_exact(size).enumerate() {
                back[(i, c)] += take_one_off(before, own);
            }
        }
        let mut length = norm(own);
        if length <= NOTHING * whole[c] {
            continue;
        }
        own.iter_mut().for_each(|x| *x /= length);
        if length <= LITTLE * whole[c] {
            for other in others.into_iter().chain([&*before]) {
                for other in other.chunks_exact(size) {
                    take_one_off(other, own);
                }
            }
            // Of rounding nearly nothing is left then.
            let left = norm(own);
            if left < 0.5 {
                continue;
            }
            own.iter_mut().for_each(|x| *x /= left);
            length *= left;
        }
        back[(kept, c)] = length;
        kept += 1;
    }
    x.truncate(kept * size);
    back.subrows(0, kept).to_owned()
}

/// Subtracts the component along a vector of length one from another vector, and returns it.
fn take_one_off(vector: &[f64], from: &mut [f64]) -> f64 {
    Arch::new().dispatch(TakeOneOff { vector, from })
}

struct TakeOneOff<'a> {
    vector: &'a [f64],
    from: &'a mut [f64],
}

impl WithSimd for TakeOneOff<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let along = simd::product(simd, self.vector, self.from);
        simd::subtract(simd, [self.vector], [along], self.from);
        along
    }
}

/// Subtracts the components along orthonormal vectors from others.
pub(super) struct Orthogonal {
    rows: Vec<Row>,
}

impl Orthogonal {
    /// For vectors of this length.
    pub(super) fn new(size: usize) -> Self {
        Self {
            rows: vec![[0.0; WIDTH]; size],
        }
    }

    /// Makes orthonormal vectors orthogonal to those of `others`, too; returns the matrix from the rest back to the
    /// originals.
    pub(super) fn take_all_off(&mut self, others: [&[f64]; 2], from: &mut Vec<f64>) -> Mat<f64> {
        let size = self.rows.len();
        let count = from.len() / size;
        let mut back = Mat::identity(count, count);
        for _ in 0..2 {
            if from.is_empty() {
                break;
            }
            let along = others.map(|others| self.take_off(others, from));
            let whole = vec![1.0; from.len() / size];
            back = orthonormalize(from, &whole, others) * back;
            let along = along.iter().flatten().flatten();
            if along.fold(0.0, |most: f64, along| most.max(along.abs())) <= STRANGE {
                break;
            }
        }
        back
    }

    /// `from -= Q (Q^T from)`, vectors stored one after the other; returns `Q^T from` by rows.
    pub(super) fn take_off(&mut self, vectors: &[f64], from: &mut [f64]) -> Vec<Row> {
        let size = self.rows.len();
        let mut along = vec![[0.0; WIDTH]; vectors.len() / size];
        if along.is_empty() {
            return along;
        }
        lay(from.chunks_exact(size), &mut self.rows);
        Arch::new().dispatch(TakeOff {
            vectors,
            rows: &mut self.rows,
            along: &mut along,
        });
        stack(&self.rows, size, from);
        along
    }
}

/// Vectors per pass.
const TOGETHER: usize = 4;
/// Rows that stay in the fastest cache while the parts of all vectors on them pass.
const ROWS: usize = 256;

struct TakeOff<'a> {
    vectors: &'a [f64],
    rows: &'a mut [Row],
    along: &'a mut [Row],
}

impl WithSimd for TakeOff<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            vectors,
            rows,
            along,
        } = self;
        let size = rows.len();
        for first in (0..size).step_by(ROWS) {
            let rows = &rows[first..size.min(first + ROWS)];
            let part = |k: usize| &vectors[k * size + first..][..rows.len()];
            let (fours, ones) = along.as_chunks_mut::<TOGETHER>();
            let whole = TOGETHER * fours.len();
            for (k, sums) in fours.iter_mut().enumerate() {
                let columns = std::array::from_fn(|i| part(TOGETHER * k + i));
                multiply(simd, columns, rows, sums);
            }
            for (k, sums) in ones.iter_mut().enumerate() {
                multiply(simd, [part(whole + k)], rows, std::array::from_mut(sums));
            }
        }
        for first in (0..size).step_by(ROWS) {
            let rows = &mut rows[first..size.min(first + ROWS)];
            let count = rows.len();
            let part = |k: usize| &vectors[k * size + first..][..count];
            let (fours, ones) = along.as_chunks::<TOGETHER>();
            let whole = TOGETHER * fours.len();
            for (k, known) in fours.iter().enumerate() {
                let columns = std::array::from_fn(|i| part(TOGETHER * k + i));
                subtract(simd, columns, known, rows);
            }
            for (k, known) in ones.iter().enumerate() {
                subtract(simd, [part(whole + k)], std::array::from_ref(known), rows);
            }
        }
    }
}

/// The lengths of vectors stored one after the other.
pub(super) fn lengths(x: &[f64], size: usize) -> Vec<f64> {
    x.chunks_exact(size).map(norm).collect()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
