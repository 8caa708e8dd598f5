//! The state law of Perrin, Rice and Zheng.

use crate::{LogTheta, StateError, StateLaw};

/// The law of Perrin, Rice and Zheng, `theta' = 1 - (V theta / 2L)^2`: aging at rest, with a square in place of
/// Dieterich's linear term. Its steady state is `2L/V`.
///
/// As an equation for `alpha = ln theta` it is `alpha' = exp(-alpha) - (V/2L)^2 exp(alpha)`. A friction law that
/// compares `theta` with a characteristic slip distance needs `2L` there.
///
/// Far above its steady state `theta` falls to `4 L^2/(V^2 t)`: its logarithm then has the slope -2 in `ln V`; in a
/// steady state the slope is -1. A fixed point of rate and state converges slowly through such an event: for a slider
/// in steps of 1.5 ms, to the paper's tolerance, the rule of the paper took 263 iterations in one step, more than the
/// default limit, and Aitken's rule 40.
///
/// Source: G. Perrin, J. R. Rice, G. Zheng, *Self-healing slip pulse on a frictional surface*, J. Mech. Phys. Solids 43
/// (1995).
///
/// ```
/// # use stickslip_state::{LogTheta, PerrinRiceZheng, StateLaw};
/// let law = PerrinRiceZheng { slip_distance: 1e-5 };
/// let LogTheta(alpha) = law.advance_at_constant_rate(LogTheta(0.0), 1e-6, 1e9)?;
/// assert!((alpha - 20f64.ln()).abs() < 1e-15); // theta = 2L/V
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerrinRiceZheng {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    pub slip_distance: f64,
}

impl PerrinRiceZheng {
    /// `r = V/2L` \[1/s\].
    fn decay(&self, slip_rate: f64) -> f64 {
        slip_rate / self.slip_distance * 0.5
    }

    /// `r^2 exp(alpha)`.
    fn wear(&self, alpha: f64, slip_rate: f64) -> f64 {
        (alpha + 2.0 * self.decay(slip_rate).ln()).exp()
    }

    /// The logarithms of numerator, denominator and `tanh(x)` of the solution at constant rate.
    fn logarithms(decay: f64, alpha: f64, dt: f64) -> [f64; 3] {
        let x = decay * dt;
        // Tiny arguments underflow before their logarithms matter.
        let ln_tanh = if x < LINEAR {
            decay.ln() + dt.ln()
        } else {
            x.tanh().ln()
        };
        let aged = if x < LINEAR {
            dt.ln()
        } else {
            ln_tanh - decay.ln()
        };
        let (small, large) = (aged.min(alpha), aged.max(alpha));
        let numerator = large + (small - large).exp().ln_1p();
        let w = alpha + decay.ln() + ln_tanh;
        let denominator = w.max(0.0) + (-w.abs()).exp().ln_1p();
        [numerator, denominator, ln_tanh]
    }
}

/// The argument below which the hyperbolic tangent equals its argument to rounding.
const LINEAR: f64 = 1e-8;

impl StateLaw for PerrinRiceZheng {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        // No state lets both overflow.
        (-alpha).exp() - self.wear(alpha, slip_rate)
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        -(-alpha).exp() - self.wear(alpha, slip_rate)
    }

    /// `-(r/L) exp(to) / (1/dt + exp(-to) + r^2 exp(to))` with `r = V/2L`, by the implicit function theorem.
    fn advance_rate_slope(
        &self,
        _from: LogTheta,
        LogTheta(to): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let drive = (to + self.decay(slip_rate).ln()).exp() / self.slip_distance;
        -drive / (dt.recip() + (-to).exp() + self.wear(to, slip_rate))
    }

    /// `theta = (from + tanh(x)/r) / (1 + r from tanh(x))` with `r = V/2L` and `x = r dt`: the addition theorem of the
    /// hyperbolic tangent or cotangent of `x` and of the argument of `from`, in logarithms.
    fn advance_exact(&self, LogTheta(from): LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        let [numerator, denominator, _] = Self::logarithms(self.decay(slip_rate), from, dt);
        Some(LogTheta(numerator - denominator))
    }

    /// `-(1/2L) ( (tanh(x) - x/cosh(x)^2)/(r^2 N) + from (tanh(x) + x/cosh(x)^2)/D )`, with `N` and `D` the numerator
    /// and the denominator of the solution.
    fn advance_at_constant_rate_rate_slope(
        &self,
        LogTheta(from): LogTheta,
        _to: LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let decay = self.decay(slip_rate);
        let x = decay * dt;
        let [numerator, denominator, ln_tanh] = Self::logarithms(decay, from, dt);
        let tanh = x.tanh();
        // x / cosh(x)^2, which vanishes long before the hyperbolic cosine overflows.
        let bend = if x < 300.0 { x / x.cosh().powi(2) } else { 0.0 };
        let healing = if x < 0.02 {
            // The difference is x^3 (2/3 - 8/15 x^2 + 34/105 x^4 - ...).
            let y = x * x;
            let series = 2.0 / 3.0 - y * (8.0 / 15.0 - y * (34.0 / 105.0 - y * (496.0 / 2835.0)));
            dt * x * series * (dt.ln() - numerator).exp()
        } else {
            (tanh - bend) / decay * (-numerator - decay.ln()).exp()
        };
        // bend/tanh = 2x/sinh(2x), which is 1 for small arguments.
        let share = if x < LINEAR { 1.0 } else { bend / tanh };
        let wear = (from - denominator + ln_tanh).exp() * (1.0 + share);
        (-(healing + wear) / self.slip_distance * 0.5).max(f64::MIN)
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}
