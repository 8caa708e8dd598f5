//! The method of Levenberg and Marquardt for a few parameters.

use nalgebra::{SMatrix, SVector};

/// The damping at the start, relative to the diagonal of the normal equations.
const DAMPING: f64 = 1e-3;
/// The factor on the damping after a successful step; after an unsuccessful one the damping grows by its inverse.
const RELIEF: f64 = 0.1;
const RAISE: f64 = 10.0;
/// The largest distance to the minimum of the linear model at convergence.
const NEAR: f64 = 1e-8;
/// The largest relative offset at convergence: the distance to the minimum of the linear model over the radius of its
/// confidence region, by the rule of Bates and Watts.
const OFFSET: f64 = 1e-3;
/// The maximum number of steps, successful or not.
const MAX_STEPS: usize = 100;

/// A minimum of the sum of squares.
pub(super) struct Minimum<const P: usize> {
    pub(super) parameters: SVector<f64, P>,
    /// The sum of the squares of the residuals there.
    pub(super) squares: f64,
    /// The inverse of `J^T J`.
    pub(super) inverse: SMatrix<f64, P, P>,
    /// The number of attempted steps.
    pub(super) steps: usize,
}

/// The cause of a failed minimisation.
pub(super) enum Stuck<E> {
    /// The residuals at the start, or their derivatives, cannot be computed.
    Model(E),
    /// The residuals do not depend on some combination of the parameters.
    Singular,
    /// The iteration did not converge; with the remaining distance to the minimum.
    NotConverged { steps: usize, distance: f64 },
}

/// Minimises the sum of the squares of `residuals(p)`; `derivatives` are their columns by each parameter.
///
/// A step solves `(J^T J + lambda diag(J^T J)) d = -J^T r`, and `lambda` falls after successful steps. A step to
/// parameters without residuals is unsuccessful. The iteration ends where the step `d` with `lambda = 0` is below 1e-8 in
/// every parameter, or a thousandth of the standard errors: with `N` residuals `r` and `P` parameters,
/// `|J d|^2/P <= 1e-6 |r|^2/(N - P)`. Sources: D. Marquardt, "An algorithm for least-squares estimation of nonlinear
/// parameters", J. SIAM 11 (1963); D. Bates, D. Watts, "A relative offset orthogonality convergence criterion for
/// nonlinear least squares", Technometrics 23 (1981).
pub(super) fn minimize<const P: usize, E>(
    start: SVector<f64, P>,
    residuals: impl Fn(&SVector<f64, P>) -> Result<Vec<f64>, E>,
    derivatives: impl Fn(&SVector<f64, P>) -> Result<[Vec<f64>; P], E>,
) -> Result<Minimum<P>, Stuck<E>> {
    let dot = |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| x * y).sum() };
    let linearised = |parameters: &SVector<f64, P>, residual: &[f64]| {
        let columns = derivatives(parameters).map_err(Stuck::Model)?;
        let normal = SMatrix::<f64, P, P>::from_fn(|i, j| dot(&columns[i], &columns[j]));
        let slope = SVector::<f64, P>::from_fn(|i, _| dot(&columns[i], residual));
        let inverse = normal.cholesky().ok_or(Stuck::Singular)?.inverse();
        Ok((normal, slope, inverse))
    };
    let mut parameters = start;
    let mut residual = residuals(&parameters).map_err(Stuck::Model)?;
    let (mut normal, mut slope, mut inverse) = linearised(&parameters, &residual)?;
    let mut damping = DAMPING;
    for steps in 0..MAX_STEPS {
        let squares = dot(&residual, &residual);
        // `|J d|^2` of the step.
        let moved = slope.dot(&(inverse * slope)) / P as f64;
        let variance = squares / (residual.len() - P) as f64;
        if (inverse * slope).amax() <= NEAR || moved <= OFFSET * OFFSET * variance {
            return Ok(Minimum {
                parameters,
                squares,
                inverse,
                steps,
            });
        }
        let damped = normal + SMatrix::from_diagonal(&(normal.diagonal() * damping));
        let to = parameters - damped.cholesky().ok_or(Stuck::Singular)?.solve(&slope);
        match residuals(&to) {
            Ok(trial) if dot(&trial, &trial) < squares => {
                (parameters, residual) = (to, trial);
                (normal, slope, inverse) = linearised(&parameters, &residual)?;
                damping *= RELIEF;
            }
            _ => damping *= RAISE,
        }
    }
    Err(Stuck::NotConverged {
        steps: MAX_STEPS,
        distance: (inverse * slope).amax(),
    })
}
