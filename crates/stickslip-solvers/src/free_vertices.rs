//! Vertices that a solver need not know.

use nalgebra::SVector;

use crate::{Energy, SolveError, SolveReport, Stopping};

/// The part of a solver of explicit steps that most vertices do without: those free of friction, of fixed components and of
/// coupling to others have the velocity
///
/// ```text
/// v_i = compliance_i * load_i      component by component
/// ```
///
/// which the time loop finds while it has the load at hand. A [`NonsmoothSolver`](crate::NonsmoothSolver) has it as
/// [`free_vertices`](crate::NonsmoothSolver::free_vertices), once it is prepared.
pub trait FreeVertices<Op, const C: usize> {
    /// The diagonals of the inverse blocks of all vertices [m/(N s)]; of use at the free ones.
    fn compliances(&self) -> &[SVector<f64, C>];

    /// The vertices that are not free, increasing.
    fn others(&self) -> &[usize];

    /// Moves `v` to the minimiser at the vertices that are not free, as [`minimize`](crate::NonsmoothSolver::minimize) does at
    /// all; the same bits.
    ///
    /// # Errors
    /// Those of [`minimize`](crate::NonsmoothSolver::minimize).
    fn minimize_others(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;
}
