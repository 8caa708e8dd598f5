//! What a nonsmooth Newton method hands to the levels.

use nalgebra::SMatrix;

/// The second-order model of friction at the current iterate, one entry per frictional vertex.
pub(crate) struct Linearization<'a, const C: usize> {
    pub(crate) vertices: &'a [usize],
    pub(crate) hessians: &'a [SMatrix<f64, C, C>],
    /// The components that are fixed or truncated.
    pub(crate) dropped: &'a [[bool; C]],
}
