//! The Newton system on the kept unknowns by conjugate gradients, preconditioned by its diagonal blocks.
//!
//! Friction that resists a change of the rate much, as where a contact sticks, makes the diagonal large, and inertia
//! couples near neighbours alone within a step: a few products with the matrix do what a factorisation would.

use nalgebra::SMatrix;

use crate::block::inverse;
use crate::newton::Models;
use crate::walk::Walk;

use super::blocks::Blocks;
use super::kernels::{dot, subtract_product};
use super::unknowns::Unknowns;

/// What an iteration that is cut short may leave of the residual for a step that is still worth taking.
const USEFUL: f64 = 1e-4;

/// The memory of an iteration, on all unknowns; zero on those that are not kept.
#[derive(Debug)]
pub(super) struct Gradients<const C: usize> {
    /// The inverses of the diagonal blocks of the Newton system; zero on what is dropped.
    inverses: Blocks<C>,
    hessians: Blocks<C>,
    pub(super) solution: Vec<f64>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    pub(super) image: Vec<f64>,
}

impl<const C: usize> Gradients<C> {
    pub(super) fn new(unknowns: &Unknowns<C>) -> Self {
        let count = unknowns.count();
        Self {
            inverses: Blocks::new(unknowns),
            hessians: Blocks::new(unknowns),
            solution: vec![0.0; count],
            residual: vec![0.0; count],
            preconditioned: vec![0.0; count],
            direction: vec![0.0; count],
            image: vec![0.0; count],
        }
    }

    /// Takes the diagonal blocks; false if one is not positive definite.
    pub(super) fn prepare(
        &mut self,
        matrix: &[f64],
        unknowns: &Unknowns<C>,
        vertices: &[usize],
        models: &Models<C>,
    ) -> bool {
        let mut frictional = Walk::along(vertices);
        for p in 0..unknowns.vertices() {
            let place = frictional.at(p);
            let hessian = place.map_or(SMatrix::zeros(), |k| models.hessians[k]);
            let dropped: [bool; C] = std::array::from_fn(|c| {
                unknowns.is_fixed(p, c) || place.is_some_and(|k| models.dropped[k][c])
            });
            let block = unknowns.block(matrix, p) + hessian;
            let Some(inverse) = inverse(&block, &dropped) else {
                return false;
            };
            self.inverses.set(unknowns, p, &inverse);
            self.hessians.set(unknowns, p, &hessian);
        }
        true
    }

    /// Solves for the right-hand side `descent` on the kept unknowns until the preconditioned residual has fallen by
    /// `share`, in `limit` products; `image` is then `S solution`. Returns `solution . descent`, or nothing where that
    /// does not lead far enough or the system is not definite.
    pub(super) fn solve(
        &mut self,
        (matrix, unknowns): (&[f64], &Unknowns<C>),
        (kept, descent): (&[u32], &[f64]),
        share: f64,
        limit: usize,
    ) -> Option<f64> {
        self.solution.fill(0.0);
        self.residual.fill(0.0);
        for (&i, &value) in kept.iter().zip(descent) {
            self.residual[i as usize] = value;
        }
        self.inverses
            .multiply(unknowns, &self.residual, &mut self.preconditioned);
        let mut square = dot(&self.residual, &self.preconditioned);
        let [enough, useful] = [share, share.max(USEFUL)].map(|share| share * share * square);
        self.direction.copy_from_slice(&self.preconditioned);
        let mut products = 0;
        while square > enough {
            if products == limit {
                if square <= useful {
                    break;
                }
                return None;
            }
            products += 1;
            self.multiply(matrix, unknowns);
            let curvature = dot(&self.direction, &self.image);
            if !(curvature > 0.0 && curvature.is_finite()) {
                return None;
            }
            let length = square / curvature;
            for ((x, r), (d, image)) in (self.solution.iter_mut().zip(&mut self.residual))
                .zip(self.direction.iter().zip(&self.image))
            {
                *x += length * d;
                *r -= length * image;
            }
            self.inverses
                .multiply(unknowns, &self.residual, &mut self.preconditioned);
            let next = dot(&self.residual, &self.preconditioned);
            let factor = next / square;
            for (d, z) in self.direction.iter_mut().zip(&self.preconditioned) {
                *d = z + factor * *d;
            }
            square = next;
        }
        self.recover(unknowns, (kept, descent));
        let terms = kept.iter().zip(descent);
        Some(terms.map(|(&i, r)| self.solution[i as usize] * r).sum())
    }

    /// `image = S solution` on all unknowns, of what the iteration knows: it has led from `descent` to the residual.
    fn recover(&mut self, unknowns: &Unknowns<C>, (kept, descent): (&[u32], &[f64])) {
        for (image, residual) in self.image.iter_mut().zip(&self.residual) {
            *image = -residual;
        }
        for (&i, &value) in kept.iter().zip(descent) {
            self.image[i as usize] += value;
        }
        self.hessians
            .subtract(unknowns, &self.solution, &mut self.image);
    }

    /// `image = (S + D) direction`, on all unknowns.
    fn multiply(&mut self, matrix: &[f64], unknowns: &Unknowns<C>) {
        self.image.fill(0.0);
        self.hessians
            .subtract(unknowns, &self.direction, &mut self.image);
        subtract_product(matrix, &self.direction, &mut self.image);
        self.image.iter_mut().for_each(|x| *x = -*x);
    }
}
