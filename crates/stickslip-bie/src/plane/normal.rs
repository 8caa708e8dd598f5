//! The normal stress of slip.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{MeshId, NormalStressChange};

use super::layer_product::Memory;
use super::layers::Layers;
use crate::Rectangles;

/// The change of normal stress on the cells of a plane per slip [Pa/m], compression positive: `N` in
/// `sigma = sigma_0 + N D`.
///
/// The matrix is not symmetric. It is 0 in a whole space, by symmetry, and on a vertical plane in a half space.
/// Products allocate nothing. Clones share the numbers.
///
/// [`PlaneFault::normal_stiffness`](crate::PlaneFault::normal_stiffness) makes it.
pub struct PlaneNormalKernel<const C: usize> {
    mesh: MeshId,
    matrix: Option<(Arc<Layers>, Mutex<Memory>)>,
}

impl<const C: usize> PlaneNormalKernel<C> {
    /// The kernel of slip that causes no normal stress.
    pub(crate) fn zero(cells: &Rectangles) -> Self {
        Self {
            mesh: cells.identity(),
            matrix: None,
        }
    }

    pub(crate) fn new(cells: &Rectangles, matrix: Layers) -> Self {
        let memory = Mutex::new(matrix.memory(1, C));
        Self {
            mesh: cells.identity(),
            matrix: Some((Arc::new(matrix), memory)),
        }
    }

    /// The number of cells.
    pub fn vertex_count(&self) -> usize {
        self.mesh.vertices
    }

    /// The identity of its cells, see [`Rectangles::identity`].
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// True if no slip changes the normal stress.
    pub fn is_zero(&self) -> bool {
        self.matrix.is_none()
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        multiply_add(self, scale, slip, normal_stress);
    }

    /// The change of normal stress at cell `i` per slip of cell `j` [Pa/m].
    pub fn entry(&self, i: usize, j: usize) -> SVector<f64, C> {
        match &self.matrix {
            None => SVector::zeros(),
            Some((matrix, _)) => matrix.entry::<1, C>(i, j).transpose(),
        }
    }
}

impl<const C: usize> Clone for PlaneNormalKernel<C> {
    fn clone(&self) -> Self {
        let matrix = self.matrix.as_ref().map(|(matrix, memory)| {
            let memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
            (Arc::clone(matrix), Mutex::new(memory.clone()))
        });
        Self {
            mesh: self.mesh,
            matrix,
        }
    }
}

impl<const C: usize> fmt::Debug for PlaneNormalKernel<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let matrix = self.matrix.as_ref().map(|(matrix, _)| matrix);
        formatter
            .debug_tuple("PlaneNormalKernel")
            .field(&matrix)
            .finish()
    }
}

impl<const C: usize> NormalStressChange<C> for PlaneNormalKernel<C> {
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
    fn multiply_add<C>(
        kernel: &PlaneNormalKernel<C>,
        scale: f64,
        slip: &[SVector<f64, C>],
        normal_stress: &mut [f64],
    ) {
        if let Some((matrix, memory)) = &kernel.matrix {
            let mut memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
            matrix.product(&mut memory, slip, |i, value: SVector<f64, 1>| {
                normal_stress[i] += scale * value[0];
            });
        }
    }
}
