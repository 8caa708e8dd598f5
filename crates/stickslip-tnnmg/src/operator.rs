//! Symmetric block operators, as far as the solvers and the time loop ask for them.

use nalgebra::{SMatrix, SVector};

/// A symmetric operator on fields of `C` components a vertex: `A` in `y = A x`.
///
/// Implemented for one vertex (`SMatrix<f64, C, C>`, a spring slider) and, with the feature
/// `sparse`, for compressed block rows ([`BlockMatrix`](crate::BlockMatrix)). Implement it to bring
/// a format of one's own; [`Point`](crate::Point) and the sparse solvers are written for the two
/// formats named.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_tnnmg::Operator;
///
/// let stiffness = SMatrix::<f64, 1, 1>::new(3.0);
/// let mut force = [SVector::<f64, 1>::new(1.0)];
/// stiffness.multiply_add(2.0, &[SVector::<f64, 1>::new(0.5)], &mut force);
/// assert_eq!(force[0][0], 4.0);
/// ```
pub trait Operator<const C: usize>: Sized {
    /// The number of vertices, that is of block rows.
    fn vertex_count(&self) -> usize;

    /// `y += scale A x`; both fields have one entry a vertex.
    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]);

    /// `x . A x`.
    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64;

    /// `sqrt(x . A x)`: zero where rounding leaves a negative square, NaN where there is a NaN.
    fn norm(&self, x: &[SVector<f64, C>]) -> f64 {
        let square = self.quadratic(x);
        if square < 0.0 { 0.0 } else { square.sqrt() }
    }

    /// The sum of `factor * operator` over `terms`, on the union of their patterns.
    fn combination(terms: &[(f64, &Self)]) -> Self;

    /// Overwrites `self`, made by [`combination`](Operator::combination) of operators with the
    /// same patterns, by another combination of them. Allocates nothing.
    fn set_combination(&mut self, terms: &[(f64, &Self)]);
}

impl<const C: usize> Operator<C> for SMatrix<f64, C, C> {
    fn vertex_count(&self) -> usize {
        1
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        y[0] += self * x[0] * scale;
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        x[0].dot(&(self * x[0]))
    }

    fn combination(terms: &[(f64, &Self)]) -> Self {
        terms
            .iter()
            .fold(Self::zeros(), |sum, (factor, term)| sum + *term * *factor)
    }

    fn set_combination(&mut self, terms: &[(f64, &Self)]) {
        *self = Self::combination(terms);
    }
}
