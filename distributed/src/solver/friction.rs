//! Friction at the vertices of this process: sweeps, second-order models, truncation.

use nalgebra::{SMatrix, SVector};
use stickslip::Operator;
use stickslip::tnnmg::Energy;

use crate::DistributedMatrix;

/// The models of frictional vertices, and what PETSc is to know of them.
#[derive(Debug, Default)]
pub(super) struct Friction<const C: usize> {
    blocks: Vec<SMatrix<f64, C, C>>,
    gradients: Vec<SVector<f64, C>>,
    dropped: Vec<[bool; C]>,
    hessians: Vec<f64>,
    inverses: Vec<f64>,
    kept: Vec<f64>,
    smooth: Vec<f64>,
    changed: bool,
}

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
        self.gradients = vec![SVector::zeros(); count];
        self.dropped = vec![[true; C]; count];
        self.hessians = vec![0.0; C * C * count];
        self.inverses = vec![0.0; C * C * count];
        let free = energy.fixed.iter().flatten();
        self.kept = free.map(|&fixed| f64::from(u8::from(!fixed))).collect();
        self.smooth = self.kept.clone();
        for &vertex in energy.vertices {
            for c in C * vertex..C * (vertex + 1) {
                (self.kept[c], self.smooth[c]) = (0.0, 0.0);
            }
        }
        self.changed = true;
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

    /// Second-order models at `v`; components in which there are none, or stiffer ones than `ratio` times the operator's
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
            let range = C * C * k..C * C * (k + 1);
            let same = self.hessians[range.clone()] == *hessian.as_slice();
            if dropped == self.dropped[k] && same {
                continue;
            }
            (self.dropped[k], self.changed) = (dropped, true);
            self.hessians[range.clone()].copy_from_slice(hessian.as_slice());
            // What friction makes much stiffer than the operator is beyond a preconditioner for the operator.
            let stiff = (0..C).any(|c| hessian[(c, c)] > block[(c, c)]);
            let whole = uncoupled(&(block + hessian), &dropped);
            let inverse = whole.try_inverse().filter(|_| stiff);
            let mut inverse = inverse.unwrap_or_else(SMatrix::zeros);
            for c in 0..C {
                if dropped[c] {
                    inverse[(c, c)] = 0.0;
                }
                let kept = f64::from(u8::from(!dropped[c]));
                self.kept[C * vertex + c] = kept;
                self.smooth[C * vertex + c] = if stiff { 0.0 } else { kept };
            }
            self.inverses[range].copy_from_slice(inverse.as_slice());
        }
    }

    /// Whether the linearisation has changed since this was asked.
    pub(super) fn take_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// What is kept and where multigrid acts; Hessians and local inverses.
    pub(super) fn linearization(&self) -> ([&[f64]; 2], [&[f64]; 2]) {
        ([&self.kept, &self.smooth], [&self.hessians, &self.inverses])
    }

    /// Takes the gradients of friction off a residual, and all of it where components are dropped.
    pub(super) fn unload(&self, energy: &Energy<'_, DistributedMatrix<C>, C>, load: &mut [f64]) {
        for (k, &vertex) in energy.vertices.iter().enumerate() {
            for c in 0..C {
                let value = &mut load[C * vertex + c];
                *value = if self.dropped[k][c] {
                    0.0
                } else {
                    *value - self.gradients[k][c]
                };
            }
        }
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
