//! The length of a velocity.

use nalgebra::SVector;

/// `abs(v)`, the Euclidean norm, also of vectors whose squares underflow or overflow.
///
/// ```
/// use nalgebra::SVector;
/// use stickslip_friction::modulus;
///
/// assert_eq!(modulus(&SVector::from([3e-200, 4e-200])), 5e-200);
/// ```
#[inline]
pub fn modulus<const C: usize>(v: &SVector<f64, C>) -> f64 {
    if C == 1 {
        return v[0].abs();
    }
    let square = v.norm_squared();
    if (1e-280..1e280).contains(&square) {
        return square.sqrt();
    }
    let largest = v.amax();
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * (v / largest).norm()
}
