//! The minimiser of an [`Energy`], and its work.

use nalgebra::SVector;

use crate::uncloned::Uncloned;
use crate::{
    Basis, Energy, FreeVertices, FrictionalSolver, MeshId, SolveError, SolveReport, Stopping,
};

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

    /// The vertices whose velocity follows from their load alone, if the solver has any: explicit steps then solve for these
    /// themselves. `None` by default.
    fn free_vertices(&mut self) -> Option<&mut dyn FreeVertices<Op, C>> {
        None
    }

    /// Whether the prepared operator stays positive definite with `slopes`, one number per frictional vertex, added on the
    /// diagonal of its free components [N s/m]; `None` if the solver cannot tell without solving, which leaves the question to
    /// conjugate gradients. By default it is that of [`frictional`](Self::frictional).
    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        let frictional = self.frictional()?;
        Some(frictional.is_definite_with(slopes))
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

    fn free_vertices(&mut self) -> Option<&mut dyn FreeVertices<Op, C>> {
        (**self).free_vertices()
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        (**self).is_definite_with(slopes)
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
