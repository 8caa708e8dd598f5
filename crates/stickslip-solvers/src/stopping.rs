//! The stopping criterion of a minimiser, and the cost of a solution.

#[cfg(feature = "condensed")]
use nalgebra::SVector;

/// Stopping criterion: the estimated error is at most `tolerance`, or at most `relative` times the larger of the start
/// and of any change.
///
/// Both are measured as `sqrt(d . N d)`, with a matrix `N` of the caller's choice.
#[derive(Debug)]
pub struct Stopping<'a, Op> {
    /// `N`, symmetric and positive definite on the free components.
    pub norm: &'a Op,
    /// The accepted distance, in units of the norm; positive.
    pub tolerance: f64,
    /// The accepted distance relative to the norm of the start, or of a change if that is larger; about `1e-14` avoids
    /// waiting for a tolerance below the rounding errors.
    pub relative: f64,
    /// A number for which `d . N d <= equivalence d . B d` holds, `B` the energy's operator; infinity if unknown. With
    /// it a solver may stop on its own estimate of the error, without a further iteration that confirms it.
    pub equivalence: f64,
    /// The largest number of iterations before [`SolveError::NotConverged`](crate::SolveError::NotConverged). Stall detection may stop earlier.
    pub max_iterations: usize,
}

impl<'a, Op> Stopping<'a, Op> {
    /// A stopping criterion for an error of `tolerance` in the norm of the energy's own operator.
    pub fn in_energy_norm(operator: &'a Op, tolerance: f64) -> Self {
        Self {
            norm: operator,
            tolerance,
            relative: 1e-14,
            equivalence: 1.0,
            max_iterations: 100_000,
        }
    }

    /// The accepted distance from the start `v`. A relative tolerance near the rounding errors is left to these: the
    /// norm of the start would cost a pass over the whole norm matrix.
    #[cfg(feature = "condensed")]
    pub(crate) fn at<const C: usize>(&self, v: &[SVector<f64, C>]) -> f64
    where
        Op: crate::Matrix<C>,
    {
        const ROUNDING: f64 = 1e-12;
        let relative = if self.relative > ROUNDING {
            self.relative * self.norm.norm(v)
        } else {
            0.0
        };
        self.tolerance.max(relative)
    }
}

/// The cost of one call of [`NonsmoothSolver::minimize`](crate::NonsmoothSolver::minimize).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveReport {
    /// The number of nonlinear iterations: sweeps over all vertices, each exact at a vertex.
    pub iterations: usize,
    /// The number of linear multigrid cycles within them; 0 for solvers without any.
    pub cycles: usize,
    /// The estimated distance to the minimiser in the stopping norm.
    pub error: f64,
}

impl SolveReport {
    /// The measure of work among solvers of one kind: cycles, or iterations of a solver without cycles.
    pub fn work(&self) -> usize {
        if self.cycles > 0 {
            self.cycles
        } else {
            self.iterations
        }
    }
}
