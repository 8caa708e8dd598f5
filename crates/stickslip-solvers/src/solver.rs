//! The minimiser of an [`Energy`], its stopping criterion and its cost.

use nalgebra::SVector;

use crate::uncloned::Uncloned;
use crate::{Basis, Energy, FrictionalSolver, MeshId, SolveError};

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
    /// The largest number of iterations before [`SolveError::NotConverged`]. Stall detection may stop earlier.
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

/// The cost of one call of [`NonsmoothSolver::minimize`].
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

/// The work of a solver since it was made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// The number of prepared operators; a change of the step size is one.
    pub preparations: usize,
    /// The number of numeric factorisations of the whole operator.
    pub factorizations: usize,
    /// The entries of one factor.
    pub factor_entries: usize,
    /// Forward substitutions of a load with the whole factor, from the body to its frictional vertices.
    pub forward_substitutions: usize,
    /// Back substitutions from the frictional vertices to the body.
    pub backward_substitutions: usize,
    /// Products with the dense matrix of [`DenseNewton`](crate::DenseNewton), each with as many operations as entries.
    pub products: usize,
}

/// A minimiser of [`Energy`].
///
/// Implement [`minimize`](NonsmoothSolver::minimize). It must never increase the energy, must leave fixed components
/// alone, and must return an error rather than an inaccurate field. Override [`prepare`](NonsmoothSolver::prepare) for
/// the work that depends on the operator alone (factors, Galerkin products), and
/// [`frictional`](NonsmoothSolver::frictional) if one condensation of a load serves several problems. The time loop and
/// the coupling do not allocate; `minimize` should not either. The result must not depend on earlier solves, or a
/// restarted run does not continue with the same bits. With the feature `sparse`, `check_nonsmooth_solver` checks all
/// this for a solver of block matrices.
///
/// A complete solver for problems without coupling between vertices:
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_solvers::{Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};
///
/// struct OneVertex;
///
/// impl NonsmoothSolver<SMatrix<f64, 1, 1>, 1> for OneVertex {
///     fn minimize(
///         &mut self,
///         energy: &Energy<'_, SMatrix<f64, 1, 1>, 1>,
///         _stopping: &Stopping<'_, SMatrix<f64, 1, 1>>,
///         v: &mut [SVector<f64, 1>],
///     ) -> Result<SolveReport, SolveError> {
///         v[0] = energy.potentials.minimize(0, energy.operator, &energy.load[0]);
///         Ok(SolveReport { iterations: 1, ..SolveReport::default() })
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not solve velocity problems with the matrix `{Op}` of {C} components",
    note = "a `BlockMatrix`, as finite elements assemble it, takes `Condensed`, `Tnnmg` or `BlockGaussSeidel`",
    note = "an `ElementOperator`, of an `ElementStiffness`, takes `Diagonal` and an explicit scheme",
    note = "a `Symmetric`, of a reduced body, and a `DMatrix` take `DenseNewton`; an `SMatrix`, of a single vertex, takes `Point`",
    note = "the kernel of a fault by boundary integrals takes `RungeKutta` instead of a simulation, or `DenseNewton` as a `DMatrix::from(&kernel)`"
)]
pub trait NonsmoothSolver<Op, const C: usize>: Send {
    /// Prepares for an operator: called before the first solve and whenever `operator`, `vertices` or `fixed` changed.
    ///
    /// # Errors
    /// [`SolveError`] if the solver does not support the operator.
    fn prepare(&mut self, energy: &Energy<'_, Op, C>) -> Result<(), SolveError> {
        let _ = energy;
        Ok(())
    }

    /// Moves `v` to the minimiser, starting from its value; its fixed components are the data.
    ///
    /// # Errors
    /// [`SolveError`] if the tolerance is not reached; `v` is then the last iterate.
    fn minimize(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;

    /// The solver of several problems that differ in friction alone, if it is faster: the time loop then uses it.
    /// `None` by default.
    fn frictional(&mut self) -> Option<&mut dyn FrictionalSolver<Op, C>> {
        None
    }

    /// Sets the basis of later operators, loads, potentials and velocities. A solver whose knowledge of the body is
    /// its operator has nothing to do; one with transfers from other meshes has to change these.
    fn change_basis(&mut self, _basis: &Basis<C>) {}

    /// The mesh it was made for; `None`, the default, if any mesh fits. A simulation on another mesh
    /// refuses the solver.
    fn mesh(&self) -> Option<MeshId> {
        None
    }

    /// A solver with the same settings, basis and levels, for the clone of a simulation or scene. The clone prepares
    /// it anew.
    ///
    /// The default, for a type that cannot be cloned, refuses every problem with [`SolveError::NotCloned`]. Override it
    /// with `Box::new(self.clone())` where that is possible.
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<Op, C>> {
        Box::new(Uncloned)
    }

    /// Work counters; all zero by default.
    fn counters(&self) -> Counters {
        Counters::default()
    }

    /// The solver as an object. A solver overrides it to be compiled in its own crate.
    #[doc(hidden)]
    fn into_object(self) -> Box<dyn NonsmoothSolver<Op, C>>
    where
        Self: Sized + 'static,
    {
        Box::new(self)
    }
}

impl<Op, S, const C: usize> NonsmoothSolver<Op, C> for Box<S>
where
    S: NonsmoothSolver<Op, C> + ?Sized,
{
    fn prepare(&mut self, energy: &Energy<'_, Op, C>) -> Result<(), SolveError> {
        (**self).prepare(energy)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        (**self).minimize(energy, stopping, v)
    }

    fn frictional(&mut self) -> Option<&mut dyn FrictionalSolver<Op, C>> {
        (**self).frictional()
    }

    fn change_basis(&mut self, basis: &Basis<C>) {
        (**self).change_basis(basis);
    }

    fn mesh(&self) -> Option<MeshId> {
        (**self).mesh()
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<Op, C>> {
        (**self).boxed_clone()
    }

    fn counters(&self) -> Counters {
        (**self).counters()
    }
}
