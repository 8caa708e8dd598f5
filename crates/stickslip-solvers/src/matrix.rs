//! Matrices as the time loop sees them.

use std::any::Any;

use nalgebra::{SMatrix, SVector};

use crate::{MatrixDefect, MeshId, ProductByParts, Ranks};

/// A matrix on fields of `C` components per vertex: `A` in `y = A x`. Solvers take symmetric ones.
///
/// The trait is object safe: a `&dyn Matrix<C>` is a matrix of any format, which [`Any`] tells. An
/// [`Operator`](crate::Operator) can be added to others, too.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_solvers::Matrix;
///
/// let stiffness = SMatrix::<f64, 1, 1>::new(3.0);
/// let matrix: &dyn Matrix<1> = &stiffness;
/// let mut force = [SVector::<f64, 1>::new(1.0)];
/// matrix.multiply_add(2.0, &[SVector::<f64, 1>::new(0.5)], &mut force);
/// assert_eq!(force[0][0], 4.0);
/// ```
pub trait Matrix<const C: usize>: Any + Send + Sync {
    /// The number of vertices: the number of block rows.
    fn vertex_count(&self) -> usize;

    /// `(A x)_i`, of one vertex.
    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C>;

    /// The diagonal block of a vertex.
    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C>;

    /// `(A x)_i` of some vertices, increasing, one after the other into `products`.
    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (product, &i) in products.iter_mut().zip(vertices) {
            *product = self.product_at(i, x);
        }
    }

    /// `y += scale A x`; both fields have one entry per vertex.
    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        for (i, y) in y.iter_mut().enumerate() {
            *y += self.product_at(i, x) * scale;
        }
    }

    /// The number of levels of local steps in which parts of `A` act, at most [`MOST_LEVELS`](crate::MOST_LEVELS): 1, as by default, without.
    fn levels(&self) -> usize {
        1
    }

    /// The highest level of the parts of `A` that act at a vertex; 0 by default.
    fn level_at(&self, _i: usize) -> usize {
        0
    }

    /// `y += scale (sum over levels l of weights[l] A_l) x`, 0 for weights that are not given. By default all of `A` is level 0.
    fn multiply_add_levels(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        if let Some(&weight) = weights.first().filter(|weight| **weight != 0.0) {
            self.multiply_add(scale * weight, x, y);
        }
    }

    /// The product part by part, if it has one; `None` by default.
    fn by_parts(&self) -> Option<&dyn ProductByParts<C>> {
        None
    }

    /// The numbers `m_i` of a lumped matrix `A_ii = m_i I`; `None` by default, and for other matrices.
    fn lumps(&self) -> Option<&[f64]> {
        None
    }

    /// `x . A x`.
    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let terms = x.iter().enumerate();
        terms.map(|(i, x_i)| x_i.dot(&self.product_at(i, x))).sum()
    }

    /// `sqrt(x . A x)`: zero for a square that rounding made negative, NaN for a NaN.
    fn norm(&self, x: &[SVector<f64, C>]) -> f64 {
        let square = self.quadratic(x);
        if square < 0.0 { 0.0 } else { square.sqrt() }
    }

    /// The defect of the matrix as an operator, if any; `None` by default, for formats without defects.
    fn defect(&self) -> Option<MatrixDefect> {
        None
    }

    /// The mesh or the cells that the matrix belongs to; `None` by default, if unknown. A scene refuses parts and
    /// matrices of another one.
    fn mesh(&self) -> Option<MeshId> {
        None
    }

    /// The processes that share the vertices; one by default.
    ///
    /// A matrix on several processes overrides [`multiply_add`](Matrix::multiply_add),
    /// [`products_at`](Matrix::products_at) and [`quadratic`](Matrix::quadratic), too, which all processes call
    /// together.
    fn ranks(&self) -> Ranks {
        Ranks::default()
    }
}
