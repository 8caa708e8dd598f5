//! The motion of two blocks beside a plane.

use nalgebra::Vector3;

/// The blocks beside an infinite plane, which slip of all of it moves by one half each, as rigid bodies: without stress, and
/// without traction at a free surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Blocks<const C: usize> {
    /// A point of the plane, and its unit normal into the block that slip moves.
    pub(crate) at: Vector3<f64>,
    pub(crate) normal: Vector3<f64>,
    /// The directions of slip.
    pub(crate) slips: [Vector3<f64>; C],
}

impl<const C: usize> Blocks<C> {
    /// The displacement at a point of each slip; a point of the plane is in the block that slip moves.
    pub(super) fn displacement(&self, point: &Vector3<f64>) -> [Vector3<f64>; C] {
        let side = (point - self.at).dot(&self.normal);
        let half = if side < 0.0 { -0.5 } else { 0.5 };
        self.slips.map(|slip| slip * half)
    }
}
