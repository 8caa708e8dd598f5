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

/// `x <= 0`: Halley's method on `w exp(w) = exp(x)`. Here the rounding of `x - w` would turn into a
/// relative error of `w`, so `x` is exponentiated as it is.
fn omega_left(x: f64) -> f64 {
    let y = x.exp();
    if y < 1e-9 {
        // The next term is 3/2 y^3.
        return y - y * y;
    }
    // A Pade approximant of W at 0, to 0.6 % on [0, 1].
    let mut w = y * (60.0 + y * (114.0 + 17.0 * y)) / (60.0 + y * (174.0 + 101.0 * y));
    for _ in 0..2 {
        // w - y is exact, and the rounding of exp(w) - 1 counts little.
        let e = w.exp_m1();
        let residual = (w - y) + w * e;
        let step = residual / ((1.0 + e) * (1.0 + w) - 0.5 * residual * (2.0 + w) / (1.0 + w));
        w -= step;
        // The method is of third order.
        if step.abs() <= 1e-6 * w {
            break;
        }
    }
    w
}

/// `x > 0`: the fourth-order iteration of Fritsch, Shafer and Crowley on `w + ln w = x`. Here
/// `x - w` is exact or its rounding harmless.
fn omega_right(x: f64) -> f64 {
    let mut w = if x < 3.0 {
        // Taylor at x = 1, to 0.3 %.
        let t = x - 1.0;
        1.0 + t * (0.5 + t * (1.0 / 16.0 - t * (1.0 / 192.0 + t / 3072.0)))
    } else {
        // Asymptotic, to 0.5 %.
        let l = x.ln();
        x - l + l / x * (1.0 + (0.5 * l - 1.0) / x)
    };
    for _ in 0..2 {
        let r = x - w - w.ln();
        let p = 1.0 + w;
        let t = p * (p + r * (2.0 / 3.0));
        w += w * (r / p) * (t - 0.5 * r) / (t - r);
        // The relative error left is below r^4 / 100.
        if r.abs() <= 2e-4 {
            break;
        }
    }
    w
}
