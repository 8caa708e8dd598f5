//! Error estimates of a dense problem.

use nalgebra::SVector;

use crate::frictional_vertices::FrictionalVertices;
use crate::newton::{Models, Step};

use super::system::{BALANCED, DenseSystem, SAFETY};
use super::workspace::Workspace;

/// The number of roundings of its terms in a residual.
const ROUNDINGS: f64 = 16.0;

impl<const C: usize> DenseSystem<'_, C> {
    /// `x . S x` of a field.
    pub(super) fn energy_square(&self, x: &[SVector<f64, C>]) -> f64 {
        let unknowns = &self.work.unknowns;
        let count = unknowns.count();
        (0..count)
            .filter(|&j| unknowns.value(x, j) != 0.0)
            .map(|j| {
                let column = self.matrix.column(j);
                let image: f64 = (0..count).map(|i| column[i] * unknowns.value(x, i)).sum();
                unknowns.value(x, j) * image
            })
            .sum()
    }

    /// Adds the update of the next sweep to the direction, in truncated components. Returns the squares of these
    /// changes in the norm of the diagonal blocks.
    pub(super) fn sweep_ahead(&mut self, models: &Models<C>, y: &[SVector<f64, C>]) -> f64 {
        let mut sum = 0.0;
        for (k, &p) in self.friction.vertices.iter().enumerate() {
            if !models.truncated[k] {
                continue;
            }
            let change = self.minimizer(y, p, Some(k)) - y[p];
            sum += change.dot(&(self.work.unknowns.block(self.matrix, p) * change));
            for c in (0..C).filter(|&c| models.dropped[k][c]) {
                self.work.direction[p][c] = change[c];
            }
        }
        sum
    }

    /// Whether the direction is at most this share of each slip rate, and none is at rest: rates far below the
    /// tolerance are then as accurate as after a sweep.
    pub(super) fn is_balanced(&self, y: &[SVector<f64, C>], share: f64) -> bool {
        let direction = &self.work.direction;
        (self.friction.vertices.iter()).all(|&p| {
            let rate = y[p].amax();
            rate > 0.0 && direction[p].amax() <= share * rate
        })
    }

    /// The error after a whole step, if the remaining forces are so small that it is below the goal without a product
    /// with the matrix: the first correction of conjugate gradients, at their longest step so far.
    pub(super) fn far_below_goal(
        &mut self,
        models: &Models<C>,
        y: &[SVector<f64, C>],
        step: &Step,
    ) -> Option<f64> {
        let measured = step.whole && !self.factorized && self.goal.equivalence.is_finite();
        if !measured || models.truncated.contains(&true) {
            return None;
        }
        self.descend_from(models);
        let Workspace {
            unknowns,
            descent,
            factor,
            gradients,
            ..
        } = &mut *self.work;
        let descent = (&*factor.kept, &descent[..factor.kept.len()]);
        let left = gradients.first_correction(unknowns, descent)?;
        let change = (4.0 * left * self.goal.equivalence).sqrt();
        let is_small = left <= 0.25 * step.taken && change <= SAFETY * self.goal.tolerance;
        let mut vertices = self.friction.vertices.iter();
        let done = is_small
            && vertices.all(|&p| {
                let rate = y[p].amax();
                let mut free = unknowns.free(p);
                rate > 0.0 && free.all(|(_, i)| gradients.corrects_by(i) <= BALANCED * rate)
            });
        done.then_some(change)
    }

    /// Whether the remaining descent, also of the local minimisations of truncated components, is at the level of the
    /// rounding errors of its terms.
    pub(super) fn is_rounded(&self, models: &Models<C>, y: &[SVector<f64, C>]) -> bool {
        let Workspace {
            unknowns,
            force,
            descent,
            direction,
            factor,
            ..
        } = &*self.work;
        let count = unknowns.count();
        let mut kept = factor.kept.iter().zip(descent).peekable();
        let mut frictional = FrictionalVertices::along(self.friction.vertices);
        (0..count).all(|i| {
            let column = self.matrix.column(i);
            let (p, c) = unknowns.owner(i);
            let mut terms = force[i].abs();
            for (j, entry) in column.iter().enumerate() {
                terms += (entry * unknowns.value(y, j)).abs();
            }
            if let Some(k) = frictional.at(p) {
                terms += models.gradients[k][c].abs();
            }
            let left = match kept.next_if(|&(&unknown, _)| unknown as usize == i) {
                Some((_, descent)) => descent.abs(),
                None => column[i] * direction[p][c].abs(),
            };
            left <= ROUNDINGS * f64::EPSILON * terms
        })
    }
}
