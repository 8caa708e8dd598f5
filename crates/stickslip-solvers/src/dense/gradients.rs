//! The Newton system on the kept unknowns by conjugate gradients, preconditioned by its diagonal blocks.
//!
//! Friction that resists a change of the rate strongly, as in a sticking contact, makes the diagonal large. Inertia
//! couples only near neighbours within a step. A few products with the matrix then replace a factorisation.

use nalgebra::{SMatrix, SVector};

use crate::block::inverse;
use crate::frictional_vertices::FrictionalVertices;
use crate::newton::Models;

use super::blocks::Blocks;
use super::kernels::dot;
use super::matrix::DenseMatrix;
use super::unknowns::Unknowns;
use crate::packed_symmetric::PackedSymmetric;

/// The largest relative error of an interrupted iteration for a step that is still useful.
const USEFUL: f64 = 1e-4;

/// The memory of an iteration on all unknowns; zero on those that are not kept, and in the padding.
#[derive(Debug)]
pub(super) struct Gradients<const C: usize> {
    /// The inverses of the diagonal blocks of the Newton system; zero on dropped unknowns.
    inverses: Blocks<C>,
    hessians: Blocks<C>,
    pub(super) solution: Vec<f64>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    pub(super) image: Vec<f64>,
    /// The longest step since the last start from zero.
    longest: f64,
    /// The number of products with the matrix.
    pub(super) products: usize,
}

impl<const C: usize> Gradients<C> {
    pub(super) fn new(unknowns: &Unknowns<C>) -> Self {
        let count = PackedSymmetric::padded(unknowns.count());
        Self {
            inverses: Blocks::new(unknowns),
            hessians: Blocks::new(unknowns),
            solution: vec![0.0; count],
            residual: vec![0.0; count],
            preconditioned: vec![0.0; count],
            direction: vec![0.0; count],
            image: vec![0.0; count],
            longest: 0.0,
            products: 0,
        }
    }

    /// Takes the diagonal blocks; false if one is not positive definite.
    pub(super) fn prepare(
        &mut self,
        matrix: &DenseMatrix,
        unknowns: &Unknowns<C>,
        vertices: &[usize],
        models: &Models<C>,
    ) -> bool {
        let mut frictional = FrictionalVertices::along(vertices);
        if let (Some(inverses), Some(hessians)) =
            (self.inverses.diagonal_mut(), self.hessians.diagonal_mut())
        {
            for (i, &(p, c)) in unknowns.owners().iter().enumerate() {
                let (place, c) = (frictional.at(p as usize), c as usize);
                let hessian = place.map_or(0.0, |k| models.hessians[k][(c, c)]);
                let dropped = place.is_some_and(|k| models.dropped[k][c]);
                let entry = matrix.column(i)[i] + hessian;
                if !(dropped || entry > 0.0) {
                    return false;
                }
                inverses[i] = if dropped { 0.0 } else { entry.recip() };
                hessians[i] = hessian;
            }
            return true;
        }
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
            self.inverses.set(p, &inverse);
            self.hessians.set(p, &hessian);
        }
        true
    }

    /// Solves for the right-hand side `descent` on the kept unknowns until the relative error is `share` in the energy
    /// norm, within `limit` products; `image` is then `S solution`. Goes `on` from the last solution, or starts from
    /// zero. Returns `solution . descent`; `None` without convergence, or if the system is not definite.
    pub(super) fn solve(
        &mut self,
        (matrix, unknowns): (&DenseMatrix, &Unknowns<C>),
        (kept, descent): (&[u32], &[f64]),
        share: f64,
        limit: usize,
        on: bool,
    ) -> Option<f64> {
        self.take((kept, descent));
        // The square of the solution in the energy norm.
        let mut reached = if on {
            dot(&self.residual, &self.solution)
        } else {
            0.0
        };
        if reached > 0.0 {
            for (residual, image) in self.residual.iter_mut().zip(&self.image) {
                *residual -= image;
            }
            self.hessians
                .subtract(unknowns, &self.solution, &mut self.residual);
        } else {
            self.solution.fill(0.0);
            (reached, self.longest) = (0.0, 0.0);
        }
        self.inverses
            .multiply(unknowns, &self.residual, &mut self.preconditioned);
        let mut square = dot(&self.residual, &self.preconditioned);
        self.direction.copy_from_slice(&self.preconditioned);
        let mut products = 0;
        // The next step, if it were as long as the longest one, says how far the solution is.
        let left = |longest: f64, square: f64, share: f64, reached: f64| {
            square > 0.0 && (reached == 0.0 || longest * square > share * share * reached)
        };
        while left(self.longest, square, share, reached) {
            if products == limit {
                if !left(self.longest, square, share.max(USEFUL), reached) {
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
            reached += length * square;
            self.longest = length.max(self.longest);
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

    /// Starts with a right-hand side on the kept unknowns.
    fn take(&mut self, (kept, descent): (&[u32], &[f64])) {
        self.residual.fill(0.0);
        for (&i, &value) in kept.iter().zip(descent) {
            self.residual[i as usize] = value;
        }
    }

    /// The first correction for the right-hand side `descent`, at the longest step of the iteration so far: its square
    /// in the energy norm; `None` without a step.
    pub(super) fn first_correction(
        &mut self,
        unknowns: &Unknowns<C>,
        descent: (&[u32], &[f64]),
    ) -> Option<f64> {
        self.take(descent);
        self.inverses
            .multiply(unknowns, &self.residual, &mut self.preconditioned);
        let square = dot(&self.residual, &self.preconditioned);
        (self.longest > 0.0).then_some(self.longest * square)
    }

    /// The change of an unknown by the first correction.
    pub(super) fn corrects_by(&self, i: usize) -> f64 {
        self.longest * self.preconditioned[i].abs()
    }

    /// `image = S solution` on all unknowns, recovered from the residual of the iteration and `descent`.
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
    fn multiply(&mut self, matrix: &DenseMatrix, unknowns: &Unknowns<C>) {
        self.products += 1;
        self.hessians
            .multiply(unknowns, &self.direction, &mut self.image);
        matrix.add_product(&self.direction, &mut self.image);
    }

    /// `S y` on all unknowns; overwrites the memory of the last iteration.
    pub(super) fn product(
        &mut self,
        (matrix, unknowns): (&DenseMatrix, &Unknowns<C>),
        y: &[SVector<f64, C>],
    ) -> &[f64] {
        for (value, &(p, c)) in self.direction.iter_mut().zip(unknowns.owners()) {
            *value = y[p as usize][c as usize];
        }
        self.products += 1;
        self.image.fill(0.0);
        matrix.add_product(&self.direction, &mut self.image);
        &self.image
    }
}
