//! The operator of several planes.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip_core::compiled;
use stickslip_solvers::{Matrix, MeshId};

use super::blocks::{Blocks, Memory};
use super::coupling::Coupling;
use crate::interaction::{Vertices, add_forces, add_forces_at, work};
use crate::plane::terms::Terms;
use crate::{CellKernel, PlaneKernel};

/// The matrix of the cells of several planes, on slip of `C` components: that of each plane, and dense blocks between
/// them; with a surface also its [`CellKernel`], and hierarchical matrices between it and the planes.
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
    pub(super) planes: Vec<PlaneKernel<C>>,
    /// The interactions between planes.
    pub(super) terms: Terms<Blocks<C, C>, Memory<C>>,
    pub(super) surface: Option<OfSurface<C>>,
    /// The cells of all planes, and of the surface.
    pub(super) mesh: Option<MeshId>,
}

/// A surface behind the planes.
#[derive(Clone)]
pub(super) struct OfSurface<const C: usize> {
    pub(super) own: CellKernel<C>,
    pub(super) between: Terms<Coupling<C>, ()>,
}

impl<const C: usize> Clone for SystemKernel<C> {
    fn clone(&self) -> Self {
        Self {
            planes: self.planes.clone(),
            terms: self.terms.clone(),
            surface: self.surface.clone(),
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
            surface: None,
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
            surface: None,
            mesh: None,
        }
    }

    /// The same matrix with a surface behind the planes.
    pub(crate) fn with_surface(
        self,
        own: CellKernel<C>,
        between: Option<Arc<Coupling<C>>>,
    ) -> Self {
        let between = between.map_or_else(Terms::none, |between| Terms::of(between, ()));
        let surface = Some(OfSurface { own, between });
        Self { surface, ..self }
    }

    /// The number of vertices of planes.
    pub(super) fn vertices_of_planes(&self) -> usize {
        self.planes.iter().map(PlaneKernel::vertex_count).sum()
    }

    /// The factor and the sum of surfaces in terms.
    pub(super) fn surfaces<'a>(
        terms: impl Iterator<Item = (f64, &'a Self)> + Clone,
    ) -> impl Iterator<Item = (f64, &'a OfSurface<C>)> + Clone {
        terms.filter_map(|(factor, term)| Some((factor, term.surface.as_ref()?)))
    }

    /// The planes with their vertices.
    pub(super) fn planes(&self) -> impl Iterator<Item = (Range<usize>, &PlaneKernel<C>)> {
        self.planes.iter().scan(0, |end, plane| {
            let begin = *end;
            *end += plane.vertex_count();
            Some((begin..*end, plane))
        })
    }

    /// The plane of a vertex, and the cell there; of a vertex of the surface the number of planes, and its cell.
    pub(super) fn plane_and_cell(&self, vertex: usize) -> [usize; 2] {
        let mut planes = self.planes().enumerate();
        let found = planes.find(|(_, (vertices, _))| vertices.contains(&vertex));
        let behind = [
            self.planes.len(),
            vertex.wrapping_sub(self.vertices_of_planes()),
        ];
        found.map_or(behind, |(plane, (vertices, _))| {
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
    fn products_at<C in 1, 2>(
        kernel: &SystemKernel<C>,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        let place = |vertex: usize| vertices.partition_point(|&other| other < vertex);
        for (of_plane, plane) in kernel.planes() {
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
        let first = kernel.vertices_of_planes();
        let (on_planes, on_surface) = vertices.split_at(place(first));
        let (planes, surface) = x.split_at(first);
        let (of_planes, of_surface) = products.split_at_mut(on_planes.len());
        kernel.between_planes(on_planes.iter().copied(), planes, |place, value| {
            of_planes[place] += value;
        });
        if let Some(OfSurface { own, between }) = &kernel.surface {
            let on_planes = Vertices { first: 0, vertices: on_planes };
            let on_surface = Vertices { first, vertices: on_surface };
            own.products_at_vertices(on_surface, surface, of_surface);
            for term in between.present() {
                let (between, factor) = (&term.interaction, term.factor);
                add_forces_at(&between.on_planes, factor, on_planes, surface, of_planes);
                add_forces_at(&between.on_surface, factor, on_surface, planes, of_surface);
            }
        }
    }

    fn multiply_add<C in 1, 2>(
        kernel: &SystemKernel<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        for (vertices, plane) in kernel.planes() {
            plane.multiply_add(scale, &x[vertices.clone()], &mut y[vertices]);
        }
        let first = kernel.vertices_of_planes();
        let (planes, surface) = x.split_at(first);
        let (of_planes, of_surface) = y.split_at_mut(first);
        kernel.between_planes(0..first, planes, |i, value| of_planes[i] += value * scale);
        if let Some(OfSurface { own, between }) = &kernel.surface {
            own.multiply_add(scale, surface, of_surface);
            for term in between.present() {
                let (between, factor) = (&term.interaction, scale * term.factor);
                add_forces(&between.on_planes, factor, surface, of_planes);
                add_forces(&between.on_surface, factor, planes, of_surface);
            }
        }
    }
}

impl<const C: usize> Matrix<C> for SystemKernel<C> {
    fn vertex_count(&self) -> usize {
        let of_surface = self
            .surface
            .as_ref()
            .map_or(0, |surface| surface.own.vertex_count());
        self.vertices_of_planes() + of_surface
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
        match (self.planes.get(plane), &self.surface) {
            (None, Some(surface)) => surface.own.diagonal_block(cell),
            _ => self.planes[plane].diagonal_block(cell),
        }
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        multiply_add(self, scale, x, y);
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let planes = self.planes();
        let mut sum = planes
            .map(|(vertices, plane)| plane.quadratic(&x[vertices]))
            .sum();
        let (planes, surface) = x.split_at(self.vertices_of_planes());
        self.between_planes(0..planes.len(), planes, |i, value| sum += x[i].dot(&value));
        if let Some(OfSurface { own, between }) = &self.surface {
            sum += own.quadratic(surface);
            for term in between.present() {
                let (between, factor) = (&term.interaction, term.factor);
                sum += factor * work(&between.on_planes, surface, planes);
                sum += factor * work(&between.on_surface, planes, surface);
            }
        }
        sum
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
