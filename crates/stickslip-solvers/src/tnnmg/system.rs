//! A sparse quadratic part in the nonsmooth Newton method, with multigrid for its linear problems.

use nalgebra::SVector;

use crate::block_matrix::Rows;
use crate::field::{clear_masked, dot};
use crate::frictional_vertices::FrictionalVertices;
use crate::linear_step::{LinearStep, LinearSystem};
use crate::multigrid::{Linearization, Multigrid};
use crate::newton::{Aim, Models, Step, System};
use crate::sweep::{ROUNDINGS, Sweep, force_and_terms};
use crate::{BlockMatrix, Energy, Matrix, SolveError, Stopping};

/// A sparse quadratic part during one minimisation.
pub(super) struct SparseSystem<'a, const C: usize> {
    pub(super) energy: &'a Energy<'a, BlockMatrix<C>, C>,
    pub(super) stopping: &'a Stopping<'a, BlockMatrix<C>>,
    pub(super) linear_step: LinearStep,
    /// The factor by which the next linear step reduces its error.
    pub(super) reduction: f64,
    pub(super) tolerance: f64,
    /// The change of the last iteration.
    pub(super) previous: f64,
    pub(super) cycles: usize,
    /// Square of the error of the last linear step, in the norm of the Newton matrix.
    pub(super) linear_error: f64,
    /// `d . H d` of that step.
    pub(super) curvature: f64,
    pub(super) sweep: &'a Sweep<C>,
    pub(super) multigrid: &'a mut Multigrid<C>,
    pub(super) linear: &'a mut LinearSystem<C>,
    pub(super) moved: &'a mut Vec<SVector<f64, C>>,
    pub(super) unsupported: bool,
}

/// The share of the tolerance for an estimated error.
const SAFETY: f64 = 0.3;

impl<const C: usize> SparseSystem<'_, C> {
    /// Updates the levels with the models. Weakening friction may make the matrix indefinite.
    fn refresh(&mut self, models: &Models<C>, iteration: usize) -> Result<(), SolveError> {
        let linearization = Linearization {
            vertices: self.energy.vertices,
            hessians: &models.hessians,
            dropped: &models.dropped,
        };
        let refreshed = (self.multigrid).refresh(self.energy.operator, &linearization);
        refreshed.map_err(|error| match (&error, models.weakening()) {
            (SolveError::IndefiniteMatrix { .. } | SolveError::IndefiniteBlock { .. }, Some(k)) => {
                SolveError::NotConvex {
                    vertex: self.energy.vertices[k],
                    iteration,
                }
            }
            _ => error,
        })
    }

    /// The square of the accepted error, in the norm of the operator.
    fn target(&self) -> f64 {
        (SAFETY * self.tolerance).powi(2) / self.stopping.equivalence
    }

    /// The square of the error that the next iteration would find at the frictional vertices, in the norm of the Newton
    /// matrix: the remainder of its second-order model, measured by the factor in use or by local inverses.
    fn mismatch(&mut self, models: &Models<C>) -> f64 {
        let missed = |k: usize, correction: &SVector<f64, C>| {
            let expected = models.gradients[k] + models.hessians[k] * correction;
            let mut missed = models.ahead[k] - expected;
            clear_masked(&mut missed, &models.dropped[k]);
            missed
        };
        let vertices = self.energy.vertices;
        if self.multigrid.is_exact() {
            let square = self.linear.square_of(self.multigrid, vertices, missed);
            return if square.is_finite() {
                square
            } else {
                f64::INFINITY
            };
        }
        let vertices = vertices.iter().enumerate();
        vertices
            .map(|(k, &vertex)| {
                let missed = missed(k, &self.linear.correction[vertex]);
                let local = missed.dot(&self.multigrid.balanced(vertex, &missed));
                if local.is_finite() {
                    local
                } else {
                    f64::INFINITY
                }
            })
            .sum()
    }

    /// The square of the part of the step that is due to the rounding of the blocks, in the norm of the Newton matrix:
    /// with `|d . E d| <= r` for the rounding error `E` of the matrix `H`, the step `d` of `(H + E) d = b` is
    /// `H^-1 E d` away from that of `H`, of the order of `r/sqrt(d . H d)`.
    fn rounding_error(&self) -> f64 {
        let rounding = self.multigrid.rounding(&self.linear.correction);
        if rounding > 0.0 {
            rounding * rounding / self.curvature
        } else {
            0.0
        }
    }

    /// The same for the truncated vertices, outside the linear step: their change by the next sweep.
    fn truncated_error(&self, models: &Models<C>, v: &[SVector<f64, C>]) -> f64 {
        let truncated = models.truncated.iter().enumerate();
        truncated
            .filter(|&(_, &truncated)| truncated)
            .map(|(k, _)| self.sweep.local_error(self.energy, k, v))
            .sum()
    }
}

