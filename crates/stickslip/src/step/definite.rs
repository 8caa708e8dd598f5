//! Whether a body stands springs that push.

use nalgebra::{SMatrix, SVector};
use stickslip_tnnmg::{ConjugateGradients, LinearSolver, Operator};

use super::reduction::all_directions;

/// Room for the test of an operator.
pub(crate) struct Definite<const C: usize> {
    solver: ConjugateGradients<C>,
    load: Vec<SVector<f64, C>>,
    solution: Vec<SVector<f64, C>>,
}

impl<const C: usize> Definite<C> {
    /// For operators like this one.
    pub(super) fn new<Op: Operator<C>>(operator: &Op) -> Self {
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

    /// Whether an operator is positive definite on its free components, with numbers added on the diagonal at some
    /// vertices, which stay there: conjugate gradients under a load in all directions find one in which it is not.
    pub(super) fn holds<Op: Operator<C>>(
        &mut self,
        operator: &mut Op,
        (vertices, added): (&[usize], &[f64]),
        fixed: &[[bool; C]],
    ) -> bool {
        for (&vertex, &added) in vertices.iter().zip(added) {
            let block = SMatrix::from_diagonal_element(added);
            operator.add_to_diagonal(vertex, &block);
        }
        all_directions(&mut self.load, fixed);
        self.solution.fill(SVector::zeros());
        let prepared = self.solver.prepare(operator, fixed).is_ok();
        // A diagonal block may be indefinite in one process of several.
        operator.all(prepared)
            && (self.solver)
                .solve(operator, &self.load, &mut self.solution)
                .is_ok()
    }

    /// Moves what is not `held` where it is in balance with the rest, `B v = load`; leaves it where it is if the operator is
    /// not definite there.
    pub(super) fn balance<Op: Operator<C>>(
        &mut self,
        operator: &Op,
        load: &[SVector<f64, C>],
        held: &[[bool; C]],
        velocity: &mut [SVector<f64, C>],
    ) {
        let prepared = self.solver.prepare(operator, held).is_ok();
        if !operator.all(prepared) {
            return;
        }
        self.solution.copy_from_slice(velocity);
        if (self.solver)
            .solve(operator, load, &mut self.solution)
            .is_ok()
        {
            velocity.copy_from_slice(&self.solution);
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    /// A chain of `n` masses between walls resists a push at its first one by `1 + 1/n` springs.
    #[test]
    fn a_chain_bears_a_push_up_to_its_stiffness() {
        for n in [1_u8, 2, 7, 40, 200] {
            let size = usize::from(n);
            let chain = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
                0 => 2.0,
                1 => -1.0,
                _ => 0.0,
            });
            let stiffness = 1.0 + f64::from(n).recip();
            let mut definite = Definite::<1>::new(&chain);
            let mut holds = |fixed: &[[bool; 1]], push: f64| {
                definite.holds(&mut chain.clone(), (&[0], &[-push]), fixed)
            };
            let free = vec![[false]; size];
            assert!(
                holds(&free, 0.0) && holds(&free, stiffness * (1.0 - 1e-6)),
                "{n}"
            );
            assert!(!holds(&free, stiffness * (1.0 + 1e-6)), "{n}");
            // Held there it bears any.
            let mut held = free.clone();
            held[0] = [true];
            assert!(holds(&held, 1e9), "{n}");
        }
    }
}
