//! The components of a boundary condition.

use std::ops::BitOr;

use nalgebra::SVector;

/// A set of components of a displacement or a velocity.
///
/// ```
/// use stickslip::Components;
///
/// assert_eq!(Components::<3>::X | Components::Z, Components::from([true, false, true]));
/// assert_eq!(Components::<2>::X | Components::Y, Components::ALL);
/// ```
///
/// A component that does not exist in the dimension does not compile:
///
/// ```compile_fail
/// let _ = stickslip::Components::<2>::Z;
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Components<const C: usize>(pub(crate) [bool; C]);

impl<const C: usize> Components<C> {
    /// All components.
    pub const ALL: Self = Self([true; C]);
    /// No component.
    pub const NONE: Self = Self([false; C]);
    /// The first component; the only one in antiplane strain.
    pub const X: Self = Self::only(0);
    /// The second component.
    pub const Y: Self = Self::only(1);
    /// The third component.
    pub const Z: Self = Self::only(2);

    const fn only(component: usize) -> Self {
        let mut set = [false; C];
        set[component] = true;
        Self(set)
    }
}

impl<const C: usize> From<[bool; C]> for Components<C> {
    fn from(components: [bool; C]) -> Self {
        Self(components)
    }
}

impl<const C: usize> BitOr for Components<C> {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(std::array::from_fn(|c| self.0[c] || other.0[c]))
    }
}

/// The smallest remainder of a direction that is independent of the others.
pub(crate) const NEW: f64 = 1e-6;

/// The components of a vertex to which a direction contributes.
pub(crate) fn components_of<const C: usize>(direction: &SVector<f64, C>) -> [bool; C] {
    std::array::from_fn(|c| direction[c].abs() > NEW)
}
