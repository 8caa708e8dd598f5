//! Initial shear stresses, which are tangential to their surface.

use nalgebra::SVector;

use crate::{BoundaryPart, ShearAlongNormal};

/// The part of a shear stress along the normal that rounding of its direction to three digits leaves, relative to it.
/// Without it the shear stress has the same size up to half its square, 5e-7.
const ROUNDED: f64 = 1e-3;

/// Refuses a shear stress with a part along the contact's own normal. Antiplane stresses have none.
pub(crate) fn check_tangential<const C: usize>(
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
