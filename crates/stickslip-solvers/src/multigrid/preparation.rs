//! Preparation of a hierarchy for an operator, and its update in the iterations of Newton's method.

use nalgebra::SVector;

use super::coarse::CoarseSolver;
use super::fields::Fields;
use super::level::Level;
use super::linearization::Linearization;
use super::transfer::Transfer;
use super::whole::Whole;
use super::{Multigrid, slab_cycle};
use crate::energy::expect;
use crate::{BlockMatrix, SolveError};

impl<const C: usize> Multigrid<C> {
    /// Computes the Galerkin products of `operator` without friction.
    pub(crate) fn prepare(
        &mut self,
        operator: &BlockMatrix<C>,
        fixed: &[[bool; C]],
        frictional: &[usize],
    ) -> Result<(), SolveError> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        let expected = self
            .transfers
            .last()
            .map_or(operator.rows(), Transfer::fine_count);
        expect([(expected, operator.rows())])?;
        let reusable = self.frictional == frictional
            && self
                .levels
                .last()
                .is_some_and(|finest| finest.same_pattern(operator, fixed));
        if !reusable {
            self.frictional = frictional.to_vec();
            let how = (self.cut, self.single);
            let mut finest = Level::finest(operator, how, fixed, frictional, &self.basis.axes);
            if self.transfers.is_empty() || self.post == 0 {
                finest.keep_matrix(operator);
            }
            let edges = slab_cycle::edge_count(&finest.slabs) * finest.slabs.wide_count();
            self.edges = vec![SVector::zeros(); edges];
            self.levels = vec![finest];
            for transfer in self.transfers.iter().rev() {
                let finer = &self.levels[self.levels.len() - 1];
                let fine = match &finer.matrix {
                    Some(matrix) => matrix,
                    None => operator,
                };
                let coarser = Level::coarsened(finer, fine, how, transfer);
                self.levels.push(coarser);
            }
            self.levels.reverse();
            self.fields = self.levels[..self.levels.len() - 1]
                .iter()
                .map(Fields::of)
                .collect();
            let coarsest = self.levels[0].matrix.as_ref();
            self.coarse = coarsest.map(CoarseSolver::analyse).transpose()?;
            self.whole = Whole::default();
        }
        self.whole.in_use = false;
        let finest = self.levels.len() - 1;
        self.levels[finest].restore(operator);
        for l in (0..finest).rev() {
            let (coarser, finer) = self.levels.split_at_mut(l + 1);
            let (fine, frames) = (finer[0].entries(operator), &finer[0].frames);
            coarser[l].assemble(fine, frames, &self.transfers[l]);
        }
        for level in &mut self.levels[1..] {
            level.tie(operator);
        }
        if let (Some(coarse), Some(matrix)) = (&mut self.coarse, &self.levels[0].matrix) {
            // faer takes memory of a thread's own the first time. Whether the matrix is definite is asked
            // when friction has been added.
            let _ = coarse.factorize(matrix);
        }
        Ok(())
    }

    /// Updates the strips with the slopes of friction and the truncated components.
    pub(crate) fn refresh(
        &mut self,
        operator: &BlockMatrix<C>,
        linearization: &Linearization<'_, C>,
    ) -> Result<(), SolveError> {
        let finest = self.levels.len() - 1;
        self.levels[finest].linearize(operator, linearization)?;
        for l in (0..finest).rev() {
            let (coarser, finer) = self.levels.split_at_mut(l + 1);
            coarser[l].refresh(&finer[0], operator, &self.transfers[l]);
        }
        if self.whole.in_use {
            self.whole.factorize(&self.levels[finest]);
        }
        let (Some(coarse), Some(matrix)) = (&mut self.coarse, &self.levels[0].matrix) else {
            return Ok(());
        };
        let factorized = coarse.factorize(matrix);
        factorized.map_err(|error| match error {
            SolveError::RigidBodyMode { vertex } => SolveError::RigidBodyMode {
                vertex: self.on_finest(vertex),
            },
            other => other,
        })
    }
}
