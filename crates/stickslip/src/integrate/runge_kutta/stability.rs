//! The stability limit of a step whose error is not estimated.

use std::convert::Infallible;

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Potentials, decouple};

use super::RungeKutta;
use super::tableau::REAL_STABILITY;
use crate::StepError;
use crate::numerics::NUMERICS;
use crate::step::highest_eigenvalue;
use crate::sums::all_directions;

/// `D = C + dfriction/dv` of each vertex and its inverse, zero where it rests or is fixed, at the start of a step. An
/// error of the displacement falls as `D u' = -A u`.
pub(super) struct Resistances<const C: usize> {
    blocks: Vec<[SMatrix<f64, C, C>; 2]>,
    /// The largest eigenvalue of the stiffness over that of its diagonal blocks.
    spread: f64,
}

impl<const C: usize> RungeKutta<C> {
    /// Refuses a step beyond the real stability limit of the method, `dt lambda_max(D^-1 A) < 3.3`. The cells that are
    /// implicit in the step count as fixed.
    pub(super) fn check_stability(&mut self, dt: f64) -> Result<(), StepError> {
        let mut resistances = self.resistances.take().unwrap_or_else(|| {
            let own = |vertex: usize| {
                let block = self.matrices.stiffness().diagonal_block(vertex);
                inverted(block, &self.scene.constraints.fixed[vertex])
            };
            let blocks: Vec<_> = (0..self.now.velocity.len()).map(own).collect();
            let spread = self.highest_rate(&blocks);
            Box::new(Resistances { blocks, spread })
        });
        self.find_resistances(&mut resistances.blocks);
        let of_vertex = |(vertex, [_, inverse]): (usize, &[SMatrix<f64, C, C>; 2])| {
            (inverse * self.matrices.stiffness().diagonal_block(vertex)).trace()
        };
        let own = resistances.blocks.iter().enumerate().map(of_vertex);
        let own = own.fold(0.0, f64::max);
        // The largest eigenvalue lies between that of one vertex by itself and this bound.
        let bound = resistances.spread * own;
        let highest = if dt * bound <= REAL_STABILITY || dt * own > REAL_STABILITY * C as f64 {
            bound
        } else {
            self.highest_rate(&resistances.blocks)
        };
        self.resistances = Some(resistances);
        if dt * highest > REAL_STABILITY {
            let limit = REAL_STABILITY / highest;
            return Err(StepError::Unstable { dt, limit });
        }
        Ok(())
    }

    pub(super) fn find_resistances(&self, blocks: &mut [[SMatrix<f64, C, C>; 2]]) {
        let (velocity, fixed) = (
            &self.stages.slopes[0].displacement,
            &self.scene.constraints.fixed,
        );
        for (k, &vertex) in self.scene.contacts.vertices.iter().enumerate() {
            let slope = self
                .scene
                .contacts
                .local_model(k, &velocity[vertex])
                .hessian;
            // What rests has no error that grows.
            let rests = velocity[vertex].amax() == 0.0;
            blocks[vertex] = if rests {
                [SMatrix::zeros(); 2]
            } else {
                inverted(self.local.damping[k] + slope, &fixed[vertex])
            };
        }
        if let Some(viscosity) = self.matrices.viscosity() {
            for &(vertex, inverse) in &self.local.smooth {
                blocks[vertex] = [viscosity.diagonal_block(vertex), inverse];
            }
        }
        for vertex in self.soft.vertices(&self.scene.contacts.vertices) {
            blocks[vertex] = [SMatrix::zeros(); 2];
        }
    }

    /// The largest eigenvalue of `A x = lambda D x` [1/s].
    fn highest_rate(&self, blocks: &[[SMatrix<f64, C, C>; 2]]) -> f64 {
        let each = |of: usize, from: &[SVector<f64, C>], to: &mut [SVector<f64, C>]| {
            for ((to, from), blocks) in to.iter_mut().zip(from).zip(blocks) {
                *to = blocks[of] * from;
            }
        };
        let mut general = vec![SVector::zeros(); blocks.len()];
        all_directions(&mut general, &self.scene.constraints.fixed);
        let mut start = general.clone();
        each(1, &general, &mut start);
        let solve = |image: &[_], next: &mut [_]| {
            each(1, image, next);
            Ok::<(), Infallible>(())
        };
        let multiply = |field: &[_], product: &mut [_]| each(0, field, product);
        let found = highest_eigenvalue(
            |field: &[_], product: &mut [_]| {
                self.matrices.stiffness().multiply_add(1.0, field, product);
            },
            (start, &self.matrices.stiffness().ranks()),
            solve,
            multiply,
            NUMERICS.relaxation_change,
        );
        found.unwrap_or(0.0)
    }
}

/// A block and its inverse on the components that are not fixed; zeros where it has none.
fn inverted<const C: usize>(
    block: SMatrix<f64, C, C>,
    fixed: &[bool; C],
) -> [SMatrix<f64, C, C>; 2] {
    let factor = decouple(&block, fixed).cholesky();
    let mut inverse = factor.map_or(SMatrix::zeros(), |factor| factor.inverse());
    for c in (0..C).filter(|&c| fixed[c]) {
        inverse[(c, c)] = 0.0;
    }
    let rests = inverse.amax() == 0.0 || !inverse.amax().is_finite();
    if rests {
        [SMatrix::zeros(); 2]
    } else {
        [block, inverse]
    }
}
