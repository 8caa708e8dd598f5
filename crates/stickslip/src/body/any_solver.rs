//! A solver whose matrix is not known by its type.

use std::any::{Any, type_name};

use stickslip_solvers::NonsmoothSolver;

use crate::SceneError;

/// A solver of velocity problems with matrices of one format.
pub(crate) struct AnySolver {
    /// A `Box<dyn NonsmoothSolver<Op, C>>`.
    solver: Box<dyn Any + Send>,
    matrix: &'static str,
}

impl AnySolver {
    pub(crate) fn new<Op: 'static, const C: usize>(
        solver: impl NonsmoothSolver<Op, C> + 'static,
    ) -> Self {
        let solver = solver.into_object();
        Self {
            solver: Box::new(solver),
            matrix: type_name::<Op>(),
        }
    }

    /// The solver for a body with matrices `Op`.
    ///
    /// # Errors
    /// [`SceneError::Format`] if it is one for matrices of another format.
    pub(crate) fn of<Op: 'static, const C: usize>(
        self,
    ) -> Result<Box<dyn NonsmoothSolver<Op, C>>, SceneError> {
        let solver = self.solver.downcast::<Box<dyn NonsmoothSolver<Op, C>>>();
        let found = solver.map_err(|_| SceneError::Format {
            solver: self.matrix,
            body: type_name::<Op>(),
        })?;
        Ok(*found)
    }
}
