//! The truncated Newton system beside the operator: Hessians of friction, and what is left out.

use nalgebra::SVector;

use super::friction::{Friction, clear};
use crate::gradients::Linearization;

impl<const C: usize> Linearization<C> for Friction<C> {
    fn hide(&self, residual: &mut [SVector<f64, C>]) {
        for &(vertex, c) in &self.held {
            residual[vertex][c] = 0.0;
        }
    }

    fn complete(&self, correction: &mut [SVector<f64, C>]) {
        self.hide(correction);
        for (&vertex, dropped) in self.vertices.iter().zip(&self.dropped) {
            clear(&mut correction[vertex], dropped);
        }
    }

    fn soften(&self, x: &[SVector<f64, C>], product: &mut [SVector<f64, C>]) {
        for (&vertex, stiffness) in self.vertices.iter().zip(&self.stiffness) {
            product[vertex] -= stiffness.component_mul(&x[vertex]);
        }
    }

    fn curvature(&self, direction: &[SVector<f64, C>]) -> f64 {
        let vertices = self.vertices.iter().zip(&self.hessians);
        let parts = vertices.map(|(&vertex, hessian)| {
            let along = &direction[vertex];
            along.dot(&(hessian * along))
        });
        parts.sum()
    }

    fn complete_residual(
        &mut self,
        length: f64,
        direction: &[SVector<f64, C>],
        image: &[SVector<f64, C>],
        residual: &mut [SVector<f64, C>],
    ) {
        for (k, &vertex) in self.vertices.iter().enumerate() {
            self.products[k] += image[vertex] * length;
            residual[vertex] -= self.hessians[k] * direction[vertex] * length;
            clear(&mut residual[vertex], &self.dropped[k]);
        }
    }
}
