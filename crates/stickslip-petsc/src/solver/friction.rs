//! Friction at the vertices of this process: sweeps, second-order models, truncation.

use nalgebra::{SMatrix, SVector};
use stickslip::Matrix;
use stickslip::solvers::Energy;

use crate::DistributedMatrix;

/// The models of frictional vertices.
#[derive(Debug, Default)]
pub(super) struct Friction<const C: usize> {
    pub(super) vertices: Vec<usize>,
    blocks: Vec<SMatrix<f64, C, C>>,
    gradients: Vec<SVector<f64, C>>,
    pub(super) dropped: Vec<[bool; C]>,
    pub(super) hessians: Vec<SMatrix<f64, C, C>>,
    /// The diagonal blocks that multigrid adds to the operator, and whether they have changed.
    pub(super) stiffness: Vec<SVector<f64, C>>,
    changed: bool,
    /// Fixed components of all vertices.
    pub(super) held: Vec<(usize, usize)>,
    /// The operator's product with the correction of a linear problem.
    pub(super) products: Vec<SVector<f64, C>>,
}

/// The stiffness of a dropped component for multigrid over the operator's diagonal.
const BLOCKED: f64 = 1e6;
/// The share of the operator's diagonal below which multigrid is not told of friction.
const SLIGHT: f64 = 0.03;

impl<const C: usize> Friction<C> {
    pub(super) fn prepare(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>) {
        let blocks = energy.vertices.iter().map(|&vertex| {
            let (block, fixed) = (
                energy.operator.diagonal_block(vertex),
                &energy.fixed[vertex],
            );
            uncoupled(&block, fixed)
        });
        self.blocks = blocks.collect();
        let count = self.blocks.len();
        self.vertices = energy.vertices.to_vec();
        self.gradients = vec![SVector::zeros(); count];
        self.dropped = vec![[true; C]; count];
        self.hessians = vec![SMatrix::zeros(); count];
        self.stiffness = vec![SVector::zeros(); count];
        self.changed = false;
        self.products = vec![SVector::zeros(); count];
        let fixed = energy.fixed.iter().enumerate();
        let held = fixed.flat_map(|(i, fixed)| (0..C).filter(|&c| fixed[c]).map(move |c| (i, c)));
        self.held = held.collect();
    }

    /// The minimiser over a vertex alone, by the residual at `v`.
    fn minimizer(
        &self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        k: usize,
        residual: &SVector<f64, C>,
        v: &SVector<f64, C>,
    ) -> SVector<f64, C> {
        let fixed = &energy.fixed[energy.vertices[k]];
        let block = &self.blocks[k];
        let mut force = residual + block * v;
        for c in (0..C).filter(|&c| fixed[c]) {
            force[c] = 0.0;
        }
        let minimizer = energy.potentials.minimize(k, block, &force);
        SVector::from_fn(|c, _| if fixed[c] { v[c] } else { minimizer[c] })
    }

