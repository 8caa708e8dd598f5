//! Truncated nonsmooth Newton with the linear solvers of PETSc.

mod friction;
mod line;

use nalgebra::SVector;
use stickslip::tnnmg::{Counters, Energy, SolveError, SolveReport, Stopping};
use stickslip::{NonsmoothSolver, Operator};

use crate::ffi::Krylov;
use crate::system::krylov;
use crate::world::or_abort;
use crate::{DistributedMatrix, DistributedSpace};
use friction::Friction;
use line::Line;

/// Truncated nonsmooth Newton in several processes.
///
/// One iteration is
///
/// 1. a nonlinear block Gauss-Seidel sweep over the frictional vertices of each process, and a line search over what all
///    of them propose, which neighbours have not seen;
/// 2. truncation to the components near which friction is twice differentiable;
/// 3. PETSc's conjugate gradients for the Newton system on these, preconditioned by a cycle of its algebraic
///    multigrid (GAMG, with the rigid motions of the body) for the operator without friction. It is set up once a step
///    size; truncated components are left out of it, stiff ones are solved for vertex by vertex;
/// 4. projection to where the second-order model holds, and a line search, so that the energy never grows.
///
/// Options of PETSc have the prefix `tnnmg_`: `PETSC_OPTIONS="-tnnmg_pc_gamg_threshold 0.01"`.
#[derive(Debug)]
pub struct PetscTnnmg<const C: usize> {
    points: Vec<f64>,
    truncation: f64,
    krylov: Option<Krylov>,
    friction: Friction<C>,
    residual: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
    image: Vec<SVector<f64, C>>,
    moved: Vec<SVector<f64, C>>,
    load: Vec<f64>,
    solution: Vec<f64>,
    counters: Counters,
}

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;
/// The factor by which the first linear problem is reduced.
const REDUCTION: f64 = 1e-2;
const MOST_CYCLES: usize = 1000;
/// The residual is computed anew after so many updates.
const UPDATES: usize = 8;
/// The steps in a row that a line search may cut before a small change is taken for the last one.
const CUTS: usize = 20;
/// The iterations without a smaller change after which it is given up.
const PATIENCE: usize = 100;

impl<const C: usize> PetscTnnmg<C> {
    /// A solver on a space.
    pub fn new<const D: usize>(space: &DistributedSpace<D>) -> Self {
        Self {
            points: space
                .points()
                .iter()
                .flat_map(|x| x.iter().copied())
                .collect(),
            truncation: 1e4,
            krylov: None,
            friction: Friction::default(),
            residual: Vec::new(),
            direction: Vec::new(),
            image: Vec::new(),
            moved: Vec::new(),
            load: Vec::new(),
            solution: Vec::new(),
            counters: Counters::default(),
        }
    }

    /// Adds a step of a length along the direction whose image is known.
    fn advance(&mut self, v: &mut [SVector<f64, C>], length: f64) {
        for i in 0..v.len() {
            let step = self.direction[i] * length;
            v[i] += step;
            self.moved[i] += step;
            self.residual[i] -= self.image[i] * length;
        }
    }

    /// The length along the direction, and its image; slopes are those of the whole body.
    fn search(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        v: &[SVector<f64, C>],
        sweep: bool,
    ) -> f64 {
        self.image.fill(SVector::zeros());
        energy
            .operator
            .multiply_add(1.0, &self.direction, &mut self.image);
        let line = Line::new(energy, &self.residual, &self.direction, &self.image, v);
        if sweep && energy.operator.layout.world.size() == 1 {
            return 1.0;
        }
        line.length()
    }

    fn balance(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>, v: &[SVector<f64, C>]) {
        self.residual.copy_from_slice(energy.load);
        energy.operator.multiply_add(-1.0, v, &mut self.residual);
    }

