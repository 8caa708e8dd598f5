//! The normal stress of slip on several planes.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{MeshId, NormalStressChange};

use super::blocks::{Blocks, Memory};
use super::coupling::Coupling;
use crate::interaction::add_compressions;
use crate::{CellNormalKernel, PlaneNormalKernel};

/// The change of normal stress on the cells of several planes per slip on all of them [Pa/m], compression positive: `N`
/// in `sigma = sigma_0 + N D`.
///
/// Slip of a vertical plane does not change its own normal stress, but that of others. Products allocate nothing.
/// Clones share the numbers.
///
/// [`FaultSystem::normal_stiffness`](crate::FaultSystem::normal_stiffness) makes it.
pub struct SystemNormalKernel<const C: usize> {
    planes: Vec<PlaneNormalKernel<C>>,
    blocks: Arc<Blocks<1, C>>,
    memory: Mutex<Memory<1>>,
    surface: Option<(CellNormalKernel<C>, Arc<Coupling<C>>)>,
    mesh: MeshId,
}

impl<const C: usize> SystemNormalKernel<C> {
    pub(crate) fn new(
        planes: Vec<PlaneNormalKernel<C>>,
        blocks: Arc<Blocks<1, C>>,
        mesh: MeshId,
    ) -> Self {
        let memory = Mutex::new(blocks.memory());
        Self {
            planes,
            blocks,
            memory,
            surface: None,
            mesh,
        }
    }

    /// The same with a surface behind the planes.
    pub(crate) fn with_surface(self, own: CellNormalKernel<C>, between: Arc<Coupling<C>>) -> Self {
        let surface = Some((own, between));
        Self { surface, ..self }
    }

    /// The number of vertices of planes.
    fn vertices_of_planes(&self) -> usize {
        self.planes
            .iter()
            .map(PlaneNormalKernel::vertex_count)
            .sum()
    }

    /// The identity of the system, see [`FaultSystem::identity`](crate::FaultSystem::identity).
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// The planes with their vertices.
    fn planes(&self) -> impl Iterator<Item = (Range<usize>, &PlaneNormalKernel<C>)> {
        self.planes.iter().scan(0, |end, plane| {
            let begin = *end;
            *end += plane.vertex_count();
            Some((begin..*end, plane))
        })
    }

    /// The number of cells of all planes, and of the surface.
    pub fn vertex_count(&self) -> usize {
        let of_surface = self
            .surface
            .as_ref()
            .map_or(0, |(own, _)| own.vertex_count());
        self.vertices_of_planes() + of_surface
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        multiply_add(self, scale, slip, normal_stress);
    }

    /// The change of normal stress at vertex `i` per slip of vertex `j` [Pa/m].
    pub fn entry(&self, i: usize, j: usize) -> SVector<f64, C> {
        let first = self.vertices_of_planes();
        if let Some((own, between)) = &self.surface {
            match [i, j].map(|vertex| vertex.checked_sub(first)) {
                [Some(i), Some(j)] => return own.block(i, j),
                [None, Some(j)] => return between.on_planes.compression_of(i, j),
                [Some(i), None] => return between.on_surface.compression_of(i, j),
                [None, None] => {}
            }
        }
        let mut planes = self.planes();
        match planes.find(|(vertices, _)| vertices.contains(&i) && vertices.contains(&j)) {
            Some((vertices, plane)) => plane.entry(i - vertices.start, j - vertices.start),
            None => self.blocks.entry(i, j).transpose(),
        }
    }
}

impl<const C: usize> Clone for SystemNormalKernel<C> {
    fn clone(&self) -> Self {
        Self {
            surface: self.surface.clone(),
            ..Self::new(self.planes.clone(), Arc::clone(&self.blocks), self.mesh)
        }
    }
}

impl<const C: usize> fmt::Debug for SystemNormalKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("SystemNormalKernel")
            .field("planes", &self.planes)
            .finish()
    }
}

impl<const C: usize> NormalStressChange<C> for SystemNormalKernel<C> {
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        Some(self.mesh())
    }

    fn bend(&self, vertex: usize) -> Option<f64> {
        let cell = vertex.checked_sub(self.vertices_of_planes())?;
        self.surface.as_ref()?.0.bend(cell)
    }

    fn add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        self.multiply_add(scale, slip, normal_stress);
    }
}

compiled! {
    fn multiply_add<C in 1, 2>(
        kernel: &SystemNormalKernel<C>,
        scale: f64,
        slip: &[SVector<f64, C>],
        normal_stress: &mut [f64],
    ) {
        for (vertices, plane) in kernel.planes() {
            plane.multiply_add(scale, &slip[vertices.clone()], &mut normal_stress[vertices]);
        }
        let mut memory = kernel.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let (planes, surface) = slip.split_at(kernel.vertices_of_planes());
        let (on_planes, on_surface) = normal_stress.split_at_mut(planes.len());
        (kernel.blocks).product(0..planes.len(), &mut memory, planes, |i, value| {
            on_planes[i] += scale * value[0];
        });
        if let Some((own, between)) = &kernel.surface {
            own.multiply_add(scale, surface, on_surface);
            add_compressions(&between.on_planes, scale, surface, None, on_planes);
            add_compressions(&between.on_surface, scale, planes, None, on_surface);
        }
    }
}
