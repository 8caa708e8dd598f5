//! Test of positive definiteness of an operator with negative springs.

use nalgebra::SVector;
use stickslip_solvers::{ConjugateGradients, LinearSolver, Matrix};

use crate::sums::all_directions;

/// Workspace for the test of an operator.
#[derive(Clone)]
pub(crate) struct Definite<const C: usize> {
    solver: ConjugateGradients<C>,
    load: Vec<SVector<f64, C>>,
    solution: Vec<SVector<f64, C>>,
}

impl<const C: usize> Definite<C> {
    /// A workspace for operators of this shape.
    pub(crate) fn new(operator: &dyn Matrix<C>) -> Self {
        let size = operator.vertex_count();
        let zeros = || vec![SVector::zeros(); size];
        let mut solver = ConjugateGradients::default();
        // Takes its room here, where nothing can be wrong: no component is free.
        let prepared = solver.prepare(operator, &vec![[true; C]; size]);
        debug_assert!(prepared.is_ok());
        Self {
            solver,
            load: zeros(),
            solution: zeros(),
        }
    }

    /// Whether an operator is positive definite on its free components. Conjugate gradients under a load in all directions
    /// detect negative curvature.
    pub(crate) fn is_positive_definite(
        &mut self,
        operator: &dyn Matrix<C>,
        fixed: &[[bool; C]],
    ) -> bool {
        all_directions(&mut self.load, fixed);
        self.solution.fill(SVector::zeros());
        let prepared = self.solver.prepare(operator, fixed).is_ok();
        // A diagonal block may be indefinite in one process of several.
        operator.ranks().all(prepared)
            && (self.solver)
                .solve(operator, &self.load, &mut self.solution)
                .is_ok()
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/definite.rs"]
mod tests;