    /// Solves the Newton system into the direction; the iterations it took and the error left, or a curvature that is not
    /// positive.
    fn newton(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        (relative, absolute): (f64, f64),
    ) -> Result<(usize, f64), f64> {
        for (i, (to, residual)) in self
            .load
            .chunks_exact_mut(C)
            .zip(&self.residual)
            .enumerate()
        {
            for c in 0..C {
                to[c] = if energy.fixed[i][c] { 0.0 } else { residual[c] };
            }
        }
        self.friction.unload(energy, &mut self.load);
        let Some(krylov) = &mut self.krylov else {
            return Err(f64::NAN);
        };
        if self.friction.take_change() {
            let (masks, blocks) = self.friction.linearization();
            or_abort(krylov.linearize(masks, blocks));
        }
        let tolerances = (relative, absolute);
        let solved = krylov.solve(&self.load, &mut self.solution, tolerances, MOST_CYCLES);
        let Some((cycles, error)) = or_abort(solved) else {
            return Err(f64::NAN);
        };
        for (to, from) in self.direction.iter_mut().zip(self.solution.chunks_exact(C)) {
            *to = SVector::from_column_slice(from);
        }
        if error < 0.0 {
            Err(error)
        } else {
            Ok((cycles, error))
        }
    }
}

impl<const C: usize> NonsmoothSolver<DistributedMatrix<C>, C> for PetscTnnmg<C> {
    fn prepare(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>) -> Result<(), SolveError> {
        energy.check()?;
        self.counters.preparations += 1;
        self.krylov = None;
        let (operator, fixed) = (energy.operator, energy.fixed);
        self.krylov = krylov(operator, fixed, energy.vertices, &self.points);
        self.friction.prepare(energy);
        let size = operator.vertex_count();
        let fields = [&mut self.residual, &mut self.direction, &mut self.image];
        for field in fields.into_iter().chain([&mut self.moved]) {
            field.resize(size, SVector::zeros());
        }
        self.load.resize(C * size, 0.0);
        self.solution.resize(C * size, 0.0);
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        stopping: &Stopping<'_, DistributedMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let operator = energy.operator;
        let mut tolerance = stopping
            .tolerance
            .max(stopping.relative * stopping.norm.norm(v));
        let (mut cycles, mut reduction) = (0, REDUCTION);
        let (mut previous, mut best) = (f64::INFINITY, f64::INFINITY);
        let (mut since, mut cuts) = (0, 0);
        for iteration in 1..=stopping.max_iterations {
            if iteration % UPDATES == 1 {
                self.balance(energy, v);
            }
            self.moved.fill(SVector::zeros());
            self.friction
                .sweep(energy, &self.residual, v, &mut self.direction);
            let length = self.search(energy, v, true);
            self.advance(v, length);

            // Where the models hold for a tiny step alone, the body follows its contact first.
            let ratio = if cuts > 0 { -1.0 } else { self.truncation };
            self.friction.truncate(energy, v, ratio);
            let target = (SAFETY * tolerance).powi(2) / stopping.equivalence;
            let tolerances = (reduction, 0.5 * target.sqrt());
            let (taken, left) = self.newton(energy, tolerances).map_err(|curvature| {
                SolveError::IndefiniteDirection {
                    iteration,
                    curvature,
                }
            })?;
            cycles += taken;
            let projected = self.friction.project(energy, v, &mut self.direction);
            let length = self.search(energy, v, false);
            self.advance(v, length);

            let change = stopping.norm.norm(&self.moved);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            tolerance = tolerance.max(stopping.relative * change);
            let report = |error| SolveReport {
                iterations: iteration,
                cycles,
                error,
            };
            let local = self.friction.local_error(energy, &self.residual, v);
            let local = operator.total(local);
            let whole = length == 1.0 && operator.all(!projected);
            let error = left * left + local;
            if whole && error <= target {
                return Ok(report((stopping.equivalence * error).sqrt()));
            }
            // A line search that cuts a step to nothing says nothing of what is left, unless rounding keeps it there.
            let cut = length < 0.5;
            cuts = if cut { cuts + 1 } else { 0 };
            if change <= tolerance && (!cut || cuts > CUTS) {
                return Ok(report(change));
            }
            since = if change < 0.9 * best { 0 } else { since + 1 };
            if !cut {
                best = best.min(change);
            }
            if since > PATIENCE {
                break;
            }
            let ratio = change / previous;
            reduction = reduction.min((ratio * ratio).max(1e-8));
            previous = change;
        }
        Err(SolveError::NotConverged {
            iterations: stopping.max_iterations,
            change: previous,
            tolerance,
        })
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}
