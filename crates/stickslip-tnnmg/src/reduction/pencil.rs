//! Vibrations of a dense stiffness and mass.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, MatRef, Par, Side};

use crate::SolveError;

/// The vibrations of small dense matrices, by columns, lowest first: angular frequencies [rad/s], and amplitudes with
/// `x . M x = 1`. Directions in which rounding alone makes the mass positive are to be left out before.
///
/// # Errors
/// [`SolveError::IndefiniteOperator`] for a mass that is not positive definite.
pub fn vibrations(
    stiffness: &[f64],
    mass: &[f64],
) -> Result<(Vec<f64>, Vec<Vec<f64>>), SolveError> {
    let size = mass.len().isqrt();
    crate::energy::expect([(size * size, mass.len()), (size * size, stiffness.len())])?;
    let failure = |pivot| SolveError::IndefiniteOperator {
        pivot,
        unknowns: size,
        vertex: pivot,
    };
    let factor = MatRef::from_column_major_slice(mass, size, size)
        .llt(Side::Lower)
        .map_err(|_| failure(0))?;
    let lower = factor.L();
    // L^-1 A L^-T
    let mut inner = Mat::from_fn(size, size, |i, j| stiffness[j * size + i]);
    solve_lower_triangular_in_place(lower, inner.as_mut(), Par::Seq);
    let mut inner = inner.transpose().to_owned();
    solve_lower_triangular_in_place(lower, inner.as_mut(), Par::Seq);
    let pairs = inner
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| failure(size))?;
    let mut shapes = pairs.U().to_owned();
    solve_upper_triangular_in_place(lower.transpose(), shapes.as_mut(), Par::Seq);
    let frequencies = (0..size).map(|k| pairs.S()[k].max(0.0).sqrt()).collect();
    let shapes = (0..size).map(|k| shapes.col(k).iter().copied().collect());
    Ok((frequencies, shapes.collect()))
}
