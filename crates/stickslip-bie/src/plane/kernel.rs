//! The operator of a planar fault.

use std::fmt;
use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_core::compiled;
use stickslip_solvers::{Matrix as _, MeshId, Operator};

use super::matrix::{Matrix, Memory};
use super::terms::Terms;

/// The matrix of the cells of a plane, `A = sum factor * interaction + diagonal`, on slip of `C` components.
///
/// A product takes Fourier transforms of twice the number of cells along strike and, in a whole space, down dip; in a
/// half space the modes along strike are multiplied by matrices of the rows, in full or as a sum of a whole space and
/// images of low rank ([`PlaneFault`](crate::PlaneFault)). It runs in the operator's own memory: threads that share one
/// operator wait for each other. Clones and combinations share the numbers of their interactions. `DMatrix::from` returns
/// the dense matrix.
///
/// The matrix is symmetric in a whole space. In a half space it is symmetric up to a few per cent of the diagonal near
/// the surface, because cells of constant slip are seen at their centres: products are those of the matrix as it is,
/// [`quadratic`](stickslip_solvers::Matrix::quadratic) sees its symmetric part.
///
/// In a half space [`product_at`](stickslip_solvers::Matrix::product_at) costs as much as a product of all cells.
///
/// [`PlaneFault`](crate::PlaneFault) makes it.
#[doc(alias("FFT", "boundary element"))]
pub struct PlaneKernel<const C: usize> {
    terms: Terms<Matrix, Memory>,
    diagonal: Vec<SMatrix<f64, C, C>>,
    /// Whether the diagonal is zero: products then read none of it.
    is_interaction: bool,
    /// The cells.
    mesh: Option<MeshId>,
}

impl<const C: usize> Clone for PlaneKernel<C> {
    fn clone(&self) -> Self {
        Self {
            terms: self.terms.clone(),
            diagonal: self.diagonal.clone(),
            is_interaction: self.is_interaction,
            mesh: self.mesh,
        }
    }
}

impl<const C: usize> PlaneKernel<C> {
    /// `d`.
    pub(crate) fn diagonal(diagonal: Vec<SMatrix<f64, C, C>>) -> Self {
        Self {
            terms: Terms::none(),
            diagonal,
            is_interaction: false,
            mesh: None,
        }
    }

    /// The same matrix of known cells.
    pub(crate) fn on(self, mesh: MeshId) -> Self {
        let mesh = Some(mesh);
        Self { mesh, ..self }
    }

    /// The interaction of so many cells.
    pub(crate) fn of_interaction(count: usize, matrix: Arc<Matrix>) -> Self {
        let memory = matrix.memory::<C>();
        Self {
            terms: Terms::of(matrix, memory),
            diagonal: vec![SMatrix::zeros(); count],
            is_interaction: true,
            mesh: None,
        }
    }

    /// The sum of `factor * kernel` over the terms.
    pub(crate) fn sum<'a>(terms: impl Iterator<Item = (f64, &'a Self)> + Clone) -> Self {
        let first = terms.clone().next();
        let count = first.map_or(0, |(_, term)| term.diagonal.len());
        let mut sum = Self::diagonal(vec![SMatrix::zeros(); count]);
        sum.mesh = first.and_then(|(_, term)| term.mesh);
        sum.set_sum(terms);
        sum
    }

    /// Overwrites itself by another such sum. Allocates nothing for interactions that it has.
    pub(crate) fn set_sum<'a>(&mut self, terms: impl Iterator<Item = (f64, &'a Self)> + Clone) {
        self.diagonal.fill(SMatrix::zeros());
        self.is_interaction = true;
        for (factor, kernel) in terms.clone() {
            for (sum, block) in self.diagonal.iter_mut().zip(&kernel.diagonal) {
                *sum += block * factor;
            }
            self.is_interaction &= kernel.is_interaction;
        }
        (self.terms).set_sum(terms.map(|(factor, kernel)| (factor, &kernel.terms)));
    }

    /// Products at cells of a plane whose own first cell is the vertex `first`: row by row in a whole space, by one
    /// product of all cells in a half space.
    pub(crate) fn products_at_vertices(
        &self,
        first: usize,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        products_at_vertices(self, first, vertices, x, products);
    }

    /// Passes on the terms of `A x` at each cell, those of the interactions and of the diagonal one after the other.
    fn product(&self, x: &[SVector<f64, C>], mut show: impl FnMut(usize, SVector<f64, C>)) {
        if !self.is_interaction {
            for (i, (x, own)) in x.iter().zip(&self.diagonal).enumerate() {
                show(i, own * x);
            }
        }
        for term in self.terms.present() {
            let factor = term.factor;
            (term.interaction).product(&mut term.memory(), x, |i, value| show(i, value * factor));
        }
    }
}

