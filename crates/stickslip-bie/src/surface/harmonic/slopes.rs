//! First and second derivatives of the potentials of `end.rs`, of which displacement is made.
//!
//! With `g = ln(A/B)/s`, `S = (1 + c) R + t + Z` and `x = s h/S`:
//!
//! ```text
//! Lambda,h = -(2/s) arctan x     Lambda,e = g + f s l     Lambda,w = -g + f s L
//! Gamma,hh = -(q/A)^2 F(-s q/A) - f (L - Z/A)             F(y) = (ln(1 + y) - y)/y^2
//! Gamma,he = (h/S) [(q - f s (2 A - R))/A - 2 c s (h/S)^2 G(x)]     G(x) = (1 - arctan(x)/x)/x^2
//! ```
//!
//! and `Xi` is `Gamma` with `t` and `z` exchanged. Functions of `s` are regular at 0.

use super::axial::{Axial, Place};
use super::end::Ends;
use super::in_space::{Direction, InSpace};
use super::two::Two;

/// Derivatives of a potential: `h e z hz ez zz`.
pub(super) type Slopes = [Two; 6];

/// Slopes of the three potentials of [`jets`](super::end::jets).
pub(super) fn slopes(ends: &Ends, to: Direction, depth: Two, k: f64) -> [Slopes; 3] {
    let Direction { s, c, f } = to;
    let [l, m] = Axial::pair(&ends.axial);
    let [l, m] = [InSpace::of(to, &l), InSpace::of(to, &m)];
    let Ends {
        e,
        z,
        a,
        b,
        q,
        u,
        ia,
        ..
    } = *ends;
    let Place {
        r,
        t,
        w,
        h,
        inverse: [ir, ib],
    } = ends.axial;
    let (ln_a, ln_b) = (a.map(f64::ln), b.map(f64::ln));
    let g = q * ib * (s * q * ib).map(logarithm);
    let sum = ((1.0 + c) * r + t + z).recip();
    let (share, x) = (h * sum, s * h * sum);
    // Second derivatives of Lambda.
    let lambda_hh = -(u * ia * ib);
    let lambda_he = h * ir * ia * ib * (f * s * a - q);
    let lambda_hw = h * ir * ia * ib * (q + f * s * b);
    let (l_h, l_e) = (h * ir * ib, (e * ir + Two::both(s)) * ib);
    let (l_w, l_z) = (w * ir * ib, (z * ir + Two::both(c)) * ib);
    let lambda_ee = -lambda_hh - l_z;
    // First derivatives of Lambda, second ones of Gamma and Xi.
    let lambda_h = -2.0 * share * x.map(arc);
    let (lambda_e, lambda_w) = (g + f * s * ln_b, f * s * ln_a - g);
    let across = |q: Two, ia: Two, z: Two, ln_a: Two| {
        let share = q * ia;
        -(share.squared() * (-(s * share)).map(curve)) - f * (ln_a - z * ia)
    };
    let aside = |q: Two, a: Two, ia: Two| {
        let straight = (q - f * s * (2.0 * a - r)) * ia;
        share * (straight - (2.0 * c * s) * share.squared() * x.map(bend))
    };
    let (gamma_hh, gamma_he) = (across(q, ia, z, ln_a), aside(q, a, ia));
    let (xi_hh, xi_hw) = (across(-q, ib, t, ln_b), aside(-q, b, ib));
    let gamma_ee = -gamma_hh - ln_b;
    let xi_ww = -xi_hh - ln_a;
    let (xi_he, xi_ew) = (s * lambda_h - c * xi_hw, s * lambda_w - c * xi_ww);
    // Second derivatives of m are those of l along t.
    let (m_h, m_w) = (-(h * ib), -(w * ib));
    let gamma_h = [gamma_hh, gamma_he, lambda_h, lambda_hh, lambda_he, l_h];
    let gamma_e = [gamma_he, gamma_ee, lambda_e, lambda_he, lambda_ee, l_e];
    let of_lambda_h = [lambda_hh, lambda_he, l_h, l.hh, l.he, l.hz];
    let lambda_ew = s * l_e - c * lambda_ee;
    let of_lambda_w = [lambda_hw, lambda_ew, l_w, l.hw, l.ew, l.wz];
    let xi_h = [xi_hh, xi_he, m_h, m.hh, m.he, m.hz];
    let xi_w = [xi_hw, xi_ew, m_w, m.hw, m.ew, m.wz];
    let steep = (k - 2.0) * c;
    [
        gamma_h,
        std::array::from_fn(|n| gamma_h[n] + depth * of_lambda_h[n] + c * xi_h[n]),
        std::array::from_fn(|n| steep * gamma_e[n] - k * (depth * of_lambda_w[n] + c * xi_w[n])),
    ]
}

/// `ln(1 + x)/x`.
fn logarithm(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.ln_1p() / x }
}

/// `arctan(x)/x`.
fn arc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.atan() / x }
}

/// Where series replace differences that cancel, and their terms for 16 digits there.
const SMALL: f64 = 0.125;
const TERMS: i32 = 18;

/// `(ln(1 + x) - x)/x^2`.
fn curve(x: f64) -> f64 {
    if x.abs() > SMALL {
        return (x.ln_1p() - x) / (x * x);
    }
    (0..TERMS)
        .rev()
        .fold(0.0, |sum, n| -1.0 / f64::from(n + 2) - x * sum)
}

/// `(1 - arctan(x)/x)/x^2`.
fn bend(x: f64) -> f64 {
    if x.abs() > SMALL {
        return (1.0 - x.atan() / x) / (x * x);
    }
    (0..TERMS / 2)
        .rev()
        .fold(0.0, |sum, n| 1.0 / f64::from(2 * n + 3) - x * x * sum)
}
