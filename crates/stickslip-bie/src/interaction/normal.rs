//! The normal stress of slip on a fault of segments or of triangles.

use std::sync::Arc;

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{MeshId, NormalStressChange};

use super::{Interaction, add_compressions};
use crate::surface::Averaging;

/// Smaller bends are rounding of coordinates, and explain no failure \[degrees\].
const BEND: f64 = 1e-3;

/// The change of normal stress on the cells of a fault of any shape per slip on all of them [Pa/m], compression positive:
/// `N` in `sigma = sigma_0 + N D`.
///
/// On a curved surface of triangles it is the mean by area over the cells that share a vertex, unless the fault is
/// [without averaging](crate::SurfaceFault::without_averaging). It is made together with the forces of the
/// [`CellKernel`](crate::CellKernel) of the same fault. Products allocate nothing. Clones share the numbers.
///
/// [`SegmentFault`](crate::SegmentFault) and [`SurfaceFault`](crate::SurfaceFault) make it.
#[derive(Debug, Clone)]
#[doc(alias("clamping", "unclamping"))]
pub struct CellNormalKernel<const C: usize> {
    interaction: Arc<Interaction<C>>,
    averaging: Option<Arc<Averaging>>,
    /// The bend at each cell \[degrees\].
    bends: Arc<[f64]>,
    mesh: MeshId,
}

impl<const C: usize> CellNormalKernel<C> {
    pub(crate) fn new(interaction: Arc<Interaction<C>>, bends: Arc<[f64]>, mesh: MeshId) -> Self {
        Self {
            interaction,
            averaging: None,
            bends,
            mesh,
        }
    }

    pub(crate) fn averaged(self, averaging: Arc<Averaging>) -> Self {
        Self {
            averaging: Some(averaging),
            ..self
        }
    }

    /// The number of cells.
    pub fn vertex_count(&self) -> usize {
        self.interaction.count()
    }

    /// The identity of its cells.
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// Whether no slip changes the normal stress: antiplane slip, slip on one plane in a whole space, and slip along strike
    /// on a vertical one in a half space.
    pub fn is_zero(&self) -> bool {
        !self.interaction.changes_normal_stress()
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both. Allocates nothing.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        let mean = self.averaging.as_deref();
        add_compressions(&self.interaction, scale, slip, mean, normal_stress);
    }

    /// The change of normal stress at cell `i` per slip of cell `j` [Pa/m].
    pub fn block(&self, i: usize, j: usize) -> SVector<f64, C> {
        if self.is_zero() {
            return SVector::zeros();
        }
        let own = |i: usize| self.interaction.compression_of(i, j);
        match &self.averaging {
            Some(averaging) => SVector::from_fn(|c, _| averaging.mean(i, |i| own(i)[c])),
            None => own(i),
        }
    }
}

impl CellNormalKernel<1> {
    /// The change of normal stress at cell `i` per slip of cell `j` [Pa/m].
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.block(i, j)[0]
    }
}

/// Row `i` has the columns `C j + c` of component `c` of the slip of cell `j`.
impl<const C: usize> From<&CellNormalKernel<C>> for DMatrix<f64> {
    fn from(normal: &CellNormalKernel<C>) -> Self {
        let count = normal.vertex_count();
        Self::from_fn(count, C * count, |i, column| {
            normal.block(i, column / C)[column % C]
        })
    }
}

impl<const C: usize> NormalStressChange<C> for CellNormalKernel<C> {
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        Some(self.mesh())
    }

    /// The largest angle to a cell beside it, from 0.001 degrees on.
    fn bend(&self, vertex: usize) -> Option<f64> {
        let bend = self.bends.get(vertex).copied();
        bend.filter(|bend| *bend >= BEND)
    }

    fn add(&self, scale: f64, slip: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        self.multiply_add(scale, slip, normal_stress);
    }
}
