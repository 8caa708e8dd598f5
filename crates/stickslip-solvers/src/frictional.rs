//! Velocity problems that differ in friction alone.

use nalgebra::SVector;

use crate::{Energy, SolveError, SolveReport, Stopping};

/// A solver that condenses the load of several problems once: they share operator, load, prescribed components and
/// frictional vertices, and differ in their potentials.
///
/// The interior follows from the velocities of the frictional vertices, `v = E y + p`. A problem moves these alone; the
/// interior is updated on request:
///
/// ```text
/// condense            the load, once
///   minimize_condensed, change_norm      as often as friction changes
/// extend              the interior, once
/// ```
///
/// [`prepare`](crate::NonsmoothSolver::prepare) and [`minimize`](crate::NonsmoothSolver::minimize) drop the condensed
/// load. As with these, no result depends on earlier solves.
pub trait FrictionalSolver<Op, const C: usize> {
    /// Condenses the load to the frictional vertices; `v` holds the prescribed components.
    ///
    /// # Errors
    /// [`SolveError`] where load and sizes are not those of a problem that was prepared.
    fn condense(
        &mut self,
        energy: &Energy<'_, Op, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError>;

    /// Makes [`change_norm`](Self::change_norm) cheap for the norm `N` until the next load, where that is possible: for
    /// many problems with one operator. The norm for one operator stays the same until the next preparation.
    fn measure(&mut self, energy: &Energy<'_, Op, C>, norm: &Op);

    /// Moves `v` at the frictional vertices to the minimiser for the condensed load, starting from its value there;
    /// the interior of `v` is neither read nor written.
    ///
    /// # Errors
    /// The errors of [`minimize`](crate::NonsmoothSolver::minimize); without a condensed load
    /// [`SolveError::SizeMismatch`].
    fn minimize_condensed(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;

    /// `sqrt(d . N d)` of the change `d = E y`: the body follows the change of the frictional vertices. Only these are
    /// read from `change`.
    ///
    /// # Errors
    /// [`SolveError::SizeMismatch`].
    fn change_norm(
        &mut self,
        energy: &Energy<'_, Op, C>,
        norm: &Op,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError>;

    /// Whether the prepared operator stays positive definite with `slopes`, one number per frictional vertex, added on
    /// the diagonal of its free components [N s/m]: a dense factorisation of the size of the contact.
    fn is_definite_with(&mut self, slopes: &[f64]) -> bool;

    /// Moves the interior of `v` to its solution for the condensed load and the frictional vertices of `v`.
    ///
    /// # Errors
    /// [`SolveError::NotFinite`], and without a condensed load [`SolveError::SizeMismatch`]; `v` stays as it is.
    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError>;
}
