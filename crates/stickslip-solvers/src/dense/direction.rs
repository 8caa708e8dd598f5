//! The Newton direction of a dense problem, by conjugate gradients or by a factor.

use nalgebra::SVector;

use crate::SolveError;
use crate::frictional_vertices::FrictionalVertices;
use crate::newton::Models;

use super::kernels::dot;
use super::system::DenseSystem;
use super::workspace::Workspace;

/// Unknowns per product that a factorisation is worth, and the largest number of products.
const PRODUCTS: usize = 16;
const MOST: usize = 40;

impl<const C: usize> DenseSystem<'_, C> {
    /// Minus the gradient on the kept unknowns.
    pub(super) fn descend_from(&mut self, models: &Models<C>) {
        let Workspace {
            unknowns,
            residual,
            descent,
            factor,
            ..
        } = &mut *self.work;
        let mut frictional = FrictionalVertices::along(self.friction.vertices);
        for (place, &i) in factor.kept.iter().enumerate() {
            let (p, c) = unknowns.owner(i as usize);
            let gradient = frictional.at(p).map_or(0.0, |k| models.gradients[k][c]);
            descent[place] = residual[i as usize] - gradient;
        }
    }

    /// The direction by conjugate gradients, if they converge in the time of a factorisation. They start from zero, or
    /// go `on` from the last direction. Returns the decrease.
    pub(super) fn descend(&mut self, models: &Models<C>, share: f64, on: bool) -> Option<f64> {
        self.descend_from(models);
        self.imaged = false;
        let Workspace {
            unknowns,
            descent,
            direction,
            factor,
            gradients,
            ..
        } = &mut *self.work;
        let size = factor.kept.len();
        let limit = MOST.min(size / PRODUCTS + 4);
        let system = (self.matrix, &**unknowns);
        let descent = (&*factor.kept, &descent[..size]);
        let square = gradients.solve(system, descent, share, limit, on)?;
        direction.fill(SVector::zeros());
        for &i in &factor.kept {
            let (p, c) = unknowns.owner(i as usize);
            direction[p][c] = gradients.solution[i as usize];
        }
        self.imaged = true;
        Some(square)
    }

    /// The same by the factor.
    pub(super) fn substitute(&mut self, models: &Models<C>) -> f64 {
        self.descend_from(models);
        self.imaged = false;
        let Workspace {
            unknowns,
            descent,
            correction,
            direction,
            factor,
            ..
        } = &mut *self.work;
        let size = factor.kept.len();
        let (descent, correction) = (&descent[..size], &mut correction[..size]);
        correction.copy_from_slice(descent);
        factor.solve(correction);
        direction.fill(SVector::zeros());
        for (&i, &value) in factor.kept.iter().zip(&*correction) {
            let (p, c) = unknowns.owner(i as usize);
            direction[p][c] = value;
        }
        dot(descent, correction)
    }

    pub(super) fn factorize(&mut self, models: &mut Models<C>) -> Result<(), SolveError> {
        self.factorized = true;
        let Workspace {
            unknowns, factor, ..
        } = &mut *self.work;
        let (matrix, vertices) = (self.matrix, self.friction.vertices);
        factor.assemble(matrix, unknowns, vertices, models);
        let Err(unknown) = factor.factorize() else {
            return Ok(());
        };
        let vertex = |unknown: u32| unknowns.owner(unknown as usize).0;
        models.stiffen(vertex(unknown), |k| unknowns.scale(matrix, vertices[k]));
        factor.assemble(matrix, unknowns, vertices, models);
        models.stale = false;
        factor.factorize().map_err(|_| SolveError::NotConvex {
            vertex: vertex(unknown),
            iteration: self.iteration,
        })
    }
}
