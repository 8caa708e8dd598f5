//! Lanczos' method with complete orthogonalisation: the largest eigenvalues of a symmetric operator.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};

/// Steps between looks at what has converged.
const BETWEEN: usize = 10;
/// The residual of an eigenvector that is taken, relative to its eigenvalue. Its square is the error of that; and a
/// body is as well reduced to vectors near the modes.
const RESIDUAL: f64 = 1e-5;
/// What of an image may be along vectors that it is orthogonal to but for rounding.
const STRANGE: f64 = 1e-12;
/// That of the first one beyond those asked for, whose eigenvalue alone is used.
const BEYOND: f64 = 1e-3;

/// Eigenvalues, largest first, and eigenvectors as columns.
pub(super) struct Pairs {
    pub(super) values: Vec<f64>,
    pub(super) vectors: Mat<f64>,
}

/// The steps that did not do.
pub(super) struct NotConverged(pub(super) usize);

/// All eigenvalues above `bound`, and one beyond, of an operator on vectors of length `size`.
///
/// No restarts: some two vectors are kept for each that is wanted. Of an eigenvalue that is exactly multiple, rounding
/// alone finds the second vector.
pub(super) fn largest(
    size: usize,
    bound: f64,
    mut apply: impl FnMut(&[f64], &mut [f64]),
) -> Result<Pairs, NotConverged> {
    let mut basis: Vec<f64> = Vec::new();
    let (mut diagonal, mut beside) = (Vec::<f64>::new(), Vec::<f64>::new());
    let mut next: Vec<f64> = (0..size).map(|i| 0.5 + share(i)).collect();
    let mut image = vec![0.0; size];
    let mut length = norm(&next);
    loop {
        let taken = diagonal.len();
        next.iter_mut().for_each(|x| *x /= length);
        if basis.try_reserve(size).is_err() {
            return Err(NotConverged(taken));
        }
        basis.extend_from_slice(&next);
        apply(&next, &mut image);
        let whole = norm(&image);
        // Against all vectors, and once more where more than the last two are in it: rounding makes of a difference what
        // is to be taken off again.
        let vectors = MatRef::from_column_major_slice(&basis, size, taken + 1);
        let mut own = 0.0;
        for _ in 0..2 {
            let mut along = vec![0.0; taken + 1];
            let into = MatMut::from_column_major_slice_mut(&mut along, taken + 1, 1);
            let of = MatRef::from_column_major_slice(&image, size, 1);
            matmul(into, Accum::Replace, vectors.transpose(), of, 1.0, Par::Seq);
            own += along[taken];
            let along = MatRef::from_column_major_slice(&along, taken + 1, 1);
            let into = MatMut::from_column_major_slice_mut(&mut image, size, 1);
            matmul(into, Accum::Add, vectors, along, -1.0, Par::Seq);
            let others = taken.saturating_sub(1);
            let strange = (0..others).map(|k| along[(k, 0)].abs()).fold(0.0, f64::max);
            if strange <= STRANGE * whole {
                break;
            }
        }
        diagonal.push(own);
        length = norm(&image);
        let count = taken + 1;
        // Nothing is left in any direction.
        let complete = count == size || length <= 1e-14 * whole;
        if complete || count % BETWEEN == 0 {
            let small = Mat::from_fn(count, count, |i, j| match i.abs_diff(j) {
                0 => diagonal[i],
                1 => beside[i.min(j)],
                _ => 0.0,
            });
            let small = small
                .self_adjoint_eigen(Side::Lower)
                .map_err(|_| NotConverged(count))?;
            let value = |k: usize| small.S()[count - 1 - k];
            let residual = |k: usize| length * small.U()[(count - 1, count - 1 - k)].abs();
            let wanted = (0..count).take_while(|&k| value(k) > bound).count();
            let known = (0..wanted).all(|k| residual(k) <= RESIDUAL * value(k))
                && wanted < count
                && residual(wanted) <= BEYOND * value(wanted);
            if complete || known {
                let kept = (wanted + 1).min(count);
                let turn = Mat::from_fn(count, kept, |i, k| small.U()[(i, count - 1 - k)]);
                return Ok(Pairs {
                    values: (0..kept).map(value).collect(),
                    vectors: vectors * turn,
                });
            }
        }
        beside.push(length);
        std::mem::swap(&mut next, &mut image);
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Numbers in `[0, 1)` without a pattern that a mode could have.
fn share(i: usize) -> f64 {
    let mixed = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1_u64 << 53) as f64
}
