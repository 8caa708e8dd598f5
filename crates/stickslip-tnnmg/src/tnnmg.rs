//! Truncated nonsmooth Newton multigrid.

use nalgebra::SVector;

use crate::block_matrix::Rows;
use crate::field::{clear_masked, dot};
use crate::linear_step::{LinearStep, LinearSystem};
use crate::multigrid::{Linearization, Multigrid};
use crate::newton::{self, Aim, Ending, Friction, Models, Step, System};
use crate::sweep::Sweep;
use crate::walk::Walk;
use crate::{
    BlockMatrix, Counters, Energy, Frames, NonsmoothSolver, Operator, SolveError, SolveReport,
    Stopping, Transfers,
};

/// Truncated nonsmooth Newton multigrid on a hierarchy of levels.
///
/// One iteration on `v`:
///
/// 1. a nonlinear block Gauss-Seidel sweep, each local problem solved exactly;
/// 2. truncation: the components near which the potentials are twice differentiable, with a
///    curvature below `truncation` times the operator's diagonal, stay unknowns;
/// 3. a linear multigrid step for the Newton system on these, see [`LinearStep`];
/// 4. projection of the correction to where the second-order model holds;
/// 5. a line search, so that the energy never grows.
///
/// The first part alone converges, so the whole does from every start; near the solution it is as
/// fast as linear multigrid. See C. Gräser, O. Sander, "Truncated nonsmooth Newton multigrid
/// methods for block-separable minimization problems", IMA J. Numer. Anal. 39 (2019).
///
/// Cells may be stretched: from an aspect ratio of about 2.5 on, the cycle smooths along them, over the lines
/// or planes of vertices that they couple strongly. On cells of 1e4 : 1 a problem takes no more cycles than on
/// squares. Poisson's ratios near one half cost cycles, some 400 at 0.4999 on a slider of 1400 vertices, since
/// coarse meshes of linear elements are the stiffer the less they can be compressed.
///
/// The levels are nested meshes, or, below a mesh that no coarser one underlies, some of its vertices: auxiliary
/// levels, which were measured to take the same numbers of cycles. A cycle takes about 1.2 times as long in the plane
/// and 1.6 times in space, since coarse vertices have more neighbours. On such meshes, too, a problem is faster for
/// [`Condensed`](crate::Condensed) in the plane, at 24 000 vertices by a factor of 4 to 7; in space from some 8000
/// vertices on, and with thousands of frictional vertices, multigrid is as fast or faster on a body that slides, and
/// is prepared in a thirtieth of the time.
///
/// It gives up, with [`SolveError::NotConverged`], where thousands of iterations more would be needed, or where
/// there is no minimum. [`Condensed`](crate::Condensed) minds neither shapes nor materials.
///
/// The default is conjugate gradients with V(1, 1). On a slipping slider of 83 000 vertices it was
/// measured at 147 ms a time step and 27 cycles; V(2, 2) at 174 ms and 21, V(3, 3) at 202 ms and 19.
#[derive(Debug)]
pub struct Tnnmg<const C: usize> {
    linear_step: LinearStep,
    truncation: f64,
    sweep: Sweep<C>,
    multigrid: Multigrid<C>,
    linear: LinearSystem<C>,
    models: Models<C>,
    /// What the sweep took off the iterate; at the end of an iteration, what all of it took.
    moved: Vec<SVector<f64, C>>,
    /// The operator does not resist a translation: whatever holds the body is friction.
    unsupported: bool,
    counters: Counters,
}

impl<const C: usize> Tnnmg<C> {
    /// A solver for the finest of the levels that `transfers` connect: those of nested meshes, or auxiliary ones below
    /// a mesh that is the finest itself.
    pub fn new(transfers: impl Into<Transfers>) -> Self {
        let transfers = transfers.into();
        Self {
            linear_step: LinearStep::ConjugateGradients {
                reduction: 1e-2,
                max_cycles: 1000,
            },
            truncation: 1e4,
            sweep: Sweep::default(),
            multigrid: Multigrid::new(&transfers, 1, 1),
            linear: LinearSystem::default(),
            models: Models::default(),
            moved: Vec::new(),
            unsupported: false,
            counters: Counters::default(),
        }
    }

