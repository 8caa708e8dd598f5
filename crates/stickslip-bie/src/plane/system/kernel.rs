//! The operator of several planes.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_core::compiled;
use stickslip_solvers::{Matrix, MeshId, Operator};

use super::blocks::{Blocks, Memory};
use crate::PlaneKernel;
use crate::plane::terms::Terms;

/// The matrix of the cells of several planes, on slip of `C` components: that of each plane, and dense blocks between
/// them.
///
/// A product takes that of each plane ([`PlaneKernel`]) and two operations per number of the blocks. It runs in the
/// operator's own memory and allocates nothing: threads that share one operator wait for each other. Clones and
/// combinations share the numbers of their interactions. `DMatrix::from` returns the dense matrix.
///
/// The matrix is not symmetric: products are those of the matrix as it is, [`quadratic`](Matrix::quadratic) sees its
/// symmetric part, which need not be definite.
///
/// [`FaultSystem`](crate::FaultSystem) makes it.
#[doc(alias("boundary element", "fault network"))]
pub struct SystemKernel<const C: usize> {
    planes: Vec<PlaneKernel<C>>,
    /// The interactions between planes.
    terms: Terms<Blocks<C, C>, Memory<C>>,
    /// The cells of all planes.
    mesh: Option<MeshId>,
}

impl<const C: usize> Clone for SystemKernel<C> {
    fn clone(&self) -> Self {
        Self {
            planes: self.planes.clone(),
            terms: self.terms.clone(),
            mesh: self.mesh,
        }
    }
}

impl<const C: usize> SystemKernel<C> {
    /// Planes that do not interact.
    pub(crate) fn of_planes(planes: Vec<PlaneKernel<C>>) -> Self {
        Self {
            planes,
            terms: Terms::none(),
            mesh: None,
        }
    }

    /// The same matrix of known cells.
    pub(crate) fn on(self, mesh: MeshId) -> Self {
        let mesh = Some(mesh);
        Self { mesh, ..self }
    }

    pub(crate) fn of_interaction(planes: Vec<PlaneKernel<C>>, blocks: Arc<Blocks<C, C>>) -> Self {
        let memory = blocks.memory();
        Self {
            planes,
            terms: Terms::of(blocks, memory),
            mesh: None,
        }
    }

    /// The planes with their vertices.
    fn planes(&self) -> impl Iterator<Item = (Range<usize>, &PlaneKernel<C>)> {
        self.planes.iter().scan(0, |end, plane| {
            let begin = *end;
            *end += plane.vertex_count();
            Some((begin..*end, plane))
        })
    }

    /// The plane of a vertex, and the cell there.
    fn plane_and_cell(&self, vertex: usize) -> [usize; 2] {
        let mut planes = self.planes().enumerate();
        let found = planes.find(|(_, (vertices, _))| vertices.contains(&vertex));
        found.map_or([self.planes.len(), vertex], |(plane, (vertices, _))| {
            [plane, vertex - vertices.start]
        })
    }

    /// Passes on the terms between planes of `A x` at some vertices, increasing, by their place among them.
    fn between_planes(
        &self,
        vertices: impl Iterator<Item = usize> + Clone,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, C>),
    ) {
        for term in self.terms.present() {
            let factor = term.factor;
            (term.interaction).product(vertices.clone(), &mut term.memory(), x, |place, value| {
                show(place, value * factor);
            });
        }
    }
}

compiled! {
    fn products_at<C>(
        kernel: &SystemKernel<C>,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (of_plane, plane) in kernel.planes() {
            let place = |vertex: usize| vertices.partition_point(|&other| other < vertex);
            let places = place(of_plane.start)..place(of_plane.end);
            if !places.is_empty() {
                plane.products_at_vertices(
                    of_plane.start,
                    &vertices[places.clone()],
                    &x[of_plane],
                    &mut products[places],
                );
            }
        }
        kernel.between_planes(vertices.iter().copied(), x, |place, value| {
            products[place] += value;
        });
    }

    fn multiply_add<C>(
        kernel: &SystemKernel<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        for (vertices, plane) in kernel.planes() {
            plane.multiply_add(scale, &x[vertices.clone()], &mut y[vertices]);
        }
        kernel.between_planes(0..x.len(), x, |i, value| y[i] += value * scale);
    }
}

impl<const C: usize> Matrix<C> for SystemKernel<C> {
    fn vertex_count(&self) -> usize {
        self.planes.iter().map(PlaneKernel::vertex_count).sum()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = [SVector::zeros()];
        self.products_at(&[i], x, &mut product);
        product[0]
    }

    /// Row by row between planes; on each plane as its own kernel does.
    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        products_at(self, vertices, x, products);
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let [plane, cell] = self.plane_and_cell(i);
        self.planes[plane].diagonal_block(cell)
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        multiply_add(self, scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let planes = self.planes();
        let mut sum = planes
            .map(|(vertices, plane)| plane.quadratic(&x[vertices]))
            .sum();
        self.between_planes(0..x.len(), x, |i, value| sum += x[i].dot(&value));
        sum
    }
}

impl<const C: usize> Operator<C> for SystemKernel<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms = terms.iter().copied().chain(mass);
        let first = terms.clone().next();
        let count = first.map_or(0, |(_, term)| term.planes.len());
        let planes = (0..count).map(|plane| {
            let of_plane = terms.clone();
            PlaneKernel::sum(of_plane.map(move |(factor, term)| (factor, &term.planes[plane])))
        });
        let mut sum = Self::of_planes(planes.collect());
        sum.mesh = first.and_then(|(_, term)| term.mesh);
        (sum.terms).set_sum(terms.map(|(factor, term)| (factor, &term.terms)));
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let terms = terms.iter().copied().chain(mass);
        for (plane, own) in self.planes.iter_mut().enumerate() {
            let of_plane = terms.clone();
            own.set_sum(of_plane.map(|(factor, term)| (factor, &term.planes[plane])));
        }
        (self.terms).set_sum(terms.map(|(factor, term)| (factor, &term.terms)));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        let [plane, cell] = self.plane_and_cell(i);
        self.planes[plane].add_to_diagonal(cell, block);
    }
}

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> From<&SystemKernel<C>> for DMatrix<f64> {
    fn from(kernel: &SystemKernel<C>) -> Self {
        let count = kernel.vertex_count();
        let mut dense = Self::zeros(C * count, C * count);
        for (vertices, plane) in kernel.planes() {
            let (first, size) = (C * vertices.start, C * vertices.len());
            let mut own = dense.view_mut((first, first), (size, size));
            own.copy_from(&Self::from(plane));
        }
        for term in kernel.terms.iter() {
            for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                let mut block = dense.fixed_view_mut::<C, C>(C * i, C * j);
                block += term.interaction.entry(i, j) * term.factor;
            }
        }
        dense
    }
}

impl<const C: usize> fmt::Debug for SystemKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors: Vec<_> = self.terms.iter().map(|term| term.factor).collect();
        formatter
            .debug_struct("SystemKernel")
            .field("planes", &self.planes)
            .field("factors", &factors)
            .finish()
    }
}
