//! Solvers of `B x = r` on the free components.

use nalgebra::SVector;

use crate::energy::expect;
use crate::uncloned::Uncloned;
use crate::{Basis, MeshId, SolveError};

/// A solver of linear problems: static equilibrium, the inverse of a mass.
///
/// Implement [`prepare`](LinearSolver::prepare) for the work that depends on the operator alone, and
/// [`solve`](LinearSolver::solve).
///
/// | solver | for | |
/// | --- | --- | --- |
/// | [`ConjugateGradients`](crate::ConjugateGradients) | every [`Matrix`](crate::Matrix) | one iteration on a diagonal operator; slow for the stiffness of a fine mesh |
/// | `MultigridSolver` | meshes with coarser levels | work proportional to the unknowns |
/// | `Cholesky` | block matrices | exact to rounding; memory |
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_solvers::{ConjugateGradients, LinearSolver};
///
/// let mut solver = ConjugateGradients::default();
/// let spring = SMatrix::<f64, 2, 2>::new(2.0, 1.0, 1.0, 2.0);
/// // The second component is held at 3.
/// let (load, mut x) = ([SVector::from([5.0, 0.0])], [SVector::from([0.0, 3.0])]);
/// solver.prepare(&spring, &[[false, true]])?;
/// solver.solve(&spring, &load, &mut x)?;
/// assert_eq!(x[0], SVector::from([1.0, 3.0]));
/// # Ok::<(), stickslip_solvers::SolveError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not solve linear problems with the matrix `{Op}` of {C} components",
    note = "a `BlockMatrix`, as finite elements assemble it, takes `Cholesky`, `MultigridSolver` or `ConjugateGradients`; other formats take `ConjugateGradients`"
)]
pub trait LinearSolver<Op: ?Sized, const C: usize>: Send {
    /// Sets the basis of later operators, loads and solutions. A solver whose knowledge of the body is its operator
    /// has nothing to do; one with transfers from other meshes has to change these.
    fn change_basis(&mut self, _basis: &Basis<C>) {}

    /// Called before the first solve and whenever `operator` or the `fixed` components changed.
    ///
    /// # Errors
    /// [`SolveError`] if the solver does not support the operator.
    fn prepare(&mut self, operator: &Op, fixed: &[[bool; C]]) -> Result<(), SolveError>;

    /// Moves the free components of `x` to the solution of `(B x)_i = r_i`, as exactly as rounding allows;
    /// its fixed components are data. `operator` is that of the preparation.
    ///
    /// # Errors
    /// [`SolveError`] without a solution.
    fn solve(
        &mut self,
        operator: &Op,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError>;

    /// The mesh it was made for; `None`, the default, if any mesh fits.
    fn mesh(&self) -> Option<MeshId> {
        None
    }

    /// A solver with the same settings, basis and levels, for the clone of a simulation or scene. The clone prepares
    /// it anew.
    ///
    /// The default, for a type that cannot be cloned, refuses every problem with [`SolveError::NotCloned`]. Override it
    /// with `Box::new(self.clone())` where that is possible.
    fn boxed_clone(&self) -> Box<dyn LinearSolver<Op, C>> {
        Box::new(Uncloned)
    }
}

impl<Op: ?Sized, S, const C: usize> LinearSolver<Op, C> for Box<S>
where
    S: LinearSolver<Op, C> + ?Sized,
{
    fn change_basis(&mut self, basis: &Basis<C>) {
        (**self).change_basis(basis);
    }

    fn prepare(&mut self, operator: &Op, fixed: &[[bool; C]]) -> Result<(), SolveError> {
        (**self).prepare(operator, fixed)
    }

    fn solve(
        &mut self,
        operator: &Op,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        (**self).solve(operator, load, x)
    }

    fn mesh(&self) -> Option<MeshId> {
        (**self).mesh()
    }

    fn boxed_clone(&self) -> Box<dyn LinearSolver<Op, C>> {
        (**self).boxed_clone()
    }
}

/// Refuses fields of other lengths than the preparation's.
pub(crate) fn check_lengths<const C: usize>(
    size: usize,
    load: &[SVector<f64, C>],
    x: &[SVector<f64, C>],
) -> Result<(), SolveError> {
    expect([(size, load.len()), (size, x.len())])
}
