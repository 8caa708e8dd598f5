//! Truncated nonsmooth Newton with the multigrid of PETSc.

mod friction;
mod line;
mod linearization;

use nalgebra::SVector;
use stickslip::solvers::{Basis, Counters, Energy, SolveError, SolveReport, Stopping};
use stickslip::{Matrix, NonsmoothSolver};

use crate::ffi::Multigrid;
use crate::gradients::{End, Gradients};
use crate::system::Shape;
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
/// 3. conjugate gradients for the Newton system on these, preconditioned by a V(1, 1) cycle of PETSc's multigrid for
///    the operator without friction. Its levels are the meshes that were refined; on the coarsest one there is a factor
///    where it has no more than 1000 unknowns, and PETSc's algebraic multigrid (GAMG, with the rigid motions of the body)
///    elsewhere, so also for a mesh that was not refined. A fault inside the body, or a surface along no axis, leaves
///    GAMG without a near nullspace. Levels are set up once a step size. Truncation enters all levels
///    through the diagonal entries of frictional vertices;
/// 4. projection to where the second-order model holds, and a line search, so that the energy never grows.
///
/// Options of PETSc have the prefix `tnnmg_`: `PETSC_OPTIONS="-tnnmg_mg_levels_ksp_max_it 2"` for V(2, 2). A cycle on
/// GAMG's levels takes some three times as long as one on those of the mesh.
#[derive(Debug)]
pub struct PetscTnnmg<const C: usize> {
    shape: Shape<C>,
    truncation: f64,
    multigrid: Option<Multigrid<C>>,
    friction: Friction<C>,
    /// The frictional vertices, then the others whose rows have entries at such.
    near: Vec<usize>,
    near_image: Vec<SVector<f64, C>>,
    residual: Vec<SVector<f64, C>>,
    moved: Vec<SVector<f64, C>>,
    gradients: Gradients<C>,
    counters: Counters,
}

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;
/// The share of a squared error that is left to the linear problem.
const SHARE: f64 = 0.25;
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
            shape: Shape::of(space),
            truncation: 1e4,
            multigrid: None,
            friction: Friction::default(),
            near: Vec::new(),
            near_image: Vec::new(),
            residual: Vec::new(),
            moved: Vec::new(),
            gradients: Gradients::default(),
            counters: Counters::default(),
        }
    }

    fn balance(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>, v: &[SVector<f64, C>]) {
        self.residual.copy_from_slice(energy.load);
        energy.operator.multiply_add(-1.0, v, &mut self.residual);
    }

    /// A sweep over the frictional vertices and a line search over what all processes propose.
    fn sweep(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>, v: &mut [SVector<f64, C>]) {
        let Self {
            friction,
            near,
            near_image,
            residual,
            moved,
            gradients,
            ..
        } = self;
        let direction = &mut gradients.correction;
        friction.sweep(energy, residual, v, direction);
        energy.operator.products_at(near, direction, near_image);
        let vertices = energy.vertices.iter().zip(&*near_image);
        let sums = vertices.map(|(&i, image)| products(&direction[i], &residual[i], image));
        let sums = sums.fold([0.0; 3], add);
        let line = Line::new(energy, direction, v, sums);
        let alone = energy.operator.layout.world.size() == 1;
        let length = if alone { 1.0 } else { line.length() };
        for &vertex in energy.vertices {
            let step = direction[vertex] * length;
            v[vertex] += step;
            moved[vertex] += step;
        }
        for (&vertex, image) in near.iter().zip(&*near_image) {
            residual[vertex] -= image * length;
        }
    }

    /// Solves the Newton system into the correction, and leaves its image in the place of the residual.
    fn newton(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        goal: (f64, f64),
    ) -> Result<End, f64> {
        let Some(multigrid) = &mut self.multigrid else {
            return Err(f64::NAN);
        };
        let (gradients, friction) = (&mut self.gradients, &mut self.friction);
        if !energy.operator.ranks().all(!friction.take_change()) {
            or_abort(multigrid.stiffen(&friction.stiffness));
        }
        gradients.residual.copy_from_slice(&self.residual);
        friction.unload(&mut gradients.residual);
        let end = gradients.solve(energy.operator, multigrid, friction, goal, MOST_CYCLES)?;
        for (left, residual) in gradients.residual.iter_mut().zip(&self.residual) {
            *left = residual - *left;
        }
        for (&vertex, product) in friction.vertices.iter().zip(&friction.products) {
            gradients.residual[vertex] = *product;
        }
        Ok(end)
    }

    /// Takes the correction to where the models hold, as far as the energy falls: whether all of it was taken, and the
    /// length.
    fn follow(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
    ) -> (bool, f64) {
        let (direction, image) = (&mut self.gradients.correction, &mut self.gradients.residual);
        let projected = self.friction.project(energy, v, direction);
        let whole = energy.operator.ranks().all(!projected);
        if !whole {
            image.fill(SVector::zeros());
            energy.operator.multiply_add(1.0, direction, image);
        }
        let vertices = direction.iter().zip(&self.residual).zip(&*image);
        let sums =
            vertices.map(|((direction, residual), image)| products(direction, residual, image));
        let length = Line::new(energy, direction, v, sums.fold([0.0; 3], add)).length();
        for i in 0..v.len() {
            let step = direction[i] * length;
            v[i] += step;
            self.moved[i] += step;
            self.residual[i] -= image[i] * length;
        }
        (whole && length == 1.0, length)
    }
}

/// `d . r`, its size, and `d . B d`.
fn products<const C: usize>(
    direction: &SVector<f64, C>,
    residual: &SVector<f64, C>,
    image: &SVector<f64, C>,
) -> [f64; 3] {
    let along = direction.dot(residual);
    [along, along.abs(), direction.dot(image)]
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

impl<const C: usize> NonsmoothSolver<DistributedMatrix<C>, C> for PetscTnnmg<C> {
    fn prepare(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>) -> Result<(), SolveError> {
        energy.check()?;
        self.counters.preparations += 1;
        let (operator, fixed) = (energy.operator, energy.fixed);
        self.multigrid = None;
        self.multigrid = self.shape.multigrid(operator, fixed, energy.vertices);
        self.friction.prepare(energy);
        self.near = operator.rows_near(energy.vertices);
        self.near_image.resize(self.near.len(), SVector::zeros());
        let size = operator.vertex_count();
        self.residual.resize(size, SVector::zeros());
        self.moved.resize(size, SVector::zeros());
        self.gradients.resize(size);
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
            self.sweep(energy, v);
            // Where the models hold for a tiny step alone, the body follows its contact first.
            let ratio = if cuts > 0 { -1.0 } else { self.truncation };
            self.friction.truncate(energy, v, ratio);
            let target = (SAFETY * tolerance).powi(2) / stopping.equivalence;
            let goal = (reduction, SHARE * target);
            let end =
                self.newton(energy, goal)
                    .map_err(|curvature| SolveError::IndefiniteDirection {
                        iteration,
                        curvature,
                    })?;
            cycles += end.cycles;
            let (whole, length) = self.follow(energy, v);
            let report = |error| SolveReport {
                iterations: iteration,
                cycles,
                error,
            };
            if whole {
                let local = self.friction.local_error(energy, &self.residual, v);
                let error = end.error + operator.ranks().sum(local);
                if error <= target {
                    return Ok(report((stopping.equivalence * error).sqrt()));
                }
            }
            let change = stopping.norm.norm(&self.moved);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            tolerance = tolerance.max(stopping.relative * change);
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

    fn change_basis(&mut self, basis: &Basis<C>) {
        self.shape.change_basis(basis);
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}
