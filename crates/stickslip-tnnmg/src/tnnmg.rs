//! Truncated nonsmooth Newton multigrid.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use crate::block::without;
use crate::field::{add_scaled, clear_masked, dot, scale_and_add};
use crate::line_search::{Line, search};
use crate::multigrid::{Linearization, Multigrid};
use crate::sweep::Sweep;
use crate::{
    BlockMatrix, Energy, NonsmoothSolver, Operator, Prolongation, SolveError, SolveReport, Stopping,
};

/// How the linear correction of one iteration is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LinearStep {
    /// One multigrid cycle.
    Cycle,
    /// Conjugate gradients, preconditioned by one cycle a step, until the error of the linear
    /// problem has fallen by `reduction` (which is squared as the nonlinear error falls) or lies
    /// below the tolerance; at most `max_cycles`.
    ConjugateGradients {
        /// The factor by which an iteration far from the solution reduces the linear error.
        reduction: f64,
        /// The largest number of cycles in one iteration.
        max_cycles: usize,
    },
}

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
/// The default, conjugate gradients with V(1, 1), needs about as many cycles as V(3, 3) without
/// them, each at a third of the cost.
#[derive(Debug)]
pub struct Tnnmg<const C: usize> {
    linear_step: LinearStep,
    truncation: f64,
    sweep: Sweep<C>,
    multigrid: Multigrid<C>,
    start: Vec<SVector<f64, C>>,
    residual: Vec<SVector<f64, C>>,
    correction: Vec<SVector<f64, C>>,
    preconditioned: Vec<SVector<f64, C>>,
    preconditioned_image: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
    image: Vec<SVector<f64, C>>,
    hessians: Vec<SMatrix<f64, C, C>>,
    gradients: Vec<SVector<f64, C>>,
    truncated: Vec<[bool; C]>,
    /// The multigrid levels belong to `hessians` and `truncated`.
    fresh: bool,
}

