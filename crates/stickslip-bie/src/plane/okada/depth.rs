//! Okada's part that is multiplied by the depth.

use super::corner::Corner;
use super::{Dip, Part};

/// `uC` at the height `z`, first itself, then its derivatives.
pub(super) fn gradients(dip: &Dip, at: &Corner, z: f64) -> ([[f64; 3]; 2], Part) {
    let &Dip { alpha, cos, sin } = dip;
    let &Corner {
        xi,
        eta,
        q,
        r,
        y,
        d,
        x11,
        x32,
        x53,
        y11,
        y32,
        y53,
    } = at;
    let (a4, a5) = (1.0 - alpha, alpha);
    let (r2, r3) = (r * r, r * r * r);
    let r5 = r2 * r3;
    let c = d + z;
    let h = q * cos - z;
    let z32 = sin / r3 - h * y32;
    let z53 = 3.0 * sin / r5 - h * y53;
    let y0 = y11 - xi * xi * y32;
    let z0 = z32 - xi * xi * z53;
    let ppy = cos / r3 + q * y32 * sin;
    let ppz = sin / r3 - q * y32 * cos;
    let qq = z * y32 + z32 + z0;
    let qqy = 3.0 * c * d / r5 - qq * sin;
    let qqz = 3.0 * c * y / r5 - qq * cos + q * y32;
    let (xy, qy) = (xi * y11, q * y11);
    let qr = 3.0 * q / r5;
    let cdr = (c + d) / r3;
    let yy0 = y / r3 - y0 * cos;
    let displacement = [
        [
            a4 * xy * cos - a5 * xi * q * z32,
            a4 * (cos / r + 2.0 * qy * sin) - a5 * c * q / r3,
            a4 * qy * cos - a5 * (c * eta / r3 - z * y11 + xi * xi * z32),
        ],
        [
            a4 * cos / r - qy * sin - a5 * c * q / r3,
            a4 * y * x11 - a5 * c * eta * q * x32,
            -d * x11 - xy * sin - a5 * c * (x11 - q * q * x32),
        ],
    ];
    let strike = [
        [
            a4 * y0 * cos - a5 * q * z0,
            -a4 * xi * (cos / r3 + 2.0 * q * y32 * sin) + a5 * c * xi * qr,
            -a4 * xi * q * y32 * cos + a5 * xi * (3.0 * c * eta / r5 - qq),
        ],
        [
            -a4 * xi * ppy * cos - a5 * xi * qqy,
            a4 * 2.0 * (d / r3 - y0 * sin) * sin
                - y / r3 * cos
                - a5 * (cdr * sin - eta / r3 - c * y * qr),
            -a4 * q / r3 + yy0 * sin + a5 * (cdr * cos + c * d * qr - (y0 * cos + q * z0) * sin),
        ],
        [
            a4 * xi * ppz * cos - a5 * xi * qqz,
            a4 * 2.0 * (y / r3 - y0 * cos) * sin + d / r3 * cos - a5 * (cdr * cos + c * d * qr),
            yy0 * cos - a5 * (cdr * sin - c * y * qr - y0 * sin * sin + q * z0 * cos),
        ],
    ];
    let up_dip = [
        [
            -a4 * xi / r3 * cos + a5 * c * xi * qr + xi * q * y32 * sin,
            -a4 * y / r3 + a5 * c * eta * qr,
            d / r3 - y0 * sin + a5 * c / r3 * (1.0 - 3.0 * q * q / r2),
        ],
        [
            -a4 * eta / r3 + y0 * sin * sin - a5 * (cdr * sin - c * y * qr),
            a4 * (x11 - y * y * x32) - a5 * c * ((d + 2.0 * q * cos) * x32 - y * eta * q * x53),
            xi * ppy * sin + y * d * x32 + a5 * c * ((y + 2.0 * q * sin) * x32 - y * q * q * x53),
        ],
        [
            -q / r3 + y0 * sin * cos - a5 * (cdr * cos + c * d * qr),
            a4 * y * d * x32 - a5 * c * ((y - 2.0 * q * sin) * x32 + d * eta * q * x53),
            -xi * ppz * sin + x11
                - d * d * x32
                - a5 * c * ((d - 2.0 * q * cos) * x32 - d * q * q * x53),
        ],
    ];
    (displacement, [strike, up_dip])
}
