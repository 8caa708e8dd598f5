//! The normal stress of slip on segments.

use std::sync::Arc;

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{MeshId, NormalStressChange};

use super::Segments;
use super::rows::Rows;

/// The change of normal stress on the cells of a [`SegmentFault`](crate::SegmentFault) per slip [Pa/m], compression
/// positive: `N` in `sigma = sigma0 + N D`. It is zero for antiplane slip.
#[derive(Debug, Clone)]
#[doc(alias("clamping", "unclamping"))]
pub struct SegmentNormalKernel {
    /// `None`: zero.
    rows: Option<Arc<Rows>>,
    /// The bend at each cell in degrees.
    bends: Arc<[f64]>,
    mesh: MeshId,
}

impl SegmentNormalKernel {
    pub(super) fn new(rows: Option<Arc<Rows>>, segments: &Segments) -> Self {
        let bends = (0..segments.count()).map(|cell| segments.bend_at(cell));
        Self {
            rows,
            bends: bends.collect(),
            mesh: segments.identity(),
        }
    }

    /// The identity of its cells, see [`Segments::identity`](crate::Segments::identity).
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// The number of cells.
    pub fn vertex_count(&self) -> usize {
        self.mesh.vertices
    }

    /// Whether slip changes no normal stress.
    pub fn is_zero(&self) -> bool {
        self.rows.is_none()
    }

    /// The change of normal stress on cell `i` per slip of cell `j` [Pa/m].
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.rows.as_ref().map_or(0.0, |rows| rows.entry(i, j))
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both. Allocates nothing.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, 1>], normal_stress: &mut [f64]) {
        let Some(rows) = &self.rows else {
            return;
        };
        for (i, value) in normal_stress.iter_mut().enumerate() {
            *value += scale * rows.product_at(i, slip);
        }
    }
}

impl From<&SegmentNormalKernel> for DMatrix<f64> {
    fn from(normal: &SegmentNormalKernel) -> Self {
        let count = normal.vertex_count();
        Self::from_fn(count, count, |i, j| normal.entry(i, j))
    }
}

impl NormalStressChange<1> for SegmentNormalKernel {
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        Some(self.mesh())
    }

    /// That of [`Segments::bend_at`](crate::Segments::bend_at), from 0.001 degrees on.
    fn bend(&self, vertex: usize) -> Option<f64> {
        let bend = self.bends.get(vertex).copied();
        bend.filter(|bend| *bend >= 1e-3)
    }

    fn add(&self, scale: f64, slip: &[SVector<f64, 1>], normal_stress: &mut [f64]) {
        self.multiply_add(scale, slip, normal_stress);
    }
}
