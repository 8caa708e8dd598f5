//! A dense quadratic part `y.Sy/2 - g.y` in the nonsmooth Newton method.
//!
//! A factor solves its linear problems, and serves for further steps as long as they shrink fast enough. The length of
//! the next step is then known exactly, and is the estimate of the error.

use std::mem;

use nalgebra::SVector;

use crate::SolveError;
use crate::block::inverse;
use crate::frictional_vertices::FrictionalVertices;
use crate::newton::{Aim, Friction, Models, Step, System};

use super::kernels::subtract;
use super::matrix::DenseMatrix;
use super::workspace::{Goal, Workspace};

/// The share of the tolerance for an estimated error.
pub(super) const SAFETY: f64 = 0.3;
/// The relative error of conjugate gradients in a Newton step, and in an estimate of the next one.
const NEWTON: f64 = 1e-4;
const ESTIMATE: f64 = 0.1;
/// The largest relative change of a slip rate by the next step if no sweep has balanced each vertex.
pub(super) const BALANCED: f64 = 1e-6;
/// The ratio of successive errors, squared, up to which a factor serves for another step.
const REUSE: f64 = 0.01;

/// A dense system during one minimisation.
pub(super) struct DenseSystem<'a, const C: usize> {
    /// `S`
    pub(super) matrix: &'a DenseMatrix,
    pub(super) friction: &'a Friction<'a, C>,
    pub(super) goal: &'a Goal,
    norm: &'a mut dyn FnMut(&[SVector<f64, C>]) -> f64,
    /// The square of the next step, by the last factor.
    left: f64,
    /// The square of the last step.
    before: f64,
    reusable: bool,
    pub(super) iteration: usize,
    /// The decrease of the direction, if that is already known.
    known: Option<f64>,
    /// Whether the Newton system has a factor.
    pub(super) factorized: bool,
    /// Whether `S` times the direction is available.
    pub(super) imaged: bool,
    /// Whether the iteration began with a sweep.
    swept: bool,
    /// Whether conjugate gradients have estimated the direction at the current iterate.
    estimated: bool,
    pub(super) work: &'a mut Workspace<C>,
}

impl<'a, const C: usize> DenseSystem<'a, C> {
    /// The system at `y`; `norm` measures a change of `y` in the stopping norm.
    pub(super) fn new(
        matrix: &'a DenseMatrix,
        friction: &'a Friction<'a, C>,
        goal: &'a Goal,
        norm: &'a mut dyn FnMut(&[SVector<f64, C>]) -> f64,
        work: &'a mut Workspace<C>,
        y: &[SVector<f64, C>],
    ) -> Self {
        let mut system = Self {
            matrix,
            friction,
            goal,
            norm,
            left: 0.0,
            before: f64::INFINITY,
            reusable: false,
            iteration: 0,
            known: None,
            factorized: false,
            imaged: false,
            swept: false,
            estimated: false,
            work,
        };
        system.balance(y);
        system
    }

    /// Recomputes the residual.
    fn balance(&mut self, y: &[SVector<f64, C>]) {
        let Workspace {
            unknowns,
            force,
            residual,
            gradients,
            ..
        } = &mut *self.work;
        let images = gradients.product((self.matrix, unknowns), y);
        for ((residual, force), image) in residual.iter_mut().zip(&*force).zip(images) {
            *residual = force - image;
        }
    }

    /// `residual -= S e_j value`.
    fn subtract(&mut self, j: usize, value: f64) {
        if value != 0.0 {
            let residual = &mut self.work.residual;
            subtract(self.matrix.column(j), value, residual);
        }
    }

