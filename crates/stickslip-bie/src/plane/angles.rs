//! Angles in degrees.

/// `[cos, sin]` of an angle in degrees, exact at multiples of 90.
pub(crate) fn cos_sin(degrees: f64) -> [f64; 2] {
    let turned = degrees.rem_euclid(360.0);
    if turned == 0.0 {
        [1.0, 0.0]
    } else if turned == 90.0 {
        [0.0, 1.0]
    } else if turned == 180.0 {
        [-1.0, 0.0]
    } else if turned == 270.0 {
        [0.0, -1.0]
    } else {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [cos, sin]
    }
}