compiled! {
    fn products_at_vertices<C>(
        kernel: &PlaneKernel<C>,
        first: usize,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (product, &vertex) in products.iter_mut().zip(vertices) {
            let i = vertex - first;
            *product = kernel.diagonal[i] * x[i];
        }
        for term in kernel.terms.iter() {
            let factor = term.factor;
            if !matches!(*term.interaction, Matrix::Layers(_)) {
                for (product, &vertex) in products.iter_mut().zip(vertices) {
                    for (j, x) in x.iter().enumerate() {
                        *product += term.interaction.entry::<C>(vertex - first, j) * x * factor;
                    }
                }
                continue;
            }
            // Both increase.
            let mut wanted = vertices.iter().zip(products.iter_mut()).peekable();
            (term.interaction).product(&mut term.memory(), x, |i, value| {
                if let Some((_, product)) = wanted.next_if(|(vertex, _)| **vertex == first + i) {
                    *product += value * factor;
                }
            });
        }
    }

    fn multiply_add<C>(
        kernel: &PlaneKernel<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        kernel.product(x, |i, value| y[i] += value * scale);
    }

    fn quadratic<C>(kernel: &PlaneKernel<C>, x: &[SVector<f64, C>]) -> f64 {
        let mut sum = 0.0;
        kernel.product(x, |i, value| sum += x[i].dot(&value));
        sum
    }
}

impl<const C: usize> stickslip_solvers::Matrix<C> for PlaneKernel<C> {
    fn vertex_count(&self) -> usize {
        self.diagonal.len()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = [SVector::zeros()];
        self.products_at(&[i], x, &mut product);
        product[0]
    }

    /// In a whole space row by row; in a half space by one product of all cells.
    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        self.products_at_vertices(0, vertices, x, products);
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let terms = self.terms.iter();
        terms.fold(self.diagonal[i], |sum, term| {
            sum + term.interaction.entry::<C>(i, i) * term.factor
        })
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        multiply_add(self, scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        quadratic(self, x)
    }
}

impl<const C: usize> Operator<C> for PlaneKernel<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        Self::sum(terms.iter().copied().chain(mass))
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.set_sum(terms.iter().copied().chain(mass));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        self.diagonal[i] += block;
        self.is_interaction = false;
    }
}

/// Row and column `C i + c` belong to component `c` of cell `i`.
impl<const C: usize> From<&PlaneKernel<C>> for DMatrix<f64> {
    fn from(kernel: &PlaneKernel<C>) -> Self {
        let size = C * kernel.vertex_count();
        let mut dense = Self::zeros(size, size);
        for (i, block) in kernel.diagonal.iter().enumerate() {
            dense.fixed_view_mut::<C, C>(C * i, C * i).copy_from(block);
        }
        for term in kernel.terms.iter() {
            term.interaction.add_to_dense::<C>(term.factor, &mut dense);
        }
        dense
    }
}

impl<const C: usize> fmt::Debug for PlaneKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let terms = self
            .terms
            .iter()
            .map(|term| (term.factor, &term.interaction));
        formatter.debug_list().entries(terms).finish()
    }
}
