//! Okada's part of the free surface.

use super::corner::{Corner, shared, sum_with_distance};
use super::{Dip, Part};

/// The derivatives of `uB` (Okada's Tables 7 to 9).
///
/// With `c = cos(dip)`, `s = sin(dip)`, `R' = R + d`, `R'' = R + eta` and the identities `1 - s = c^2/(1 + s)`,
/// `eta = y c + d s`, `q = y s - d c`, the quotients of Table 8 are
///
/// ```text
/// K1 = xi (R c/(1+s) + y)/(R R' R''),    K3 = (R (q c/(1+s) - eta) - q^2 - eta^2)/(R R' R'')
/// J3 = (K1 - s J2)/c = xi [R R'/(1+s) + y (R c/(1+s) - q)]/(R R'^2 R'')
/// J6 = (K3 - s J5)/c = [R' (R q/(1+s) - R y + s d y - c d^2) - y^2 (R c/(1+s) + d c - s y)]/(R R'^2 R'')
/// ```
pub(super) fn gradients(dip: &Dip, at: &Corner) -> Part {
    let &Dip { alpha, cos, sin } = dip;
    let &Corner {
        xi,
        eta,
        q,
        r,
        y,
        d,
        x11,
        y11,
        y32,
        ..
    } = at;
    let a3 = (1.0 - alpha) / alpha;
    let r3 = r * r * r;
    let (rd, re) = (r + d, sum_with_distance(r, eta, xi * xi + q * q));
    let d11 = 1.0 / (r * rd);
    let tilt = cos / (1.0 + sin);
    let j2 = xi * y / rd * d11;
    let j5 = -(d + y * y / rd) * d11;
    let k1 = xi * (r * tilt + y) * d11 / re;
    let k3 = (r * (q * tilt - eta) - q * q - eta * eta) * d11 / re;
    let share = d11 / (rd * re);
    let j3 = xi * (r * rd / (1.0 + sin) + y * (r * tilt - q)) * share;
    let j6 = (rd * (r * q / (1.0 + sin) - r * y + sin * d * y - cos * d * d)
        - y * y * (r * tilt + d * cos - sin * y))
        * share;
    let (xy, qy) = (xi * y11, q * y11);
    let k2 = 1.0 / r + k3 * sin;
    let k4 = xy * cos - k1 * sin;
    let j1 = j5 * cos - j6 * sin;
    let j4 = -xy - j2 * cos + j3 * sin;
    let [ey, ez, fy, fz, gy, gz] = shared(dip, at);
    let (b, c) = (a3 * sin, a3 * sin * cos);
    [
        [
            [
                xi * xi * q * y32 - b * j1,
                xi * q / r3 - b * j2,
                -xi * q * q * y32 - b * j3,
            ],
            [
                -xi * fy - d * x11 + b * (xy + j4),
                -ey + b * (1.0 / r + j5),
                q * fy - b * (qy - j6),
            ],
            [
                -xi * fz - y * x11 + b * k1,
                -ez + b * y * d11,
                q * fz + b * k2,
            ],
        ],
        [
            [
                xi * q / r3 + c * j4,
                eta * q / r3 + qy + c * j5,
                -q * q / r3 + c * j6,
            ],
            [-ey + c * j1, -eta * gy - xy * sin + c * j2, q * gy + c * j3],
            [
                -ez - c * k3,
                -eta * gz - xy * cos - c * xi * d11,
                q * gz - c * k4,
            ],
        ],
    ]
}
