//! Normal stress that follows the displacement, as a matrix of one row a vertex.

use std::sync::Arc;

use nalgebra::SVector;

use crate::MeshId;

/// A linear change of the normal stress with the displacement, compression positive: `N` in
///
/// ```text
/// sigma_n = sigma_n0(t) + N (u - V_p t)
/// ```
///
/// Faults by boundary integrals make one: `DippingFault::normal_stiffness`, `SegmentFault::normal_stiffness`,
/// `PlaneFault::normal_stiffness`, `FaultSystem::normal_stiffness`. An own implementation adds one number per vertex:
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_solvers::NormalStressChange;
///
/// /// A pressure that grows with the displacement of its own vertex [Pa/m].
/// struct Wedge(f64);
///
/// impl NormalStressChange<1> for Wedge {
///     fn vertex_count(&self) -> usize {
///         1
///     }
///
///     fn add(&self, scale: f64, displacement: &[Vector1<f64>], normal_stress: &mut [f64]) {
///         normal_stress[0] += scale * self.0 * displacement[0][0];
///     }
/// }
/// ```
pub trait NormalStressChange<const C: usize>: Send + Sync {
    /// The number of vertices of the body.
    fn vertex_count(&self) -> usize;

    /// The cells that it belongs to; `None` by default, if unknown. A scene refuses those of another fault.
    fn mesh(&self) -> Option<MeshId> {
        None
    }

    /// The angle by which the fault bends at a vertex \[degrees\], which names the cause of a normal stress that vanishes;
    /// `None` by default, for straight faults.
    fn bend(&self, _vertex: usize) -> Option<f64> {
        None
    }

    /// `normal_stress += scale N displacement` \[Pa\], one number per vertex of the body. It is called in every stage
    /// and should not allocate.
    fn add(&self, scale: f64, displacement: &[SVector<f64, C>], normal_stress: &mut [f64]);
}

impl<T: NormalStressChange<C> + ?Sized, const C: usize> NormalStressChange<C> for Arc<T> {
    fn vertex_count(&self) -> usize {
        (**self).vertex_count()
    }

    fn mesh(&self) -> Option<MeshId> {
        (**self).mesh()
    }

    fn bend(&self, vertex: usize) -> Option<f64> {
        (**self).bend(vertex)
    }

    fn add(&self, scale: f64, displacement: &[SVector<f64, C>], normal_stress: &mut [f64]) {
        (**self).add(scale, displacement, normal_stress);
    }
}
