//! What planes and a surface do to each other.

use crate::interaction::Interaction;

/// Forces and compressions on planes due to slip on a surface, and on the surface due to slip on planes.
#[derive(Debug)]
pub(crate) struct Coupling<const C: usize> {
    pub(super) on_planes: Interaction<C>,
    pub(super) on_surface: Interaction<C>,
}
