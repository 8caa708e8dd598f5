//! The operator of a fault of segments or of triangles.

use std::fmt;
use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_solvers::{Matrix, MeshId, Operator};

use super::{Interaction, Vertices, add_forces, add_forces_at, work};
use crate::hmatrix::Compression;
use crate::plane::Terms;

/// The matrix of the cells of a fault of any shape, `A = sum factor * interaction + diagonal`, on slip of `C` components.
///
/// The interaction is an [`HMatrix`](crate::HMatrix): of dense blocks alone for few cells, with blocks of low rank for many
/// ([`compression`](Self::compression)). Products allocate nothing, and run in the threads of `rayon` if the feature is on,
/// with the same bits in any number of them. Forces and normal stress of one slip are made together. Clones and combinations
/// share the numbers. `DMatrix::from` returns the dense matrix.
///
/// The matrix is not symmetric, see [`DippingKernel`](crate::DippingKernel): the stress is taken at centres of cells.
/// Products are those of the matrix as it is, [`quadratic`](Matrix::quadratic) sees its symmetric part. Steps that evaluate
/// forces need no symmetry.
///
/// [`SegmentFault`](crate::SegmentFault) and [`SurfaceFault`](crate::SurfaceFault) make it.
#[doc(alias(
    "boundary element",
    "nonplanar",
    "displacement discontinuity method",
    "H-matrix"
))]
pub struct CellKernel<const C: usize> {
    terms: Terms<Interaction<C>, ()>,
    diagonal: Vec<SMatrix<f64, C, C>>,
    mesh: Option<MeshId>,
}

impl<const C: usize> Clone for CellKernel<C> {
    fn clone(&self) -> Self {
        Self {
            terms: self.terms.clone(),
            diagonal: self.diagonal.clone(),
            mesh: self.mesh,
        }
    }
}

impl<const C: usize> CellKernel<C> {
    pub(crate) fn of_diagonal(diagonal: Vec<SMatrix<f64, C, C>>, mesh: MeshId) -> Self {
        Self {
            terms: Terms::none(),
            diagonal,
            mesh: Some(mesh),
        }
    }

    pub(crate) fn of_interaction(interaction: Arc<Interaction<C>>, mesh: MeshId) -> Self {
        let count = interaction.count();
        Self {
            terms: Terms::of(interaction, ()),
            diagonal: vec![SMatrix::zeros(); count],
            mesh: Some(mesh),
        }
    }

    /// What the interaction takes, and its approximation; `None` of a diagonal matrix.
    pub fn compression(&self) -> Option<Compression> {
        let first = self.terms.iter().next();
        first.map(|term| term.interaction.compression())
    }

    /// The block `A_ij`: forces at cell `i` per slip of cell `j`.
    pub fn block(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        let own = if i == j {
            self.diagonal[i]
        } else {
            SMatrix::zeros()
        };
        let terms = self.terms.iter();
        terms.fold(own, |sum, term| {
            sum + term.interaction.force(i, j) * term.factor
        })
    }

    /// The products at some vertices.
    pub(crate) fn products_at_vertices(
        &self,
        vertices: Vertices<'_>,
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (product, cell) in products.iter_mut().zip(vertices.cells()) {
            *product = self.diagonal[cell] * x[cell];
        }
        for term in self.terms.present() {
            add_forces_at(&term.interaction, term.factor, vertices, x, products);
        }
    }

    /// The sum of multiples.
    pub(crate) fn sum<'a>(terms: impl Iterator<Item = (f64, &'a Self)> + Clone) -> Self {
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

    /// Overwrites itself by a sum of multiples. Allocates nothing for interactions that it has.
    pub(crate) fn set_sum<'a>(&mut self, terms: impl Iterator<Item = (f64, &'a Self)> + Clone) {
        self.diagonal.fill(SMatrix::zeros());
        for (factor, kernel) in terms.clone() {
            for (sum, block) in self.diagonal.iter_mut().zip(&kernel.diagonal) {
                *sum += block * factor;
            }
        }
        (self.terms).set_sum(terms.map(|(factor, kernel)| (factor, &kernel.terms)));
    }
}

impl CellKernel<1> {
    /// `A_ij`.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.block(i, j)[0]
    }
}

impl<const C: usize> Matrix<C> for CellKernel<C> {
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

    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        let vertices = Vertices { first: 0, vertices };
        self.products_at_vertices(vertices, x, products);
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.block(i, i)
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        for ((y, x), own) in y.iter_mut().zip(x).zip(&self.diagonal) {
            *y += own * x * scale;
        }
        for term in self.terms.present() {
            add_forces(&term.interaction, scale * term.factor, x, y);
        }
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let own = x.iter().zip(&self.diagonal);
        let own: f64 = own.map(|(x, block)| x.dot(&(block * x))).sum();
        let terms = self.terms.present();
        own + terms
            .map(|term| term.factor * work(&term.interaction, x, x))
            .sum::<f64>()
    }
}

impl<const C: usize> Operator<C> for CellKernel<C> {
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
    }
}

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> From<&CellKernel<C>> for DMatrix<f64> {
    fn from(kernel: &CellKernel<C>) -> Self {
        let count = kernel.vertex_count();
        let mut dense = Self::zeros(C * count, C * count);
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            let mut block = dense.fixed_view_mut::<C, C>(C * i, C * j);
            block.copy_from(&kernel.block(i, j));
        }
        dense
    }
}

impl<const C: usize> fmt::Debug for CellKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors: Vec<_> = self.terms.iter().map(|term| term.factor).collect();
        formatter
            .debug_struct("CellKernel")
            .field("cells", &self.diagonal.len())
            .field("factors", &factors)
            .finish()
    }
}
