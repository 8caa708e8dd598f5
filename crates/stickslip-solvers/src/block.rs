//! Diagonal blocks with some components taken out.

use nalgebra::SMatrix;

#[cfg(any(feature = "multigrid", feature = "condensed"))]
use crate::energy::expect;
use crate::{Matrix, SolveError};

/// Marks a component that is not an unknown.
#[cfg(any(feature = "multigrid", feature = "condensed"))]
pub(crate) const FIXED: u32 = u32::MAX;

/// The block with the fixed rows and columns replaced by those of the identity.
pub fn decouple<const C: usize>(
    block: &SMatrix<f64, C, C>,
    fixed: &[bool; C],
) -> SMatrix<f64, C, C> {
    SMatrix::from_fn(|r, c| match (fixed[r] || fixed[c], r == c) {
        (false, _) => block[(r, c)],
        (true, diagonal) => f64::from(u8::from(diagonal)),
    })
}

/// The inverse on the free components, zero on the fixed ones; `None` unless positive definite there.
pub(crate) fn inverse<const C: usize>(
    block: &SMatrix<f64, C, C>,
    fixed: &[bool; C],
) -> Option<SMatrix<f64, C, C>> {
    let mut free = (0..C).filter(|&c| !fixed[c]);
    if let (Some(only), None) = (free.next(), free.next()) {
        let entry = block[(only, only)];
        let mut inverse = SMatrix::zeros();
        inverse[(only, only)] = entry.recip();
        return (entry > 0.0).then_some(inverse);
    }
    let mut inverse = decouple(block, fixed).cholesky()?.inverse();
    for c in (0..C).filter(|&c| fixed[c]) {
        inverse[(c, c)] = 0.0;
    }
    Some(inverse)
}

/// Whether a block that is positive definite, with its fixed components [decoupled](decouple), stays so with a number added on
/// the diagonal of the free ones.
#[cfg(feature = "sparse")]
pub(crate) fn is_definite_with<const C: usize>(
    added: f64,
    block: &SMatrix<f64, C, C>,
    fixed: &[bool; C],
) -> bool {
    let free = |r: usize, c: usize| r == c && !fixed[r];
    let sum =
        SMatrix::<f64, C, C>::from_fn(|r, c| block[(r, c)] + if free(r, c) { added } else { 0.0 });
    added >= 0.0 || sum.cholesky().is_some()
}

/// The inverse of the diagonal block of a vertex on its free components, zero on the fixed ones.
///
/// # Errors
/// [`SolveError::IndefiniteBlock`] unless the block is positive definite there.
pub(crate) fn inverse_at<M: Matrix<C> + ?Sized, const C: usize>(
    operator: &M,
    fixed: &[[bool; C]],
    vertex: usize,
) -> Result<SMatrix<f64, C, C>, SolveError> {
    inverse(&operator.diagonal_block(vertex), &fixed[vertex])
        .ok_or(SolveError::IndefiniteBlock { vertex })
}

/// Computes the inverses of all diagonal blocks.
///
/// # Errors
/// [`SolveError::IndefiniteBlock`].
pub(crate) fn invert_all<M: Matrix<C> + ?Sized, const C: usize>(
    operator: &M,
    fixed: &[[bool; C]],
    inverses: &mut Vec<SMatrix<f64, C, C>>,
) -> Result<(), SolveError> {
    inverses.clear();
    inverses.reserve_exact(fixed.len());
    for vertex in 0..fixed.len() {
        inverses.push(inverse_at(operator, fixed, vertex)?);
    }
    Ok(())
}

/// Checks that an operator has as many vertices as there are masks, and diagonal blocks that are positive
/// definite on the free components.
///
/// # Errors
/// [`SolveError::SizeMismatch`], [`SolveError::IndefiniteBlock`].
#[cfg(any(feature = "multigrid", feature = "condensed"))]
pub(crate) fn check_blocks<M: Matrix<C> + ?Sized, const C: usize>(
    operator: &M,
    fixed: &[[bool; C]],
) -> Result<(), SolveError> {
    expect([(operator.vertex_count(), fixed.len())])?;
    (0..fixed.len()).try_for_each(|vertex| inverse_at(operator, fixed, vertex).map(drop))
}

/// The block with the masked rows and columns set to zero.
#[cfg(feature = "multigrid")]
#[inline]
pub(crate) fn without<const C: usize>(
    block: &SMatrix<f64, C, C>,
    rows: &[bool; C],
    columns: &[bool; C],
) -> SMatrix<f64, C, C> {
    SMatrix::from_fn(|r, c| {
        if rows[r] || columns[c] {
            0.0
        } else {
            block[(r, c)]
        }
    })
}
