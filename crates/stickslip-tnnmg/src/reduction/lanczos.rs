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
/// No restarts: some two vectors are kept for each that is wanted. A start leads to one vector of each eigenvalue alone,
/// so that others follow, orthogonal to all that is found, until one leads to nothing new: multiple eigenvalues, as those
/// of equal bodies, are found as often as they are there.
pub(super) fn largest(
    size: usize,
    bound: f64,
    mut apply: impl FnMut(&[f64], &mut [f64]),
) -> Result<Pairs, NotConverged> {
    let (mut found, mut values) = (Vec::new(), Vec::new());
    let mut beyond: Option<(f64, Vec<f64>)> = None;
    loop {
        let pairs = krylov(size, bound, &found, values.len(), &mut apply)?;
        let above = pairs.values.iter().take_while(|&&value| value > bound);
        let above = above.count();
        for (k, &value) in pairs.values.iter().enumerate() {
            let vector = pairs.vectors.col(k).iter().copied();
            if k < above {
                found.extend(vector);
                values.push(value);
            } else if beyond.as_ref().is_none_or(|(least, _)| *least < value) {
                beyond = Some((value, vector.collect()));
            }
        }
        if above == 0 {
            break;
        }
    }
    if let Some((value, vector)) = beyond {
        found.extend(vector);
        values.push(value);
    }
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    Ok(Pairs {
        values: order.iter().map(|&k| values[k]).collect(),
        vectors: Mat::from_fn(size, order.len(), |i, k| found[order[k] * size + i]),
    })
}

/// What one start finds that is orthogonal to the `known` vectors, `count` of them by columns.
fn krylov(
    size: usize,
    bound: f64,
    known: &[f64],
    count: usize,
    apply: &mut impl FnMut(&[f64], &mut [f64]),
) -> Result<Pairs, NotConverged> {
    let known = MatRef::from_column_major_slice(known, size, count);
    let mut basis: Vec<f64> = Vec::new();
    let (mut diagonal, mut beside) = (Vec::<f64>::new(), Vec::<f64>::new());
    let mut next: Vec<f64> = (0..size).map(|i| 0.5 + share(count * size + i)).collect();
    let mut image = vec![0.0; size];
    let whole = norm(&next);
    for _ in 0..2 {
        take_off(known, &mut next);
    }
    let mut length = norm(&next);
    if length <= 1e-14 * whole {
        return Ok(Pairs {
            values: Vec::new(),
            vectors: Mat::zeros(size, 0),
        });
    }
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
            let others = take_off(known, &mut image);
            let along = take_off(vectors, &mut image);
            own += along[taken];
            let strange = others.iter().chain(&along[..taken.saturating_sub(1)]);
            let strange = strange.map(|x| x.abs()).fold(0.0, f64::max);
            if strange <= STRANGE * whole {
                break;
            }
        }
        diagonal.push(own);
        length = norm(&image);
        let steps = taken + 1;
        // Nothing is left in any direction.
        let complete = steps + count == size || length <= 1e-14 * whole;
        if complete || steps % BETWEEN == 0 {
            let small = Mat::from_fn(steps, steps, |i, j| match i.abs_diff(j) {
                0 => diagonal[i],
                1 => beside[i.min(j)],
                _ => 0.0,
            });
            let small = small
                .self_adjoint_eigen(Side::Lower)
                .map_err(|_| NotConverged(steps))?;
            let value = |k: usize| small.S()[steps - 1 - k];
            let residual = |k: usize| length * small.U()[(steps - 1, steps - 1 - k)].abs();
            let wanted = (0..steps).take_while(|&k| value(k) > bound).count();
            let resolved = (0..wanted).all(|k| residual(k) <= RESIDUAL * value(k))
                && wanted < steps
                && residual(wanted) <= BEYOND * value(wanted);
            if complete || resolved {
                let kept = (wanted + 1).min(steps);
                let turn = Mat::from_fn(steps, kept, |i, k| small.U()[(i, steps - 1 - k)]);
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

/// Takes the parts along orthonormal columns off a vector, and returns them.
fn take_off(columns: MatRef<'_, f64>, from: &mut [f64]) -> Vec<f64> {
    let (size, count) = (from.len(), columns.ncols());
    let mut along = vec![0.0; count];
    if count > 0 {
        let into = MatMut::from_column_major_slice_mut(&mut along, count, 1);
        let of = MatRef::from_column_major_slice(from, size, 1);
        matmul(into, Accum::Replace, columns.transpose(), of, 1.0, Par::Seq);
        let weights = MatRef::from_column_major_slice(&along, count, 1);
        let from = MatMut::from_column_major_slice_mut(from, size, 1);
        matmul(from, Accum::Add, columns, weights, -1.0, Par::Seq);
    }
    along
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
