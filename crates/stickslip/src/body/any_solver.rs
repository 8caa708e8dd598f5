//! A solver whose matrix is not known by its type.

use std::any::{Any, type_name};

use stickslip_solvers::{NonsmoothSolver, Operator};

use crate::SceneError;

/// A solver of velocity problems with matrices of one format.
pub(crate) struct AnySolver {
    /// A `Box<dyn NonsmoothSolver<Op, C>>`.
    object: Box<dyn Any + Send>,
    solver: &'static str,
    matrices: &'static str,
}

impl AnySolver {
    pub(crate) fn new<Op, S, const C: usize>(solver: S) -> Self
    where
        Op: Operator<C>,
        S: NonsmoothSolver<Op, C> + 'static,
    {
        Self {
            object: Box::new(solver.into_object()),
            solver: type_name::<S>(),
            matrices: Op::format(),
        }
    }

    /// The solver for a body with matrices `Op`.
    ///
    /// # Errors
    /// [`SceneError::Format`] if it is one for matrices of another format.
    pub(crate) fn of<Op, const C: usize>(
        self,
    ) -> Result<Box<dyn NonsmoothSolver<Op, C>>, SceneError>
    where
        Op: Operator<C>,
    {
        let found = self.object.downcast::<Box<dyn NonsmoothSolver<Op, C>>>();
        let found = found.map_err(|_| SceneError::Format {
            solver: self.solver,
            matrices: self.matrices,
            body: Op::format(),
        })?;
        Ok(*found)
    }
}
