//! What all parts share of a corner.

use super::Dip;

/// A corner as seen from a point: `xi` along strike, `eta` up dip, `q` along the normal, with the powers of the
/// distance that all parts share. Names are Okada's.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) xi: f64,
    pub(super) eta: f64,
    pub(super) q: f64,
    pub(super) r: f64,
    /// `eta cos + q sin`, `eta sin - q cos`.
    pub(super) y: f64,
    pub(super) d: f64,
    pub(super) x11: f64,
    pub(super) x32: f64,
    pub(super) x53: f64,
    pub(super) y11: f64,
    pub(super) y32: f64,
    pub(super) y53: f64,
}

/// `r + a` for `r^2 = a^2 + square`, without cancellation.
pub(super) fn sum_with_distance(r: f64, a: f64, square: f64) -> f64 {
    if a < 0.0 { square / (r - a) } else { r + a }
}

/// `[1/(r (r + a)), (2 r + a)/(r^3 (r + a)^2), (8 r^2 + 9 r a + 3 a^2)/(r^5 (r + a)^3)]`.
///
/// Each of them is a function of `square = r^2 - a^2` alone, infinite at 0, less its own value at `-a`. Where both ends
/// of an edge are `behind` a point, `a < 0`, these functions cancel in the difference of the ends; rounding would be all
/// that is left of them near the extension of the edge. There they are left out.
fn inverse_powers(r: f64, a: f64, square: f64, behind: bool) -> [f64; 3] {
    if behind {
        return inverse_powers(r, -a, square, false).map(|value| -value);
    }
    let first = 1.0 / (r * sum_with_distance(r, a, square));
    [
        first,
        (2.0 * r + a) * first * first / r,
        (8.0 * r * r + 9.0 * r * a + 3.0 * a * a) * first * first * first / (r * r),
    ]
}

impl Corner {
    pub(super) fn new(dip: &Dip, [xi, eta, q]: [f64; 3], behind: [bool; 2]) -> Self {
        let r = (xi * xi + eta * eta + q * q).sqrt();
        let [x11, x32, x53] = inverse_powers(r, xi, eta * eta + q * q, behind[0]);
        let [y11, y32, y53] = inverse_powers(r, eta, xi * xi + q * q, behind[1]);
        Self {
            xi,
            eta,
            q,
            r,
            y: eta * dip.cos + q * dip.sin,
            d: eta * dip.sin - q * dip.cos,
            x11,
            x32,
            x53,
            y11,
            y32,
            y53,
        }
    }
}

/// Okada's `E`, `F`, `G` and their primes.
pub(super) fn shared(dip: &Dip, at: &Corner) -> [f64; 6] {
    let &Dip { cos, sin, .. } = dip;
    let &Corner {
        xi,
        q,
        r,
        y,
        d,
        x11,
        x32,
        y32,
        ..
    } = at;
    let r3 = r * r * r;
    [
        sin / r - y * q / r3,
        cos / r + d * q / r3,
        d / r3 + xi * xi * y32 * sin,
        y / r3 + xi * xi * y32 * cos,
        2.0 * x11 * sin - y * q * x32,
        2.0 * x11 * cos + d * q * x32,
    ]
}
