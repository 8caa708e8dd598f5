//! The method in time: TR-BDF2 (Bank et al., IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl. Numer. Math. 20, 1996).
//!
//! For `C p' = f(p, t)`, with `gamma = 2 - sqrt(2)` and `q = gamma dt/2`: the trapezoidal rule up to `gamma dt`, then the
//! second backward difference. Both in increments, so that rounding is that of the change of a step:
//!
//! ```text
//! C d1 = q [f(p) + f(p + d1, t + gamma dt)],     C d = C d1/(gamma (2 - gamma)) + q f(p + d, t + dt)
//! ```
//!
//! It is L-stable, of second order, and integrates sources that are linear in time exactly.

use std::f64::consts::SQRT_2;

/// The share of the first stage.
pub(super) const GAMMA: f64 = 2.0 - SQRT_2;
/// `gamma/2`: the coefficient of both stages.
pub(super) const HALF: f64 = 0.5 * GAMMA;
/// `1/(gamma (2 - gamma))`, the weight of the first increment in the second stage.
pub(super) const FIRST: f64 = 1.0 / (GAMMA * (2.0 - GAMMA));
/// The weights of the rates at the start, at `gamma dt` and at the end in an integral over a step.
pub(super) const WEIGHTS: [f64; 3] = [SQRT_2 / 4.0, SQRT_2 / 4.0, HALF];

/// The weights of the three rates in the estimated error of the end, over `dt`:
/// `2 k [f_0/gamma - f_gamma/(gamma (1 - gamma)) + f_1/(1 - gamma)]`,
/// `k = (3 gamma^2 - 4 gamma + 2)/(12 (2 - gamma))`.
pub(super) fn error_weights() -> [f64; 3] {
    let k = (3.0 * GAMMA * GAMMA - 4.0 * GAMMA + 2.0) / (12.0 * (2.0 - GAMMA));
    [
        2.0 * k / GAMMA,
        -2.0 * k / (GAMMA * (1.0 - GAMMA)),
        2.0 * k / (1.0 - GAMMA),
    ]
}
