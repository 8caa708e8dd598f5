//! Conjugate gradients.

use crate::FieldError;

/// The relative residual at which the iteration of a step ends.
pub(super) const EXACT: f64 = 1e-13;
/// The same for the estimated error of a step.
pub(super) const ROUGH: f64 = 1e-6;

/// The vectors of an iteration.
#[derive(Debug, Clone)]
pub(super) struct ConjugateGradients {
    solution: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    scaled: Vec<f64>,
}

impl ConjugateGradients {
    pub(super) fn new(count: usize) -> Self {
        let vector = || vec![0.0; count];
        Self {
            solution: vector(),
            direction: vector(),
            image: vector(),
            scaled: vector(),
        }
    }

    /// Replaces `b` by the solution of `A x = b` up to a relative residual, with `apply(x, A x)` and `precondition(r, M^-1 r)`. Returns the number of
    /// iterations.
    pub(super) fn solve(
        &mut self,
        b: &mut [f64],
        tolerance: f64,
        apply: impl Fn(&[f64], &mut [f64]),
        mut precondition: impl FnMut(&[f64], &mut [f64]),
    ) -> Result<usize, FieldError> {
        let Self {
            solution,
            direction,
            image,
            scaled,
        } = self;
        solution.fill(0.0);
        // From here `b` is the residual.
        let bound = tolerance * tolerance * dot(b, b);
        let (most, mut before) = (1000 + 10 * b.len(), f64::INFINITY);
        for iteration in 0..most {
            let square = dot(b, b);
            if square <= bound {
                b.copy_from_slice(solution);
                return Ok(iteration);
            }
            precondition(b, scaled);
            let product = dot(b, scaled);
            if !(product > 0.0 && product.is_finite()) {
                let what = "residual of pore pressure in conjugate gradients";
                return Err(FieldError {
                    what,
                    place: iteration,
                    value: square.sqrt(),
                });
            }
            // 0 at first.
            let ratio = product / before;
            for (direction, scaled) in direction.iter_mut().zip(&*scaled) {
                *direction = scaled + if ratio > 0.0 { ratio * *direction } else { 0.0 };
            }
            before = product;
            apply(direction, image);
            let step = product / dot(direction, image);
            for (x, direction) in solution.iter_mut().zip(&*direction) {
                *x += step * direction;
            }
            for (residual, image) in b.iter_mut().zip(&*image) {
                *residual -= step * image;
            }
        }
        let what = "residual of pore pressure after the last iteration of conjugate gradients";
        Err(FieldError {
            what,
            place: most,
            value: dot(b, b).sqrt(),
        })
    }
}

/// The product of two vectors, in the order of eight sums.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for i in 0..8 {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum::<f64>() + rest
}
