//! The normal stress of slip on a surface.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{MeshId, NormalStressChange};

use super::averaging::Averaging;
use super::dense::{Dense, Memory};

/// The change of normal stress on the cells of a surface per slip on all of them [Pa/m], compression positive: `N` in
/// `sigma = sigma_0 + N D`.
///
/// On a curved surface it is the mean by area over the cells that share a vertex, unless the fault is
/// [without averaging](crate::SurfaceFault::without_averaging). Products allocate nothing. Clones share the numbers.
///
/// [`SurfaceFault::normal_stiffness`](crate::SurfaceFault::normal_stiffness) makes it.
pub struct SurfaceNormalKernel<const C: usize> {
    interaction: Arc<Dense<C>>,
    averaging: Option<Arc<Averaging>>,
    memory: Mutex<Memory>,
    mesh: MeshId,
}

impl<const C: usize> SurfaceNormalKernel<C> {
    pub(crate) fn new(
        interaction: Arc<Dense<C>>,
        averaging: Option<Arc<Averaging>>,
        mesh: MeshId,
    ) -> Self {
        let memory = Mutex::new(interaction.memory());
        Self {
            interaction,
            averaging,
            memory,
            mesh,
        }
    }

    /// The number of cells.
    pub fn vertex_count(&self) -> usize {
        self.interaction.count()
    }

    /// The identity of its cells, see [`Triangles::identity`](crate::Triangles::identity).
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// True if no slip changes the normal stress, up to rounding: on one plane in a whole space.
    pub fn is_zero(&self) -> bool {
        self.interaction.is_planar
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        multiply_add(self, scale, slip, normal_stress);
    }

    /// The change of normal stress at cell `i` per slip of cell `j` [Pa/m].
    pub fn entry(&self, i: usize, j: usize) -> SVector<f64, C> {
        let own = |i: usize| self.interaction.compression(i, j);
        match &self.averaging {
            Some(averaging) => SVector::from_fn(|c, _| averaging.mean(i, |i| own(i)[c])),
            None => own(i),
        }
    }
}

impl<const C: usize> Clone for SurfaceNormalKernel<C> {
    fn clone(&self) -> Self {
        let averaging = self.averaging.clone();
        Self::new(Arc::clone(&self.interaction), averaging, self.mesh)
    }
}

impl<const C: usize> fmt::Debug for SurfaceNormalKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("SurfaceNormalKernel")
            .field("cells", &self.vertex_count())
            .field("is_averaged", &self.averaging.is_some())
            .finish()
    }
}

impl<const C: usize> NormalStressChange<C> for SurfaceNormalKernel<C> {
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        Some(self.mesh())
    }

    fn add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        self.multiply_add(scale, slip, normal_stress);
    }
}

compiled! {
    fn multiply_add<C in 1, 2>(
        kernel: &SurfaceNormalKernel<C>,
        scale: f64,
        slip: &[SVector<f64, C>],
        normal_stress: &mut [f64],
    ) {
        let mut memory = kernel.memory.lock().unwrap_or_else(PoisonError::into_inner);
        kernel.interaction.compressions(&mut memory, slip);
        let values = memory.values();
        for (cell, sum) in normal_stress.iter_mut().enumerate() {
            *sum += scale * match &kernel.averaging {
                Some(averaging) => averaging.mean(cell, |other| values[other]),
                None => values[cell],
            };
        }
    }
}