    /// Sets the number of smoothing sweeps before and after the coarse correction.
    #[must_use]
    pub fn with_cycle(mut self, pre: usize, post: usize) -> Self {
        (self.multigrid.pre, self.multigrid.post) = (pre, post);
        self
    }

    /// Sets the linear step.
    #[must_use]
    pub fn with_linear_step(mut self, linear_step: LinearStep) -> Self {
        self.linear_step = linear_step;
        self
    }

    /// Sets the curvature, relative to the operator's diagonal block, from which a component is
    /// left to the sweep alone. The default is `1e4`; convergence hardly depends on it.
    #[must_use]
    pub fn with_truncation(mut self, ratio: f64) -> Self {
        self.truncation = ratio;
        self
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Tnnmg<C> {
    fn turn(&mut self, frames: &Frames<C>) {
        self.multigrid.turn(frames);
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        self.counters.preparations += 1;
        self.models.resize(energy.vertices.len());
        self.sweep.prepare(energy)?;
        self.multigrid
            .prepare(energy.operator, energy.fixed, energy.vertices)?;
        let size = energy.operator.rows();
        self.moved.resize(size, SVector::zeros());
        let frames = self.multigrid.frames();
        let (directions, count) = frames.free_translations(energy.fixed);
        self.unsupported = (directions[..count].iter())
            .any(|direction| frames.moves_freely(energy.operator, direction, &mut self.moved));
        self.linear.resize(size);
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.sweep.check(energy, stopping.norm, v)?;
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut system = SparseSystem {
            energy,
            stopping,
            linear_step: self.linear_step,
            reduction: match self.linear_step {
                LinearStep::Cycle => 0.0,
                LinearStep::ConjugateGradients { reduction, .. } => reduction,
            },
            tolerance: stopping.tolerance.max(relative),
            previous: f64::INFINITY,
            cycles: 0,
            linear_error: 0.0,
            sweep: &self.sweep,
            multigrid: &mut self.multigrid,
            linear: &mut self.linear,
            moved: &mut self.moved,
            unsupported: self.unsupported,
        };
        let friction = Friction {
            potentials: energy.potentials,
            vertices: energy.vertices,
            fixed: energy.fixed,
        };
        let (models, limit) = (&mut self.models, stopping.max_iterations);
        let ending = newton::minimize(&mut system, models, &friction, self.truncation, limit, v);
        let cycles = system.cycles;
        let Ending { iterations, error } = ending?;
        Ok(SolveReport {
            iterations,
            cycles,
            error,
        })
    }

    fn mesh(&self) -> Option<u64> {
        self.multigrid.mesh
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}

/// A sparse quadratic part during one minimisation.
struct SparseSystem<'a, const C: usize> {
    energy: &'a Energy<'a, BlockMatrix<C>, C>,
    stopping: &'a Stopping<'a, BlockMatrix<C>>,
    linear_step: LinearStep,
    /// The factor by which the next linear step reduces its error.
    reduction: f64,
    tolerance: f64,
    /// The change of the last iteration.
    previous: f64,
    cycles: usize,
    /// Square of the error of the last linear step, in the norm of the Newton matrix.
    linear_error: f64,
    sweep: &'a Sweep<C>,
    multigrid: &'a mut Multigrid<C>,
    linear: &'a mut LinearSystem<C>,
    moved: &'a mut Vec<SVector<f64, C>>,
    unsupported: bool,
}

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;
/// The roundings of its terms that a residual may have.
const ROUNDINGS: f64 = 16.0;

impl<const C: usize> SparseSystem<'_, C> {
    /// Brings the levels up to date with the models.
    fn refresh(&mut self, models: &Models<C>) -> Result<(), SolveError> {
        let linearization = Linearization {
            vertices: self.energy.vertices,
            hessians: &models.hessians,
            dropped: &models.dropped,
        };
        (self.multigrid).refresh(self.energy.operator, &linearization)
    }

    /// The square of the error, in the norm of the operator, that is small enough.
    fn target(&self) -> f64 {
        (SAFETY * self.tolerance).powi(2) / self.stopping.equivalence
    }

    /// Square of the error that the next iteration would find at the frictional vertices, in the
    /// norm of the Newton matrix: what its second-order model missed, measured by local inverses.
    fn mismatch(&self, models: &Models<C>) -> f64 {
        let vertices = self.energy.vertices.iter().enumerate();
        vertices
            .map(|(k, &vertex)| {
                let expected =
                    models.gradients[k] + models.hessians[k] * self.linear.correction[vertex];
                let mut missed = models.ahead[k] - expected;
                clear_masked(&mut missed, &models.dropped[k]);
                let local = missed.dot(&(self.multigrid.inverse_block(vertex) * missed));
                if local.is_finite() {
                    local
                } else {
                    f64::INFINITY
                }
            })
            .sum()
    }

    /// The same for the truncated vertices, which no linear step sees: by how much the next sweep
    /// would move them.
    fn truncated_error(&self, models: &Models<C>, v: &[SVector<f64, C>]) -> f64 {
        let truncated = models.truncated.iter().enumerate();
        truncated
            .filter(|&(_, &truncated)| truncated)
            .map(|(k, _)| self.sweep.local_error(self.energy, k, v))
            .sum()
    }
}

impl<const C: usize> System<C> for SparseSystem<'_, C> {
    /// Each vertex was balanced in its turn: what is missing after the sweep is the descent.
    fn sweep(&mut self, v: &mut [SVector<f64, C>]) {
        let residual = &mut self.linear.residual;
        (self.sweep).forward_with_residual(self.energy, v, self.moved, residual);
    }

