//! Wright's omega function on the real line, and its logarithm.

/// Wright's omega function `W(exp(x))`, the positive `w` with `w + ln w = x`.
///
/// Accurate to 2 units in the last place for every `x`, without overflow:
/// `exp(x)` below 0, `x - ln x` far above. It underflows to 0 with `exp(x)`, below -745.
///
/// ```
/// # use stickslip_state::wright::omega;
/// assert_eq!(omega(1.0), 1.0);
/// assert!((omega(1e6) + omega(1e6).ln() - 1e6).abs() < 1e-9);
/// ```
#[must_use]
pub fn omega(x: f64) -> f64 {
    if x <= 0.0 {
        omega_left(x)
    } else if x > 1e17 {
        // ln w = ln x to rounding; the iteration would overflow above 1e154.
        if x == f64::INFINITY { x } else { x - x.ln() }
    } else {
        omega_right(x)
    }
}

/// The logarithm of [`omega`], the `z` with `z + exp(z) = x`.
///
/// Accurate to a few units in the last place for every `x`, also around its zero `x = 1`.
///
/// ```
/// # use stickslip_state::wright::ln_omega;
/// assert_eq!(ln_omega(1.0), 0.0);
/// assert_eq!(ln_omega(-1e6), -1e6);
/// ```
#[must_use]
pub fn ln_omega(x: f64) -> f64 {
    if x <= 0.0 {
        // Both terms are negative.
        x - omega(x)
    } else if x < 4.0 {
        // x - omega cancels at x = 1; one Newton step on z + expm1(z) = x - 1, where x - 1 is exact
        // or harmless, restores the relative accuracy.
        let z = x - omega(x);
        let e = z.exp_m1();
        z + (x - 1.0 - z - e) / (2.0 + e)
    } else {
        omega(x).ln()
    }
}

/// `x <= 0`. Here the rounding of `x - w` would turn into a relative error of `w`, so `x` is exponentiated as it is.
fn omega_left(x: f64) -> f64 {
    lambert(x.exp())
}

/// Lambert's function `W(y)`, the `w` with `w exp(w) = y`, for `0 <= y <= 1`: a series near 0, and Halley's method.
///
/// Accurate to 2 units in the last place.
pub(crate) fn lambert(y: f64) -> f64 {
    if y < 1.0 / 64.0 {
        // sum_n (-n)^(n - 1) y^n/n!; what is left out is below 1e-18 of it.
        let z = y * y;
        let odd = 1.0
            + z * (1.5
                + z * (125.0 / 24.0
                    + z * (16807.0 / 720.0
                        + z * (531441.0 / 4480.0 + z * (2_357_947_691.0 / 3_628_800.0)))));
        let even = 1.0
            + z * (8.0 / 3.0
                + z * (54.0 / 5.0
                    + z * (16384.0 / 315.0
                        + z * (156_250.0 / 567.0 + z * (2_985_984.0 / 1925.0)))));
        return y * odd - z * even;
    }
    // Fitted to W on [0, 1], to 1.3e-6 of it; one step of third order leaves less than 2e-19.
    let w = y * (1.0 + y * (2.02893 + y * 0.614449))
        / (1.0 + y * (3.02886 + y * (2.14523 + y * 0.250007)));
    // w - y is exact, and the rounding of exp(w) counts with a share of w.
    let e = w.exp() - 1.0;
    let residual = (w - y) + w * e;
    w - residual / ((1.0 + e) * (1.0 + w) - 0.5 * residual * (2.0 + w) / (1.0 + w))
}

/// `x > 0`: the fourth-order iteration of Fritsch, Shafer and Crowley on `w + ln w = x`. Here
/// `x - w` is exact or its rounding harmless.
fn omega_right(x: f64) -> f64 {
    // Starts with a residual below 2e-4, of which one step leaves less than 1e-19.
    let w = if x < 8.0 {
        // Fitted to omega on [0, 8], to 3.5e-5.
        let t = x - 1.0;
        (0.99997575 + t * (0.84121997 + t * (0.26819459 + t * 0.03348468)))
            / (1.0 + t * (0.34115841 + t * 0.03495037))
    } else {
        // Asymptotic, to 2.6e-5.
        let l = x.ln();
        x - l + l / x * (1.0 + (0.5 * l - 1.0 + (1.0 + l * (l / 3.0 - 1.5)) / x) / x)
    };
    let r = x - w - w.ln();
    let p = 1.0 + w;
    let t = p * (p + r * (2.0 / 3.0));
    w + w * (r / p) * (t - 0.5 * r) / (t - r)
}
