//! What a minimiser of an [`Energy`] is asked to do.

use nalgebra::SVector;

use crate::uncloned::Uncloned;
use crate::{Energy, Frames, FrictionalSolver, SolveError};

/// When an iteration is finished: the error left is estimated to be no more than `tolerance`, or
/// than `relative` times the larger of the start and of any change.
///
/// Both are measured as `sqrt(d . N d)`, with a matrix `N` of the caller's choice.
#[derive(Debug)]
pub struct Stopping<'a, Op> {
    /// `N`, symmetric and positive definite on the free components.
    pub norm: &'a Op,
    /// The distance that is small enough, in units of the norm; positive.
    pub tolerance: f64,
    /// The share of the norm of the start, or of a change if that is larger, that is small enough;
    /// about `1e-14` keeps a tolerance below the rounding errors from being waited for.
    pub relative: f64,
    /// A number for which `d . N d <= equivalence d . B d` holds, `B` the energy's operator; infinity
    /// where none is known. With it a solver may stop on its own estimate of the error, without an
    /// iteration more to see that nothing changes.
    pub equivalence: f64,
    /// The number of iterations after which [`SolveError::NotConverged`] is returned, at the latest: a
    /// solver may give up earlier what it will not reach.
    pub max_iterations: usize,
}

impl<'a, Op> Stopping<'a, Op> {
    /// An error of `tolerance` in the norm of the energy's own operator.
    pub fn in_energy_norm(operator: &'a Op, tolerance: f64) -> Self {
        Self {
            norm: operator,
            tolerance,
            relative: 1e-14,
            equivalence: 1.0,
            max_iterations: 100_000,
        }
    }

    /// The distance that is small enough from the start `v`. A relative tolerance near the rounding errors is
    /// left to these: the norm of the start, a pass over the whole norm matrix, is not taken for it.
    #[cfg(feature = "condensed")]
    pub(crate) fn at<const C: usize>(&self, v: &[SVector<f64, C>]) -> f64
    where
        Op: crate::Operator<C>,
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

/// What one call of [`NonsmoothSolver::minimize`] cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveReport {
    /// Nonlinear iterations: sweeps over all vertices, each exact at a vertex.
    pub iterations: usize,
    /// Linear multigrid cycles within them; 0 for solvers without any.
    pub cycles: usize,
    /// Estimated distance to the minimiser in the stopping norm.
    pub error: f64,
}

impl SolveReport {
    /// The figure by which solvers of one kind compare: cycles, or iterations of a solver without.
    pub fn work(&self) -> usize {
        if self.cycles > 0 {
            self.cycles
        } else {
            self.iterations
        }
    }
}

/// What a solver has done since it was made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Operators prepared for; a change of the step size is one.
    pub preparations: usize,
    /// Numeric factorisations of the whole operator.
    pub factorizations: usize,
    /// The entries of one factor.
    pub factor_entries: usize,
    /// Substitutions of a load into the whole factor, from the body to its frictional vertices.
    pub forward_substitutions: usize,
    /// Substitutions from the frictional vertices back to the body.
    pub backward_substitutions: usize,
    /// Products with the dense matrix of [`DenseNewton`](crate::DenseNewton), each with as many operations as it has entries.
    pub products: usize,
}

/// A minimiser of [`Energy`].
///
/// Implement [`minimize`](NonsmoothSolver::minimize), so that it never increases the energy, leaves
/// fixed components alone, and returns an error rather than a field it cannot vouch for. Override
/// [`prepare`](NonsmoothSolver::prepare) to do what depends on the operator alone (factors, Galerkin
/// products), and [`frictional`](NonsmoothSolver::frictional) where a load can be taken once for several
/// problems. Neither the time loop nor the coupling allocate; nor should `minimize`. The result must not
/// depend on what was solved before, or a run that is restored does not go on with the same bits. With the
/// feature `sparse`, `check_nonsmooth_solver` puts a solver for block matrices through all this.
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
pub trait NonsmoothSolver<Op, const C: usize>: Send {
    /// Called before the first solve and whenever `operator`, `vertices` or `fixed` changed.
    ///
    /// # Errors
    /// [`SolveError`] where the operator is not one this solver can work with.
    fn prepare(&mut self, energy: &Energy<'_, Op, C>) -> Result<(), SolveError> {
        let _ = energy;
        Ok(())
    }

    /// Moves `v` to the minimiser, starting from its value; its fixed components are the data.
    ///
    /// # Errors
    /// [`SolveError`] where the tolerance is not reached; `v` is then the last iterate.
    fn minimize(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;

    /// The solver of several problems that differ in friction alone, if it gains by that: the time loop then solves
    /// its problems by this. None by default.
    fn frictional(&mut self) -> Option<&mut dyn FrictionalSolver<Op, C>> {
        None
    }

    /// From now on operators, loads, potentials and velocities are in these frames. Nothing to do for a solver that
    /// knows of the body what its operator says; one with transfers from other meshes has to turn these.
    fn turn(&mut self, _frames: &Frames<C>) {}

    /// The mesh that it was made for, by its fingerprint; `None`, the default, where any will do. A simulation on
    /// another mesh refuses the solver.
    fn mesh(&self) -> Option<u64> {
        None
    }

    /// A solver with the same settings, frames and levels for the clone of a simulation or scene, which prepares it anew.
    ///
    /// The default, for a type that cannot be cloned, is one that refuses every problem with
    /// [`SolveError::NotCloned`]. Override it with `Box::new(self.clone())` where that is possible.
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<Op, C>> {
        Box::new(Uncloned)
    }

    /// What it has done so far; nothing is counted by default.
    fn counters(&self) -> Counters {
        Counters::default()
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

    fn turn(&mut self, frames: &Frames<C>) {
        (**self).turn(frames);
    }

    fn mesh(&self) -> Option<u64> {
        (**self).mesh()
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<Op, C>> {
        (**self).boxed_clone()
    }

    fn counters(&self) -> Counters {
        (**self).counters()
    }
}
