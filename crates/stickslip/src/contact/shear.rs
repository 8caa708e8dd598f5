//! Initial shear stresses, which are tangential to their surface.

use nalgebra::SVector;
use stickslip_state::Number;
use thiserror::Error;

use crate::BoundaryPart;

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

/// The part of a shear stress along the normal that rounding of its direction to three digits leaves, relative to it.
/// Without it the shear stress has the same size up to half its square, 5e-7.
const ROUNDED: f64 = 1e-3;

/// Refuses a shear stress with a part along the contact's own normal. Antiplane stresses have none.
pub(super) fn check_tangential<const C: usize>(
    part: &BoundaryPart,
    k: usize,
    shear: &SVector<f64, C>,
) -> Result<(), ShearAlongNormal> {
    let (Some(&normal), true) = (part.normals.get(k), C == part.dimension) else {
        return Ok(());
    };
    let along: f64 = shear.iter().zip(normal).map(|(stress, n)| stress * n).sum();
    if along.abs() <= ROUNDED * shear.norm() {
        return Ok(());
    }
    Err(ShearAlongNormal {
        vertex: part.vertices[k],
        shear: std::array::from_fn(|c| shear.get(c).copied().unwrap_or(0.0)),
        normal,
        along,
    })
}