impl<const C: usize> System<C> for SparseSystem<'_, C> {
    /// Each vertex was balanced in its turn: the residual after the sweep is the descent.
    fn sweep(&mut self, v: &mut [SVector<f64, C>]) {
        let residual = &mut self.linear.residual;
        let blocks = (self.energy, self.multigrid.inverses());
        (self.sweep).forward_with_residual(blocks, v, self.moved, residual);
    }

    fn scales(&self) -> impl Fn(usize) -> f64 + Sync {
        let sweep = self.sweep;
        |k| sweep.scale(k)
    }

    fn linearize(&mut self, models: &mut Models<C>, iteration: usize) -> Result<(), SolveError> {
        // Nothing changes while every vertex sticks.
        if models.stale {
            let loose = match self.refresh(models, iteration) {
                Err(SolveError::RigidBodyMode { vertex }) => Some(vertex),
                Ok(()) if self.unsupported => self.multigrid.rounded_pivot(),
                refreshed => refreshed.map(|()| None)?,
            };
            if let Some(vertex) = loose {
                models.stiffen(vertex, |k| self.sweep.scale(k));
                self.refresh(models, iteration)?;
            }
            models.stale = false;
        }
        for (&vertex, dropped) in self.energy.vertices.iter().zip(&models.dropped) {
            clear_masked(&mut self.linear.residual[vertex], dropped);
        }
        Ok(())
    }

    fn aim(&mut self, _: &Models<C>, _: &[SVector<f64, C>]) -> Aim {
        let target = self.target();
        let step = match self.linear_step {
            LinearStep::Cycle => self.linear.one_cycle(self.multigrid),
            LinearStep::ConjugateGradients { max_cycles, .. } => {
                let reduction = self.reduction;
                let problem = (&mut *self.multigrid, self.energy.operator);
                (self.linear).conjugate_gradients(problem, reduction, target, max_cycles)
            }
        };
        self.cycles += step.cycles;
        self.linear_error = step.error;
        self.curvature = step.curvature;
        Aim {
            decrease: step.decrease,
            curvature: step.curvature,
        }
    }

    fn direction(&mut self) -> &mut [SVector<f64, C>] {
        &mut self.linear.correction
    }

    /// The residual was reduced by the linear step, so its start is computed anew.
    fn slopes(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> Aim {
        let image = &mut self.linear.image;
        image.copy_from_slice(self.energy.load);
        self.energy.operator.multiply_add(-1.0, v, image);
        for (gradient, &vertex) in models.gradients.iter().zip(self.energy.vertices) {
            image[vertex] -= gradient;
        }
        Aim {
            decrease: dot(image, &self.linear.correction),
            curvature: (self.multigrid).quadratic(self.energy.operator, &self.linear.correction),
        }
    }

    fn advance(&mut self, v: &mut [SVector<f64, C>], length: f64) {
        let fields = v.iter_mut().zip(&mut *self.moved);
        for ((v, moved), correction) in fields.zip(&self.linear.correction) {
            let step = correction * length;
            *v += step;
            *moved -= step;
        }
    }

    fn settled(
        &mut self,
        models: &mut Models<C>,
        v: &mut [SVector<f64, C>],
        step: &Step,
    ) -> Result<Option<f64>, SolveError> {
        if !step.whole {
            return Ok(None);
        }
        let target = self.target();
        let mut left = self.linear_error + self.mismatch(models);
        if left <= target {
            left += self.rounding_error() + self.truncated_error(models, v);
        }
        let error = (self.stopping.equivalence * left).sqrt();
        Ok((left <= target).then_some(error))
    }

    /// An inexact linear step is useless twice.
    fn again(&mut self, _: &Step) -> Option<Aim> {
        None
    }

    fn moved(&mut self, _: &[SVector<f64, C>]) -> f64 {
        let change = self.stopping.norm.norm(self.moved);
        self.tolerance = self.tolerance.max(self.stopping.relative * change);
        let ratio = change / self.previous;
        self.reduction = self.reduction.min((ratio * ratio).max(1e-8));
        self.previous = change;
        change
    }

    fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn equivalence(&self) -> f64 {
        self.stopping.equivalence
    }

    /// Whether the remaining forces, and the changes of truncated components by the next sweep, are at the level of the
    /// rounding errors of their terms.
    fn is_exhausted(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> bool {
        if self.stopping.relative <= 0.0 {
            return false;
        }
        let energy = self.energy;
        let rows = Rows::of(energy.operator);
        let mut frictional = FrictionalVertices::along(energy.vertices);
        (0..v.len()).all(|i| {
            let (mut left, mut terms) = force_and_terms(energy, &rows, i, v);
            let mut dropped = energy.fixed[i];
            let k = frictional.at(i);
            if let Some(k) = k {
                let gradient = energy.potentials.local_model(k, &v[i]).gradient;
                left -= gradient;
                terms += gradient.abs();
                dropped = models.dropped[k];
            }
            let rounding = ROUNDINGS * f64::EPSILON * terms.amax();
            let settled = k.is_none_or(|k| {
                !models.truncated[k] || self.sweep.local_force(energy, k, v) <= rounding
            });
            settled
                && (0..C)
                    .filter(|&c| !dropped[c])
                    .all(|c| left[c].abs() <= rounding)
        })
    }
}