    /// A sweep over the frictional vertices of this process, each seeing those before it, as a direction.
    pub(super) fn sweep(
        &self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        residual: &[SVector<f64, C>],
        v: &[SVector<f64, C>],
        direction: &mut [SVector<f64, C>],
    ) {
        direction.fill(SVector::zeros());
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            let mut left = residual[vertex];
            for (j, block) in energy.operator.row(vertex) {
                if j < direction.len() && j != vertex {
                    left -= block * direction[j];
                }
            }
            direction[vertex] = self.minimizer(energy, k, &left, &v[vertex]) - v[vertex];
        }
    }

    /// The square of how far each vertex by itself is from its minimiser, in the norm of its block.
    pub(super) fn local_error(
        &self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        residual: &[SVector<f64, C>],
        v: &[SVector<f64, C>],
    ) -> f64 {
        let vertices = energy.vertices.iter().enumerate();
        vertices
            .map(|(k, &vertex)| {
                let step = self.minimizer(energy, k, &residual[vertex], &v[vertex]) - v[vertex];
                step.dot(&(self.blocks[k] * step))
            })
            .sum()
    }

    /// Second-order models at `v`; components without one, or with a stiffer one than `ratio` times the operator's
    /// diagonal, are dropped.
    pub(super) fn truncate(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        v: &[SVector<f64, C>],
        ratio: f64,
    ) {
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            let model = energy.potentials.local_model(k, &v[vertex]);
            let (fixed, block) = (&energy.fixed[vertex], &self.blocks[k]);
            let scale = block.diagonal().amax();
            // The Hessian is positive semidefinite: its diagonal bounds it.
            let bounded = (0..C).all(|c| fixed[c] || model.hessian[(c, c)] <= ratio * scale);
            let dropped: [bool; C] =
                std::array::from_fn(|c| fixed[c] || !(bounded && model.smooth[c]));
            let hessian = SMatrix::<f64, C, C>::from_fn(|r, c| {
                if dropped[r] || dropped[c] {
                    0.0
                } else {
                    model.hessian[(r, c)]
                }
            });
            self.gradients[k] =
                SVector::from_fn(|c, _| if dropped[c] { 0.0 } else { model.gradient[c] });
            (self.dropped[k], self.hessians[k]) = (dropped, hessian);
            let bound = hessian.trace();
            let stiffness = SVector::from_fn(|c, _| match (fixed[c], dropped[c]) {
                (true, _) => 0.0,
                (false, true) => BLOCKED * block[(c, c)],
                (false, false) => rounded(bound / block[(c, c)]) * block[(c, c)],
            });
            self.changed |= stiffness != self.stiffness[k];
            self.stiffness[k] = stiffness;
        }
    }

    /// Whether stiffnesses have changed since this was asked.
    pub(super) fn take_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Takes the gradients of friction off a residual, and all of it where components are dropped.
    pub(super) fn unload(&mut self, residual: &mut [SVector<f64, C>]) {
        for (k, &vertex) in self.vertices.iter().enumerate() {
            residual[vertex] -= self.gradients[k];
            clear(&mut residual[vertex], &self.dropped[k]);
        }
        self.products.fill(SVector::zeros());
    }

    /// Shortens a correction to where the models hold; whether it was longer.
    pub(super) fn project(
        &self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        v: &[SVector<f64, C>],
        direction: &mut [SVector<f64, C>],
    ) -> bool {
        let mut left = false;
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            let d = &mut direction[vertex];
            if self.dropped[k].iter().all(|&dropped| dropped) {
                *d = SVector::zeros();
                continue;
            }
            let mut kept = energy.potentials.keep_smooth(k, &v[vertex], d);
            for c in (0..C).filter(|&c| self.dropped[k][c]) {
                (kept[c], d[c]) = (0.0, 0.0);
            }
            left |= kept != *d;
            *d = kept;
        }
        left
    }
}

/// The power of 4 next to a ratio, zero for a small one. As a preconditioner sees no difference, it need not change with
/// every Hessian.
fn rounded(ratio: f64) -> f64 {
    if ratio < SLIGHT {
        0.0
    } else {
        4.0_f64.powi((0.5 * ratio.log2()).round() as i32)
    }
}

/// Zero where components are masked.
pub(super) fn clear<const C: usize>(vector: &mut SVector<f64, C>, masked: &[bool; C]) {
    for c in (0..C).filter(|&c| masked[c]) {
        vector[c] = 0.0;
    }
}

/// A block whose masked components are coupled with no other.
fn uncoupled<const C: usize>(block: &SMatrix<f64, C, C>, masked: &[bool; C]) -> SMatrix<f64, C, C> {
    SMatrix::from_fn(|r, c| {
        if r != c && (masked[r] || masked[c]) {
            0.0
        } else {
            block[(r, c)]
        }
    })
}
