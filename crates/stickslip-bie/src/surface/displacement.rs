//! The displacement of a triangular or rectangular dislocation in a whole space and in a half space `z <= 0`.
//!
//! With the solid angle `Omega` of the cell, positive on the side to which its normal points, slip `b`, tangents `t` of
//! its edges, `r` from an edge to the point, `R = |r|` and `w = b x t` (J. Burgers; T. Mura, Micromechanics of defects in
//! solids, 1987):
//!
//! ```text
//! u = b Omega/(4 pi) + 1/(4 pi) sum over edges, integral ds { w/R - [w/R - (w.r) r/R^3]/(2 (1 - nu)) }
//! ```

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::harmonic;

/// In a whole space, per unit slip: slip of the side to which `(v1 - v0) x (v2 - v0)` points, relative to the other.
///
/// A point in the cell belongs to one of its sides; it is not at an edge. Four corners are those of a rectangle.
pub(crate) fn whole_space<const K: usize>(
    corners: &[[f64; 3]; K],
    slip: [f64; 3],
    poisson_ratio: f64,
    point: [f64; 3],
) -> [f64; 3] {
    let (b, point) = (Vector3::from(slip), Vector3::from(point));
    let corners = corners.map(|corner| Vector3::from(corner) - point);
    let mut sum = -solid_angle(&corners) * b;
    let share = 0.5 / (1.0 - poisson_ratio);
    for n in 0..K {
        let (begin, end) = (corners[n], corners[(n + 1) % K]);
        let length = (end - begin).norm();
        let t = (end - begin) / length;
        // Along the edge from the foot of the point; d to the point.
        let ends = [begin.dot(&t), end.dot(&t)];
        let d = t * ends[0] - begin;
        let w = b.cross(&t);
        let [j10, j30, j31] = integrals(ends, [begin.norm(), end.norm()], &d);
        let gradient = w * j10 - (d * j30 - t * j31) * w.dot(&d);
        sum += gradient * share - w * j10;
    }
    (sum / (-4.0 * PI)).into()
}

/// In a half space `z <= 0` that is free of traction at `z = 0`, per unit slip.
pub(crate) fn half_space<const K: usize>(
    corners: &[[f64; 3]; K],
    slip: [f64; 3],
    poisson_ratio: f64,
    point: [f64; 3],
) -> [f64; 3] {
    let [x, y, z] = point;
    let direct = whole_space(corners, slip, poisson_ratio, point);
    let image = whole_space(corners, slip, poisson_ratio, [x, y, -z]);
    let [harmonic] = harmonic::displacement(corners, &[slip], poisson_ratio, point);
    let signs = [1.0, 1.0, -1.0];
    std::array::from_fn(|i| direct[i] + signs[i] * image[i] + harmonic[i])
}

/// The solid angle of a triangle or a rectangle as seen from the origin, positive where its corners run counterclockwise.
fn solid_angle<const K: usize>(corners: &[Vector3<f64>; K]) -> f64 {
    match corners[..] {
        [a, b, c] => of_triangle(&[a, b, c]),
        [a, b, c, d] => of_rectangle(&[a, b, c, d]),
        _ => f64::NAN,
    }
}

/// Source: A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983), doi:10.1109/TBME.1983.325207.
fn of_triangle(corners: &[Vector3<f64>; 3]) -> f64 {
    let [a, b, c] = corners;
    let [na, nb, nc] = corners.map(|corner| corner.norm());
    let volume = Matrix3::from_columns(corners).determinant();
    let sum = na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb;
    // Seen from the side of the normal, the volume is negative.
    -2.0 * volume.atan2(sum)
}

/// The sum of `atan(x y/(q r))` over the corners at `x`, `y` in the plane, at the distance `q` from it: without the diagonal
/// of two triangles, beside which their angles have large errors.
fn of_rectangle([a, b, _, d]: &[Vector3<f64>; 4]) -> f64 {
    let (u, v) = ((b - a).normalize(), (d - a).normalize());
    let q = -a.dot(&u.cross(&v));
    let side = if q < 0.0 { -1.0 } else { 1.0 };
    let mut sum = 0.0;
    for (x, sign) in [(b.dot(&u), 1.0), (a.dot(&u), -1.0)] {
        for (y, sign) in [(d.dot(&v), sign), (a.dot(&v), -sign)] {
            let r = (x * x + y * y + q * q).sqrt();
            sum += sign * (x * y).atan2(q.abs() * r);
        }
    }
    side * sum
}

/// Integrals of `1/R`, `1/R^3` and `s/R^3` between the ends of an edge, without cancellation on its continuation.
fn integrals([s1, s2]: [f64; 2], [r1, r2]: [f64; 2], d: &Vector3<f64>) -> [f64; 3] {
    // ln(R + s) or, behind the foot, -ln(R - s).
    let j10 = match (s1 >= 0.0, s2 >= 0.0) {
        (true, _) => ((r2 + s2) / (r1 + s1)).ln(),
        (false, false) => ((r1 - s1) / (r2 - s2)).ln(),
        (false, true) => ((r2 + s2) * (r1 - s1) / d.norm_squared()).ln(),
    };
    // s/(d^2 R) less its limit.
    let rest = |s: f64, r: f64| {
        let size = (r * (r + s.abs())).recip();
        if s >= 0.0 { -size } else { size }
    };
    let both = if s1 < 0.0 && s2 >= 0.0 {
        2.0 / d.norm_squared()
    } else {
        0.0
    };
    let j30 = rest(s2, r2) - rest(s1, r1) + both;
    [j10, j30, r1.recip() - r2.recip()]
}

#[cfg(test)]
mod tests;
