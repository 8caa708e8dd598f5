//! Whether an operator stays definite under springs that push.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use super::reduction::sum;

/// The fields of a test.
pub(crate) struct Definite<const C: usize> {
    residual: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
    image: Vec<SVector<f64, C>>,
}

/// Iterations without an answer.
const MOST: usize = 300;
/// The share of the residual with which no direction is left to be found.
const DONE: f64 = 1e-10;

impl<const C: usize> Definite<C> {
    /// For so many vertices.
    pub(crate) fn new(size: usize) -> Self {
        let zeros = || vec![SVector::zeros(); size];
        Self {
            residual: zeros(),
            direction: zeros(),
            image: zeros(),
        }
    }

    /// Whether `B + D` is positive definite on its free components, `D` a number at each of some vertices: conjugate
    /// gradients, preconditioned by the diagonal of `similar`, from a load that has a share in every direction come to
    /// their end without one in which it is not. Without an answer it counts as not definite.
    ///
    /// `add_product` adds `B x` to a field.
    pub(crate) fn holds<Op: Operator<C>>(
        &mut self,
        similar: &Op,
        add_product: impl Fn(&[SVector<f64, C>], &mut [SVector<f64, C>]),
        fixed: &[[bool; C]],
        (vertices, added): (&[usize], &[f64]),
    ) -> bool {
        // Digits of the golden ratio: none of the directions is special.
        let mut digit: f64 = 0.5;
        for (residual, fixed) in self.residual.iter_mut().zip(fixed) {
            *residual = SVector::from_fn(|c, _| {
                digit = (digit + 0.618_033_988_749_894_9).fract();
                if fixed[c] { 0.0 } else { digit - 0.5 }
            });
        }
        let precondition = |i: usize, residual: &SVector<f64, C>| {
            residual.component_div(&similar.diagonal_block(i).diagonal())
        };
        for (i, (residual, fixed)) in self.residual.iter_mut().zip(fixed).enumerate() {
            // A load of the same size everywhere, in terms of what resists it.
            let size = similar.diagonal_block(i).diagonal().map(f64::sqrt);
            *residual = SVector::from_fn(|c, _| if fixed[c] { 0.0 } else { residual[c] * size[c] });
            self.direction[i] = precondition(i, residual);
        }
        let product = |residual: &[SVector<f64, C>]| {
            let terms = residual.iter().enumerate();
            sum(terms.map(|(i, residual)| residual.dot(&precondition(i, residual))))
        };
        let first = product(&self.residual);
        let mut square = first;
        for _ in 0..MOST {
            if square <= DONE * DONE * first {
                return true;
            }
            self.image.fill(SVector::zeros());
            add_product(&self.direction, &mut self.image);
            for (&vertex, &added) in vertices.iter().zip(added) {
                self.image[vertex] += self.direction[vertex] * added;
            }
            for (image, fixed) in self.image.iter_mut().zip(fixed) {
                for c in (0..C).filter(|&c| fixed[c]) {
                    image[c] = 0.0;
                }
            }
            let pairs = self.direction.iter().zip(&self.image);
            let curvature = sum(pairs.map(|(direction, image)| direction.dot(image)));
            if curvature.is_nan() || curvature <= 0.0 {
                return false;
            }
            let length = square / curvature;
            for (residual, image) in self.residual.iter_mut().zip(&self.image) {
                *residual -= image * length;
            }
            let last = std::mem::replace(&mut square, product(&self.residual));
            for (i, (direction, residual)) in
                self.direction.iter_mut().zip(&self.residual).enumerate()
            {
                *direction = precondition(i, residual) + *direction * (square / last);
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    /// A chain of `n` masses between walls resists a push at its first one by `1 + 1/n` springs.
    #[test]
    fn a_chain_bears_a_push_up_to_its_stiffness() {
        for n in [1_u8, 2, 7, 40, 200] {
            let size = usize::from(n);
            let chain = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
                0 => 2.0,
                1 => -1.0,
                _ => 0.0,
            });
            let stiffness = 1.0 + f64::from(n).recip();
            let mut definite = Definite::<1>::new(size);
            let free = vec![[false]; size];
            let product = |x: &[_], y: &mut [_]| Operator::<1>::multiply_add(&chain, 1.0, x, y);
            let mut holds = |push: f64| definite.holds(&chain, product, &free, (&[0], &[-push]));
            assert!(holds(0.0) && holds(stiffness * (1.0 - 1e-6)), "{n}");
            assert!(!holds(stiffness * (1.0 + 1e-6)), "{n}");
            // Held there it bears any.
            let mut held = free.clone();
            held[0] = [true];
            assert!(
                definite.holds(&chain, product, &held, (&[0], &[-1e9])),
                "{n}"
            );
        }
    }
}
