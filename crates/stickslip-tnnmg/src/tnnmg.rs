//! Truncated nonsmooth Newton multigrid.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use crate::block::without;
use crate::block_matrix::Rows;
use crate::field::{clear_masked, dot};
use crate::line_search::{Line, search};
use crate::linear_step::{Correction, LinearStep, LinearSystem};
use crate::multigrid::{Linearization, Multigrid};
use crate::progress::Progress;
use crate::sweep::Sweep;
use crate::{
    BlockMatrix, Energy, NonsmoothSolver, Operator, Prolongation, SolveError, SolveReport, Stopping,
};

/// Truncated nonsmooth Newton multigrid on a hierarchy of nested meshes.
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
/// It gives up, with [`SolveError::NotConverged`], where thousands of iterations more would be
/// needed: the smoother sees one vertex at a time, and on cells with an aspect ratio of thousands,
/// or where there is no minimum, that leads nowhere. [`Condensed`](crate::Condensed) does not mind
/// the shape of cells.
///
/// The default is conjugate gradients with V(1, 1). On a slipping slider of 83 000 vertices it was
/// measured at 147 ms a time step and 27 cycles; V(2, 2) at 174 ms and 21, V(3, 3) at 202 ms and 19.
#[derive(Debug)]
pub struct Tnnmg<const C: usize> {
    linear_step: LinearStep,
    truncation: f64,
    sweep: Sweep<C>,
    multigrid: Multigrid<C>,
    /// What the sweep took off the iterate; at the end of an iteration, what all of it took.
    moved: Vec<SVector<f64, C>>,
    linear: LinearSystem<C>,
    hessians: Vec<SMatrix<f64, C, C>>,
    gradients: Vec<SVector<f64, C>>,
    truncated: Vec<[bool; C]>,
    /// The multigrid levels belong to `hessians` and `truncated`.
    fresh: bool,
}

