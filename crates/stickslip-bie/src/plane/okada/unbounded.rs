//! Okada's part of an unbounded medium.

use super::corner::{Corner, shared};
use super::{Dip, Part};

/// The derivatives of `uA` (Okada's Tables 7 to 9).
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
    let (a1, a2) = (0.5 * (1.0 - alpha), 0.5 * alpha);
    let r3 = r * r * r;
    let (xy, qy) = (xi * y11, q * y11);
    let [ey, ez, fy, fz, gy, gz] = shared(dip, at);
    [
        [
            [
                -a1 * qy - a2 * xi * xi * q * y32,
                -a2 * xi * q / r3,
                a1 * xy + a2 * xi * q * q * y32,
            ],
            [
                a1 * xy * sin + a2 * xi * fy + 0.5 * d * x11,
                a2 * ey,
                a1 * (cos / r + qy * sin) - a2 * q * fy,
            ],
            [
                a1 * xy * cos + a2 * xi * fz + 0.5 * y * x11,
                a2 * ez,
                -a1 * (sin / r - qy * cos) - a2 * q * fz,
            ],
        ],
        [
            [
                -a2 * xi * q / r3,
                -0.5 * qy - a2 * eta * q / r3,
                a1 / r + a2 * q * q / r3,
            ],
            [
                a2 * ey,
                a1 * d * x11 + 0.5 * xy * sin + a2 * eta * gy,
                a1 * y * x11 - a2 * q * gy,
            ],
            [
                a2 * ez,
                a1 * y * x11 + 0.5 * xy * cos + a2 * eta * gz,
                -a1 * d * x11 - a2 * q * gz,
            ],
        ],
    ]
}
