//! The operator of a surface.

use std::fmt;
use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_core::compiled;
use stickslip_solvers::{Matrix, MeshId, Operator};

use super::dense::{Dense, Memory};
use crate::plane::Terms;

/// The matrix of the cells of a surface, `A = sum factor * interaction + diagonal`, on slip of `C` components.
///
/// The interaction is dense: a product takes two operations per number. It runs in the operator's own memory and
/// allocates nothing: threads that share one operator wait for each other. Clones and combinations share the numbers.
/// `DMatrix::from` returns the dense matrix.
///
/// The matrix is not symmetric: products are those of the matrix as it is, [`quadratic`](Matrix::quadratic) sees its
/// symmetric part.
///
/// [`SurfaceFault`](crate::SurfaceFault) makes it.
#[doc(alias("boundary element", "nonplanar"))]
pub struct SurfaceKernel<const C: usize> {
    terms: Terms<Dense<C>, Memory>,
    diagonal: Vec<SMatrix<f64, C, C>>,
    mesh: Option<MeshId>,
}

impl<const C: usize> Clone for SurfaceKernel<C> {
    fn clone(&self) -> Self {
        Self {
            terms: self.terms.clone(),
            diagonal: self.diagonal.clone(),
            mesh: self.mesh,
        }
    }
}

impl<const C: usize> SurfaceKernel<C> {
    pub(crate) fn of_diagonal(diagonal: Vec<SMatrix<f64, C, C>>, mesh: MeshId) -> Self {
        Self {
            terms: Terms::none(),
            diagonal,
            mesh: Some(mesh),
        }
    }

    pub(crate) fn of_interaction(interaction: Arc<Dense<C>>, mesh: MeshId) -> Self {
        let (memory, count) = (interaction.memory(), interaction.count());
        Self {
            terms: Terms::of(interaction, memory),
            diagonal: vec![SMatrix::zeros(); count],
            mesh: Some(mesh),
        }
    }

    /// Overwrites itself by a sum of multiples. Allocates nothing for interactions that it has.
    fn set_sum<'a>(&mut self, terms: impl Iterator<Item = (f64, &'a Self)> + Clone) {
        self.diagonal.fill(SMatrix::zeros());
        for (factor, kernel) in terms.clone() {
            for (sum, block) in self.diagonal.iter_mut().zip(&kernel.diagonal) {
                *sum += block * factor;
            }
        }
        (self.terms).set_sum(terms.map(|(factor, kernel)| (factor, &kernel.terms)));
    }
}

compiled! {
    fn products_at<C in 1, 2>(
        kernel: &SurfaceKernel<C>,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (product, &vertex) in products.iter_mut().zip(vertices) {
            *product = kernel.diagonal[vertex] * x[vertex];
        }
        for term in kernel.terms.present() {
            let (rows, factor) = (vertices.iter().copied(), term.factor);
            (term.interaction).forces(rows, &mut term.memory(), x, |place, value| {
                products[place] += value * factor;
            });
        }
    }

    fn multiply_add<C in 1, 2>(
        kernel: &SurfaceKernel<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        for ((y, x), own) in y.iter_mut().zip(x).zip(&kernel.diagonal) {
            *y += own * x * scale;
        }
        for term in kernel.terms.present() {
            let factor = scale * term.factor;
            (term.interaction).forces(0..x.len(), &mut term.memory(), x, |i, value| {
                y[i] += value * factor;
            });
        }
    }
}

impl<const C: usize> Matrix<C> for SurfaceKernel<C> {
    fn vertex_count(&self) -> usize {
        self.diagonal.len()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = [SVector::zeros()];
        products_at(self, &[i], x, &mut product);
        product[0]
    }

    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        products_at(self, vertices, x, products);
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let terms = self.terms.iter();
        terms.fold(self.diagonal[i], |sum, term| {
            sum + term.interaction.force(i, i) * term.factor
        })
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        multiply_add(self, scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let mut product = vec![SVector::zeros(); x.len()];
        multiply_add(self, 1.0, x, &mut product);
        x.iter().zip(&product).map(|(x, y)| x.dot(y)).sum()
    }
}

impl<const C: usize> Operator<C> for SurfaceKernel<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms = terms.iter().copied().chain(mass);
        let first = terms.clone().next();
        let count = first.map_or(0, |(_, term)| term.diagonal.len());
        let mut sum = Self {
            terms: Terms::none(),
            diagonal: vec![SMatrix::zeros(); count],
            mesh: first.and_then(|(_, term)| term.mesh),
        };
        sum.set_sum(terms);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.set_sum(terms.iter().copied().chain(mass));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        self.diagonal[i] += block;
    }
}

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> From<&SurfaceKernel<C>> for DMatrix<f64> {
    fn from(kernel: &SurfaceKernel<C>) -> Self {
        let count = kernel.vertex_count();
        let mut dense = Self::zeros(C * count, C * count);
        for (i, block) in kernel.diagonal.iter().enumerate() {
            dense.fixed_view_mut::<C, C>(C * i, C * i).copy_from(block);
        }
        for term in kernel.terms.iter() {
            for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                let mut block = dense.fixed_view_mut::<C, C>(C * i, C * j);
                block += term.interaction.force(i, j) * term.factor;
            }
        }
        dense
    }
}

impl<const C: usize> fmt::Debug for SurfaceKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors: Vec<_> = self.terms.iter().map(|term| term.factor).collect();
        formatter
            .debug_struct("SurfaceKernel")
            .field("cells", &self.diagonal.len())
            .field("factors", &factors)
            .finish()
    }
}