    /// The minimiser over one vertex alone; `k` is its position among the frictional ones.
    pub(super) fn minimizer(
        &self,
        y: &[SVector<f64, C>],
        p: usize,
        k: Option<usize>,
    ) -> SVector<f64, C> {
        let unknowns = &self.work.unknowns;
        let block = unknowns.block(self.matrix, p);
        let fixed: [bool; C] = std::array::from_fn(|c| unknowns.is_fixed(p, c));
        let mut moved = y[p];
        let mut force = SVector::zeros();
        for c in (0..C).filter(|&c| fixed[c]) {
            moved[c] = 0.0;
        }
        let own = block * moved;
        for (c, i) in unknowns.free(p) {
            force[c] = self.work.residual[i] + own[c];
        }
        let minimizer = match k {
            Some(k) => self.friction.potentials.minimize(k, &block, &force),
            None => inverse(&block, &fixed).map_or(SVector::repeat(f64::NAN), |inv| inv * force),
        };
        SVector::from_fn(|c, _| if fixed[c] { y[p][c] } else { minimizer[c] })
    }
}

impl<const C: usize> System<C> for DenseSystem<'_, C> {
    fn begin(&mut self, y: &[SVector<f64, C>]) -> bool {
        self.swept = false;
        self.work.start.copy_from_slice(y);
        true
    }

    fn sweep(&mut self, y: &mut [SVector<f64, C>]) {
        self.swept = true;
        self.estimated = false;
        self.work.start.copy_from_slice(y);
        let mut frictional = FrictionalVertices::along(self.friction.vertices);
        for p in 0..y.len() {
            let minimizer = self.minimizer(y, p, frictional.at(p));
            let change = minimizer - y[p];
            y[p] = minimizer;
            for (c, i) in self.work.unknowns.free(p) {
                self.subtract(i, change[c]);
            }
        }
    }

    fn scales(&self) -> impl Fn(usize) -> f64 + Sync {
        let (matrix, vertices, unknowns) =
            (self.matrix, self.friction.vertices, &self.work.unknowns);
        |k| unknowns.scale(matrix, vertices[k])
    }

    fn linearize(&mut self, models: &mut Models<C>, iteration: usize) -> Result<(), SolveError> {
        self.iteration = iteration;
        let Workspace {
            unknowns,
            factor,
            gradients,
            ..
        } = &mut *self.work;
        factor.keep(unknowns, self.friction.vertices, models);
        models.stale = false;
        self.known = None;
        self.factorized = false;
        let estimated = mem::take(&mut self.estimated);
        let (matrix, vertices) = (self.matrix, self.friction.vertices);
        if gradients.prepare(matrix, unknowns, vertices, models) {
            self.known = self.descend(models, NEWTON, estimated);
            if self.known.is_some() {
                return Ok(());
            }
        }
        self.factorize(models)
    }

    /// The direction `d = H^-1 descent`, whose decrease equals its curvature.
    fn aim(&mut self, models: &Models<C>, _: &[SVector<f64, C>]) -> Aim {
        let square = match self.known.take() {
            Some(square) => square,
            None if self.factorized => self.substitute(models),
            // Far from the solution, then, as far as is known.
            None => {
                let square = self.descend(models, ESTIMATE, false);
                self.estimated = square.is_some();
                square.unwrap_or(f64::MAX)
            }
        };
        Aim {
            decrease: square,
            curvature: square,
        }
    }

    fn direction(&mut self) -> &mut [SVector<f64, C>] {
        &mut self.work.direction
    }

    fn slopes(&mut self, models: &Models<C>, _: &[SVector<f64, C>]) -> Aim {
        self.imaged = false;
        let Workspace {
            unknowns,
            descent,
            direction,
            factor,
            ..
        } = &*self.work;
        let at = |i: u32| unknowns.value(direction, i as usize);
        let (mut decrease, mut curvature) = (0.0, 0.0);
        for (&j, descent) in factor.kept.iter().zip(descent) {
            let column = self.matrix.column(j as usize);
            let image: f64 = (factor.kept.iter())
                .map(|&i| column[i as usize] * at(i))
                .sum();
            decrease += at(j) * descent;
            curvature += at(j) * image;
        }
        for (&p, hessian) in self.friction.vertices.iter().zip(&models.hessians) {
            curvature += direction[p].dot(&(hessian * direction[p]));
        }
        Aim {
            decrease,
            curvature,
        }
    }

    fn advance(&mut self, y: &mut [SVector<f64, C>], length: f64) {
        self.estimated = false;
        let mut moved = false;
        for (y, d) in y.iter_mut().zip(&self.work.direction) {
            let step = d * length;
            moved |= step.iter().any(|&step| step != 0.0);
            *y += step;
        }
        if !moved {
            return;
        }
        if !self.imaged {
            return self.balance(y);
        }
        let Workspace {
            residual,
            gradients,
            ..
        } = &mut *self.work;
        for (residual, image) in residual.iter_mut().zip(&gradients.image) {
            *residual -= length * image;
        }
    }

    fn settled(
        &mut self,
        models: &mut Models<C>,
        y: &mut [SVector<f64, C>],
        step: &Step,
    ) -> Result<Option<f64>, SolveError> {
        mem::swap(&mut models.gradients, &mut models.ahead);
        if let Some(change) = self.far_below_goal(models, y, step) {
            return Ok(Some(change));
        }
        self.left = self.aim(models, y).decrease;
        if !(self.left + step.taken).is_finite() {
            return Err(SolveError::NotFinite {
                iteration: self.iteration,
                change: step.taken.sqrt(),
            });
        }
        let ahead = self.sweep_ahead(models, y);
        let shrinking = self.left <= 0.25 * step.taken;
        // A chord step with the ratio q leaves 1/(1 - q) of what the next one would take.
        let next = if shrinking {
            4.0 * self.left
        } else {
            self.left.max(step.taken)
        };
        let mut change = (self.goal.equivalence.min(f64::MAX) * (next + ahead)).sqrt();
        if step.whole && self.goal.equivalence.is_infinite() && change > 0.0 {
            let safety = (next + ahead) / (self.left + ahead);
            change = safety.sqrt() * (self.norm)(&self.work.direction);
        }
        let near = step.whole && self.is_balanced(y, BALANCED);
        let balanced = if step.whole {
            self.swept || near
        } else {
            // Rounding alone shortened it.
            !self.swept && self.is_balanced(y, BALANCED.powi(2))
        };
        if balanced && change <= SAFETY * self.goal.tolerance {
            if near {
                // A tenth of the error is left for nothing: what the estimate took for the next step is one.
                for (y, d) in y.iter_mut().zip(&self.work.direction) {
                    *y += d;
                }
            }
            return Ok(Some(change));
        }
        // Far from the rounding errors a step is far shorter than the one before.
        let stalled = !shrinking || step.taken > 0.25 * self.before;
        self.before = step.taken;
        if step.whole && stalled && self.goal.rounding && self.is_rounded(models, y) {
            return Ok(Some((self.norm)(&self.work.direction)));
        }
        self.reusable =
            self.swept && step.whole && self.left <= REUSE * step.taken && ahead <= self.left;
        if self.reusable {
            // Truncated components are the next sweep's.
            for (k, &p) in self.friction.vertices.iter().enumerate() {
                if models.truncated[k] {
                    for c in (0..C).filter(|&c| models.dropped[k][c]) {
                        self.work.direction[p][c] = 0.0;
                    }
                }
            }
        }
        Ok(None)
    }

    fn again(&mut self, _: &Step) -> Option<Aim> {
        self.reusable.then_some(Aim {
            decrease: self.left,
            curvature: self.left,
        })
    }

    fn moved(&mut self, y: &[SVector<f64, C>]) -> f64 {
        let Workspace {
            start, direction, ..
        } = &mut *self.work;
        for ((direction, y), start) in direction.iter_mut().zip(y).zip(start) {
            *direction = y - *start;
        }
        if self.goal.equivalence.is_finite() {
            (self.goal.equivalence * self.energy_square(&self.work.direction)).sqrt()
        } else {
            (self.norm)(&self.work.direction)
        }
    }

    fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    fn equivalence(&self) -> f64 {
        self.goal.equivalence
    }
}