    fn scale(&self, k: usize) -> f64 {
        self.sweep.scale(k)
    }

    fn linearize(&mut self, models: &mut Models<C>, _: usize) -> Result<(), SolveError> {
        // Nothing changes while every vertex sticks.
        if models.stale {
            let loose = match self.refresh(models) {
                Err(SolveError::Unsupported { vertex }) => Some(vertex),
                Ok(()) if self.unsupported => self.multigrid.rounded_pivot(),
                refreshed => refreshed.map(|()| None)?,
            };
            if let Some(vertex) = loose {
                models.stiffen(vertex, |k| self.sweep.scale(k));
                self.refresh(models)?;
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
                (self.linear).conjugate_gradients(self.multigrid, reduction, target, max_cycles)
            }
        };
        self.cycles += step.cycles;
        self.linear_error = step.error;
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
            curvature: self.multigrid.matrix().quadratic(&self.linear.correction),
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
        v: &[SVector<f64, C>],
        step: &Step,
    ) -> Result<Option<f64>, SolveError> {
        if !step.whole {
            return Ok(None);
        }
        let target = self.target();
        let mut left = self.linear_error + self.mismatch(models);
        if left <= target {
            left += self.truncated_error(models, v);
        }
        let error = (self.stopping.equivalence * left).sqrt();
        Ok((left <= target).then_some(error))
    }

    /// A linear step that is solved for roughly is of no use twice.
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

    /// Whether the forces left over, and what the next sweep would do about truncated components,
    /// are no more than the rounding errors of their terms.
    fn is_exhausted(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> bool {
        if self.stopping.relative <= 0.0 {
            return false;
        }
        let energy = self.energy;
        let rows = Rows::of(energy.operator);
        let mut frictional = Walk::along(energy.vertices);
        (0..v.len()).all(|i| {
            let mut left = energy.load[i];
            let mut terms = energy.load[i].abs();
            for (j, block) in rows.row(i) {
                left -= block * v[j];
                terms += block.abs() * v[j].abs();
            }
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
