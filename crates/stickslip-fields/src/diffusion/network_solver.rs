//! The solver of networks: conjugate gradients with the diagonal.

use super::Network;
use super::conjugate_gradients::ConjugateGradients;
use super::system::Conductances;
use crate::FieldError;

/// Solves `(diag(a) + q L) x = b` on a network.
#[derive(Debug, Clone)]
pub(super) struct NetworkSolver {
    network: Network,
    /// One over the diagonal.
    inverse: Vec<f64>,
    gradients: ConjugateGradients,
}

impl NetworkSolver {
    pub(super) fn new(network: &Network) -> Self {
        let count = network.count();
        Self {
            network: network.clone(),
            inverse: vec![0.0; count],
            gradients: ConjugateGradients::new(count),
        }
    }

    pub(super) fn factor(&mut self, diagonal: &[f64], conductances: &Conductances, q: f64) {
        self.inverse.copy_from_slice(diagonal);
        for (edge, face) in self.network.edges().iter().zip(&conductances.faces) {
            for cell in edge.cells {
                self.inverse[cell] += q * face;
            }
        }
        self.inverse
            .iter_mut()
            .for_each(|value| *value = 1.0 / *value);
    }

    /// Replaces `b` by the solution, up to a relative residual. Returns the number of iterations.
    pub(super) fn solve(
        &mut self,
        diagonal: &[f64],
        conductances: &Conductances,
        q: f64,
        b: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, FieldError> {
        let Self {
            network,
            inverse,
            gradients,
        } = self;
        let apply = |x: &[f64], image: &mut [f64]| {
            for ((image, x), diagonal) in image.iter_mut().zip(x).zip(diagonal) {
                *image = diagonal * x;
            }
            network.add_flow(&conductances.faces, x, -q, image);
        };
        let precondition = |residual: &[f64], into: &mut [f64]| {
            for ((into, residual), inverse) in into.iter_mut().zip(residual).zip(&*inverse) {
                *into = residual * inverse;
            }
        };
        gradients.solve(b, tolerance, apply, precondition)
    }
}
