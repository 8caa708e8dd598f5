//! A shear stress that is not tangential.

use stickslip_state::Number;
use thiserror::Error;

/// An initial shear stress with a part along the normal of its contact, which friction cannot balance.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "the initial shear stress {shear:?} Pa of a contact at vertex {vertex} has a part of {} Pa along the normal \
     {normal:?}: give its tangential part, or the stress of the body by Contact::with_prestress",
    Number(*.along)
)]
#[non_exhaustive]
pub struct ShearAlongNormal {
    /// The vertex.
    pub vertex: usize,
    /// The shear stress \[Pa\].
    pub shear: [f64; 3],
    /// The outward normal.
    pub normal: [f64; 3],
    /// The part of the shear stress along the normal \[Pa\].
    pub along: f64,
}