impl<const C: usize> Tnnmg<C> {
    /// A solver for the finest of the meshes that `transfers`, coarsest first, connect.
    pub fn new(transfers: &[Prolongation]) -> Self {
        Self {
            linear_step: LinearStep::ConjugateGradients {
                reduction: 1e-2,
                max_cycles: 30,
            },
            truncation: 1e4,
            sweep: Sweep::default(),
            multigrid: Multigrid::new(transfers, 1, 1),
            moved: Vec::new(),
            linear: LinearSystem::default(),
            hessians: Vec::new(),
            gradients: Vec::new(),
            truncated: Vec::new(),
            fresh: false,
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

    /// Truncates, and takes gradient and Hessian of the potentials on what is kept.
    fn linearize<P: ConvexPotential<C>>(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let mut stale = !self.fresh;
        for (k, (potential, &vertex)) in energy.potentials.iter().zip(energy.vertices).enumerate() {
            let model = potential.local_model(&v[vertex]);
            let cap = self.truncation * self.sweep.scale(k);
            // A diagonal bound suffices: the Hessian is positive semidefinite.
            let fixed = &energy.fixed[vertex];
            let bounded = (0..C).all(|c| fixed[c] || model.hessian[(c, c)] <= cap);
            let truncated = std::array::from_fn(|c| !(bounded && model.smooth[c]));
            let hessian = without(&model.hessian, &truncated, &truncated);
            stale |= truncated != self.truncated[k] || hessian != self.hessians[k];
            self.truncated[k] = truncated;
            self.hessians[k] = hessian;
            self.gradients[k] = model.gradient;
            clear_masked(&mut self.gradients[k], &self.truncated[k]);
        }
        // Nothing changes while every vertex sticks.
        if stale {
            self.fresh = false;
            self.multigrid.refresh(
                energy.operator,
                &Linearization {
                    vertices: energy.vertices,
                    hessians: &self.hessians,
                    truncated: &self.truncated,
                },
            )?;
            self.fresh = true;
        }
        for (&vertex, truncated) in energy.vertices.iter().zip(&self.truncated) {
            clear_masked(&mut self.linear.residual[vertex], truncated);
        }
        Ok(())
    }

    /// Brings the correction back to where the second-order model holds; true if it had left.
    fn project<P: ConvexPotential<C>>(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &[SVector<f64, C>],
        step: &mut Correction,
    ) -> bool {
        let mut left = false;
        for ((potential, &vertex), truncated) in energy
            .potentials
            .iter()
            .zip(energy.vertices)
            .zip(&self.truncated)
        {
            if truncated.iter().all(|&truncated| truncated) {
                continue;
            }
            let correction = &mut self.linear.correction[vertex];
            let kept = potential.keep_smooth(&v[vertex], correction);
            left |= kept != *correction;
            *correction = kept;
        }
        if left {
            // `residual` was reduced by the linear step, so its start is computed anew.
            self.linear.image.copy_from_slice(energy.load);
            energy
                .operator
                .multiply_add(-1.0, v, &mut self.linear.image);
            for (gradient, &vertex) in self.gradients.iter().zip(energy.vertices) {
                self.linear.image[vertex] -= gradient;
            }
            step.decrease = dot(&self.linear.image, &self.linear.correction);
            step.curvature = self.multigrid.matrix().quadratic(&self.linear.correction);
        }
        left
    }

    /// Square of the error that the next iteration would find at the frictional vertices, in the
    /// norm of the Newton matrix: what its second-order model missed, measured by local inverses.
    fn mismatch<P: ConvexPotential<C>>(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let mut sum = 0.0;
        for (k, (potential, &vertex)) in energy.potentials.iter().zip(energy.vertices).enumerate() {
            let expected = self.gradients[k] + self.hessians[k] * self.linear.correction[vertex];
            let mut missed = potential.local_model(&v[vertex]).gradient - expected;
            clear_masked(&mut missed, &self.truncated[k]);
            let local = missed.dot(&(self.multigrid.inverse_block(vertex) * missed));
            sum += if local.is_finite() {
                local
            } else {
                f64::INFINITY
            };
        }
        sum
    }

    /// The same for the truncated vertices, which no linear step sees: by how much the next sweep
    /// would move them.
    fn truncated_error<P: ConvexPotential<C>>(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let truncated = self.truncated.iter().enumerate();
        truncated
            .filter(|(_, truncated)| truncated.iter().any(|&truncated| truncated))
            .map(|(k, _)| self.sweep.local_error(energy, k, v))
            .sum()
    }

    /// Whether the forces left over, and what the next sweep would do about truncated components,
    /// are no more than the rounding errors of their terms.
    fn is_rounded<P: ConvexPotential<C>>(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &[SVector<f64, C>],
    ) -> bool {
        const ROUNDINGS: f64 = 16.0;
        let rows = Rows::of(energy.operator);
        let mut frictional = energy.vertices.iter().copied().enumerate().peekable();
        (0..v.len()).all(|i| {
            let mut left = energy.load[i];
            let mut terms = energy.load[i].abs();
            for (j, block) in rows.row(i) {
                left -= block * v[j];
                terms += block.abs() * v[j].abs();
            }
            let mut truncated = [false; C];
            if let Some((k, _)) = frictional.next_if(|&(_, vertex)| vertex == i) {
                let gradient = energy.potentials[k].local_model(&v[i]).gradient;
                left -= gradient;
                terms += gradient.abs();
                truncated = self.truncated[k];
                let rounding = ROUNDINGS * f64::EPSILON * terms.amax();
                let kinked = truncated.iter().any(|&truncated| truncated);
                if kinked && self.sweep.local_force(energy, k, v) > rounding {
                    return false;
                }
            }
            let rounding = ROUNDINGS * f64::EPSILON * terms.amax();
            (0..C)
                .filter(|&c| !energy.fixed[i][c] && !truncated[c])
                .all(|c| left[c].abs() <= rounding)
        })
    }

    /// One iteration; returns the linear step and the square of the error it leaves.
    fn iterate<P: ConvexPotential<C>>(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &mut [SVector<f64, C>],
        reduction: f64,
        target: f64,
    ) -> Result<(Correction, f64), SolveError> {
        self.sweep
            .forward_with_residual(energy, v, &mut self.moved, &mut self.linear.residual);
        self.linearize(energy, v)?;
        let mut step = match self.linear_step {
            LinearStep::Cycle => self.linear.one_cycle(&mut self.multigrid),
            LinearStep::ConjugateGradients { max_cycles, .. } => {
                self.linear
                    .conjugate_gradients(&mut self.multigrid, reduction, target, max_cycles)
            }
        };
        let projected = self.project(energy, v, &mut step);
        let line = Line {
            energy,
            from: v,
            along: &self.linear.correction,
            decrease: step.decrease,
            curvature: step.curvature,
            gradients: &self.gradients,
            hessians: &self.hessians,
        };
        let length = search(&line, None);
        for ((v, moved), correction) in v
            .iter_mut()
            .zip(&mut self.moved)
            .zip(&self.linear.correction)
        {
            let step = correction * length;
            *v += step;
            *moved -= step;
        }
        let left = if projected || length != 1.0 {
            f64::INFINITY
        } else {
            step.error + self.mismatch(energy, v)
        };
        step.curvature *= length * length;
        Ok((step, left))
    }
}

impl<P: ConvexPotential<C>, const C: usize> NonsmoothSolver<BlockMatrix<C>, P, C> for Tnnmg<C> {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, P, C>) -> Result<(), SolveError> {
        self.fresh = false;
        self.sweep.prepare(energy)?;
        self.multigrid
            .prepare(energy.operator, energy.fixed, energy.vertices)?;
        let size = energy.operator.rows();
        self.moved.resize(size, SVector::zeros());
        self.linear.resize(size);
        self.hessians
            .resize(energy.vertices.len(), SMatrix::zeros());
        self.gradients
            .resize(energy.vertices.len(), SVector::zeros());
        self.truncated.resize(energy.vertices.len(), [false; C]);
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.sweep.check(energy, stopping.norm, v)?;
        let mut report = SolveReport::default();
        let mut reduction = match self.linear_step {
            LinearStep::Cycle => 0.0,
            LinearStep::ConjugateGradients { reduction, .. } => reduction,
        };
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut tolerance = stopping.tolerance.max(relative);
        let mut previous = f64::INFINITY;
        let mut progress = Progress::new();
        for iteration in 1..=stopping.max_iterations {
            let target = (SAFETY * tolerance).powi(2) / stopping.equivalence;
            let (step, mut left) = self.iterate(energy, v, reduction, target)?;
            if left <= target {
                left += self.truncated_error(energy, v);
            }
            let error = (stopping.equivalence * left).sqrt();
            report.iterations = iteration;
            report.cycles += step.cycles;
            if left <= target {
                report.error = error;
                return Ok(report);
            }
            let change = stopping.norm.norm(&self.moved);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            tolerance = tolerance.max(stopping.relative * change);
            if change <= tolerance {
                report.error = change;
                return Ok(report);
            }
            let ratio = change / previous;
            reduction = reduction.min((ratio * ratio).max(1e-8));
            previous = change;
            if !progress.goes_on(change, tolerance) {
                if stopping.relative > 0.0 && self.is_rounded(energy, v) {
                    report.error = change;
                    return Ok(report);
                }
                break;
            }
        }
        Err(SolveError::NotConverged {
            iterations: report.iterations,
            change: previous,
            tolerance,
        })
    }
}

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;
