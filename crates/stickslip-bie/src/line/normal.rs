//! The normal stress of slip on a dipping fault.

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{MeshId, NormalStressChange};

use super::low_rank::LowRank;
use crate::Cells;

/// The change of normal stress on the cells of a [`DippingFault`](crate::DippingFault) per slip [Pa/m], compression
/// positive: `N` in `sigma = sigma0 + N D`.
///
/// It is the part of the images alone, of low rank: a plane in a whole space does not clamp itself. It is zero for a
/// vertical fault, and has no symmetry.
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("clamping", "unclamping"))]
pub struct DippingNormalKernel {
    /// Forces on cells.
    image: LowRank,
    length: f64,
    mesh: MeshId,
}

impl DippingNormalKernel {
    pub(crate) fn new(image: LowRank, cells: &Cells) -> Self {
        let (length, mesh) = (cells.length(), cells.identity());
        Self {
            image,
            length,
            mesh,
        }
    }

    /// The identity of its cells, see [`Cells::identity`].
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// The number of cells.
    pub fn vertex_count(&self) -> usize {
        self.image.count()
    }

    /// `normal_stress += scale N slip` \[Pa\], one number per cell in both. Allocates nothing.
    pub fn multiply_add(&self, scale: f64, slip: &[SVector<f64, 1>], normal_stress: &mut [f64]) {
        let scale = scale / self.length;
        (self.image).product(scale, slip, |i, value| normal_stress[i] += value);
    }
}

impl From<&DippingNormalKernel> for DMatrix<f64> {
    fn from(normal: &DippingNormalKernel) -> Self {
        let count = normal.vertex_count();
        Self::from_fn(count, count, |i, j| {
            normal.image.entry(i, j) / normal.length
        })
    }
}

impl NormalStressChange<1> for DippingNormalKernel {
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        Some(self.mesh())
    }

    fn add(&self, scale: f64, slip: &[SVector<f64, 1>], normal_stress: &mut [f64]) {
        self.multiply_add(scale, slip, normal_stress);
    }
}
