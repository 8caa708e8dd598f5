//! Block Lanczos with partial reorthogonalisation: the largest eigenvalues of a symmetric operator.

use faer::{Mat, MatRef, Side};

use super::loss::Loss;
use super::orthogonal::{Orthogonal, lengths, orthonormalize};
use crate::several_vectors::{Row, WIDTH};

/// The relative growth of the space between convergence tests.
const BETWEEN: f64 = 0.05;
/// The residual of an accepted eigenvector, relative to its eigenvalue. Its square is the error of the eigenvalue. A
/// reduction to vectors near the modes is as good.
const RESIDUAL: f64 = 1e-2;
/// The residual of the first one beyond those requested, of which the eigenvalue alone is used.
const BEYOND: f64 = 1e-2;
/// The relative difference of eigenvalues that may be equal.
const ALIKE: f64 = 1e-3;
/// Eigenvalues, largest first, and eigenvectors as columns.
pub(super) struct Pairs {
    pub(super) values: Vec<f64>,
    pub(super) vectors: Mat<f64>,
}

/// The number of steps without convergence.
pub(super) struct NotConverged(pub(super) usize);

/// All eigenvalues above a bound, and one beyond, of an operator on vectors of length `size`. The bound may depend on
/// the largest eigenvalue.
///
/// `apply` multiplies up to [`WIDTH`] vectors, stored one after the other. There are no restarts: two or three vectors
/// are kept per wanted one. A start finds up to `WIDTH` vectors per eigenvalue. If it finds as many, further starts
/// follow, orthogonal to all found vectors, until one finds nothing new. Multiple eigenvalues, as those of equal
/// bodies, are found with their multiplicity.
pub(super) fn largest(
    size: usize,
    bound: &dyn Fn(f64) -> f64,
    apply: &mut dyn FnMut(&[f64], &mut [f64]),
) -> Result<Pairs, NotConverged> {
    let mut pairs = krylov(size, bound, (&[], &[]), apply)?;
    let Some(&first) = pairs.values.first() else {
        return Ok(pairs);
    };
    let bound = bound(first);
    let (mut found, mut values) = (Vec::new(), Vec::new());
    let mut beyond: Option<(f64, Vec<f64>)> = None;
    loop {
        let above = pairs.values.iter().take_while(|&&value| value > bound);
        let above = above.count();
        let many = pairs.values[..above].windows(WIDTH);
        let many = many
            .filter(|alike| alike[0] - alike[WIDTH - 1] <= ALIKE * alike[0])
            .count();
        if many == 0 && values.is_empty() {
            return Ok(pairs);
        }
        for (k, &value) in pairs.values.iter().enumerate() {
            let vector = pairs.vectors.col(k).iter().copied();
            if k < above {
                found.extend(vector);
                values.push(value);
            } else if beyond.as_ref().is_none_or(|(least, _)| *least < value) {
                beyond = Some((value, vector.collect()));
            }
        }
        if many == 0 {
            break;
        }
        pairs = krylov(size, &|_| bound, (&found, &values), apply)?;
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

/// All eigenvalues and eigenvectors of a dense matrix, of which the lower triangle is read.
pub(super) fn all(matrix: MatRef<'_, f64>) -> Result<Pairs, NotConverged> {
    let size = matrix.nrows();
    let pairs = matrix.self_adjoint_eigen(Side::Lower);
    let pairs = pairs.map_err(|_| NotConverged(size))?;
    let order = |k: usize| size - 1 - k;
    Ok(Pairs {
        values: (0..size).map(|k| pairs.S()[order(k)]).collect(),
        vectors: Mat::from_fn(size, size, |i, k| pairs.U()[(i, order(k))]),
    })
}

/// The eigenvectors from one start, orthogonal to the `known` ones, by columns.
fn krylov(
    size: usize,
    bound: &dyn Fn(f64) -> f64,
    (known, eigenvalues): (&[f64], &[f64]),
    apply: &mut dyn FnMut(&[f64], &mut [f64]),
) -> Result<Pairs, NotConverged> {
    let mut basis: Vec<f64> = Vec::new();
    let mut orthogonal = Orthogonal::new(size);
    let mut projected = Projected::default();
    let count = eigenvalues.len();
    let start = (0..size * WIDTH).map(|i| share(count * size * WIDTH + i) - 0.5);
    let mut next: Vec<f64> = start.collect();
    let whole = lengths(&next, size);
    for _ in 0..2 {
        orthogonal.take_off(known, &mut next);
    }
    orthonormalize(&mut next, &whole, [known, &[]]);
    if next.is_empty() {
        return Ok(Pairs {
            values: Vec::new(),
            vectors: Mat::zeros(size, 0),
        });
    }
    let mut before = 0;
    let mut look = 0.0;
    let mut loss = Loss::new(eigenvalues.iter().copied().fold(0.0, f64::max));
    loop {
        let taken = basis.len() / size;
        if basis.try_reserve(next.len()).is_err() {
            return Err(NotConverged(taken));
        }
        basis.extend_from_slice(&next);
        let mut image = vec![0.0; next.len()];
        apply(&next, &mut image);
        // Known vectors are as near to eigenvectors as was asked for: the operator leads back to them.
        orthogonal.take_off(known, &mut image);
        let whole = lengths(&image, size);
        if !whole.iter().all(|length| length.is_finite()) {
            return Err(NotConverged(taken));
        }
        let steps = basis.len() / size;
        // The operator leads to the last two blocks alone, but it carries along what rounding has left of the others.
        let along = orthogonal.take_off(&basis[before * size..], &mut image);
        projected.add(taken, &along[taken - before..]);
        let mut beside = orthonormalize(&mut image, &whole, [known, &basis]);
        if loss.carry(&whole, &beside) {
            beside = orthogonal.take_all_off([known, &basis], &mut image) * beside;
            loss.mend();
        }
        // Nothing is left in any direction.
        let complete = image.is_empty() || steps + count >= size;
        if complete || steps as f64 >= look {
            look = (1.0 + BETWEEN) * steps as f64;
            let small = projected.matrix(steps);
            let small = small
                .self_adjoint_eigen(Side::Lower)
                .map_err(|_| NotConverged(steps))?;
            let value = |k: usize| small.S()[steps - 1 - k];
            let residual = |k: usize| {
                let last = small.U().col(steps - 1 - k).subrows(taken, steps - taken);
                (&beside * last).norm_l2()
            };
            let bound = bound(value(0));
            let wanted = (0..steps).take_while(|&k| value(k) > bound).count();
            let resolved = (0..wanted).all(|k| residual(k) <= RESIDUAL * value(k))
                && wanted < steps
                && residual(wanted) <= BEYOND * value(wanted);
            if complete || resolved {
                let kept = (wanted + 1).min(steps);
                let turn = Mat::from_fn(steps, kept, |i, k| small.U()[(i, steps - 1 - k)]);
                return Ok(Pairs {
                    values: (0..kept).map(value).collect(),
                    vectors: MatRef::from_column_major_slice(&basis, size, steps) * turn,
                });
            }
        }
        projected.add_beside(steps, taken, &beside);
        before = taken;
        next = image;
    }
}

/// The projection of the operator to the basis: the stored entries of its lower triangle.
#[derive(Default)]
struct Projected {
    entries: Vec<(usize, usize, f64)>,
}

impl Projected {
    /// Adds to the block that begins on the diagonal at `first`.
    fn add(&mut self, first: usize, block: &[Row]) {
        for (i, row) in block.iter().enumerate() {
            for (j, &value) in row[..=i].iter().enumerate() {
                self.entries.push((first + i, first + j, value));
            }
        }
    }

    /// Adds a block below that of the diagonal.
    fn add_beside(&mut self, row: usize, column: usize, block: &Mat<f64>) {
        for j in 0..block.ncols() {
            for i in 0..block.nrows() {
                self.entries.push((row + i, column + j, block[(i, j)]));
            }
        }
    }

    fn matrix(&self, size: usize) -> Mat<f64> {
        let mut matrix = Mat::zeros(size, size);
        for &(i, j, value) in &self.entries {
            matrix[(i, j)] += value;
        }
        matrix
    }
}

/// Pseudorandom numbers in `[0, 1)`, without the pattern of a mode.
fn share(i: usize) -> f64 {
    let mixed = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1_u64 << 53) as f64
}