/// What the linear step of one iteration leaves behind.
#[derive(Clone, Copy)]
struct Correction {
    /// `d . H d`, which is `d . residual` as well for conjugate gradients.
    curvature: f64,
    /// `d . (residual before)`.
    decrease: f64,
    /// Square of the estimated error of the linear problem, in the norm of `H`.
    error: f64,
    cycles: usize,
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
            start: Vec::new(),
            residual: Vec::new(),
            correction: Vec::new(),
            preconditioned: Vec::new(),
            preconditioned_image: Vec::new(),
            direction: Vec::new(),
            image: Vec::new(),
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
        self.sweep.residual(
            energy.operator,
            &self.start,
            v,
            &mut self.image,
            &mut self.residual,
        );
        for (residual, dropped) in self.residual.iter_mut().zip(self.multigrid.dropped()) {
            clear_masked(residual, dropped);
        }
        Ok(())
    }

    /// Fills `correction` by one cycle.
    fn one_cycle(&mut self) -> Correction {
        self.multigrid
            .cycle(&self.residual, &mut self.correction, &mut self.image);
        Correction {
            curvature: dot(&self.correction, &self.image),
            decrease: dot(&self.correction, &self.residual),
            error: f64::INFINITY,
            cycles: 1,
        }
    }

    /// Fills `correction` by preconditioned conjugate gradients, until the squared error is below
    /// `target` or has fallen by the square of `reduction`.
    fn conjugate_gradients(
        &mut self,
        reduction: f64,
        target: f64,
        max_cycles: usize,
    ) -> Correction {
        // Square of the rate expected of a cycle while no second one has been seen.
        const FIRST_RATE: f64 = 0.1;
        self.correction.fill(SVector::zeros());
        let mut result = Correction {
            curvature: 0.0,
            decrease: 0.0,
            error: 0.0,
            cycles: 0,
        };
        let (mut first, mut previous) = (0.0, 0.0);
        for cycle in 1..=max_cycles {
            self.multigrid.cycle(
                &self.residual,
                &mut self.preconditioned,
                &mut self.preconditioned_image,
            );
            let square = dot(&self.residual, &self.preconditioned);
            result.cycles = cycle;
            // Zero, or so small that its square is, or spoiled: nothing more to gain here.
            if !(square > 0.0 && square.is_finite()) {
                result.error = square;
                break;
            }
            if cycle == 1 {
                first = square;
                self.direction.copy_from_slice(&self.preconditioned);
                self.image.copy_from_slice(&self.preconditioned_image);
            } else {
                let ratio = square / previous;
                scale_and_add(&mut self.direction, ratio, &self.preconditioned);
                scale_and_add(&mut self.image, ratio, &self.preconditioned_image);
            }
            let curvature = dot(&self.direction, &self.image);
            if !(curvature > 0.0 && curvature.is_finite()) {
                result.error = square;
                break;
            }
            let length = square / curvature;
            add_scaled(&mut self.correction, length, &self.direction);
            add_scaled(&mut self.residual, -length, &self.image);
            result.curvature += length * square;
            let rate = if cycle == 1 {
                FIRST_RATE
            } else {
                (square / previous).min(1.0)
            };
            result.error = square * rate;
            previous = square;
            if result.error <= target.max(reduction * reduction * first) {
                break;
            }
        }
        result.decrease = result.curvature;
        result
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
            let correction = &mut self.correction[vertex];
            let kept = potential.keep_smooth(&v[vertex], correction);
            left |= kept != *correction;
            *correction = kept;
        }
        if left {
            // `residual` was reduced by the linear step, so its start is computed anew.
            self.image.copy_from_slice(energy.load);
            energy.operator.multiply_add(-1.0, v, &mut self.image);
            for (gradient, &vertex) in self.gradients.iter().zip(energy.vertices) {
                self.image[vertex] -= gradient;
            }
            step.decrease = dot(&self.image, &self.correction);
            step.curvature = self.multigrid.matrix().quadratic(&self.correction);
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
            let expected = self.gradients[k] + self.hessians[k] * self.correction[vertex];
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

    /// One iteration; returns the linear step and the square of the error it leaves.
    fn iterate<P: ConvexPotential<C>>(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        v: &mut [SVector<f64, C>],
        reduction: f64,
        target: f64,
    ) -> Result<(Correction, f64), SolveError> {
        self.sweep.forward(energy, v);
        self.linearize(energy, v)?;
        let mut step = match self.linear_step {
            LinearStep::Cycle => self.one_cycle(),
            LinearStep::ConjugateGradients { max_cycles, .. } => {
                self.conjugate_gradients(reduction, target, max_cycles)
            }
        };
        let projected = self.project(energy, v, &mut step);
        let line = Line {
            energy,
            from: v,
            along: &self.correction,
            decrease: step.decrease,
            curvature: step.curvature,
            gradients: &self.gradients,
            hessians: &self.hessians,
        };
        let length = search(&line);
        add_scaled(v, length, &self.correction);
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
        for field in [
            &mut self.start,
            &mut self.residual,
            &mut self.correction,
            &mut self.preconditioned,
            &mut self.preconditioned_image,
            &mut self.direction,
            &mut self.image,
        ] {
            field.resize(size, SVector::zeros());
        }
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
        let mut report = SolveReport::default();
        let mut reduction = match self.linear_step {
            LinearStep::Cycle => 0.0,
            LinearStep::ConjugateGradients { reduction, .. } => reduction,
        };
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut tolerance = stopping.tolerance.max(relative);
        let mut previous = f64::INFINITY;
        for iteration in 1..=stopping.max_iterations {
            self.start.copy_from_slice(v);
            let target = (SAFETY * tolerance).powi(2) / stopping.equivalence;
            let (step, left) = self.iterate(energy, v, reduction, target)?;
            let error = (stopping.equivalence * left).sqrt();
            report.iterations = iteration;
            report.cycles += step.cycles;
            if error <= SAFETY * tolerance {
                report.error = error;
                return Ok(report);
            }
            for (start, v) in self.start.iter_mut().zip(&*v) {
                *start = v - *start;
            }
            let change = stopping.norm.norm(&self.start);
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
        }
        Err(SolveError::NotConverged {
            iterations: report.iterations,
            change: previous,
            tolerance: stopping.tolerance,
        })
    }
}

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;
