//! Dieterich's aging law.

use crate::{
    Evolutions, LogTheta, StateError, StateLaw,
    many_nodes::ManyNodes,
    wright::{lambert, ln_omega, omega},
};

/// Dieterich's aging law, `alpha' = exp(-alpha) - V/L`: the contact ages also at rest.
///
/// In terms of `theta = exp(alpha)` it is `theta' = 1 - V theta / L`, with the steady state `L/V`.
/// Closed forms hold as long as `dt V / L` does not overflow.
///
/// ```
/// # use stickslip_state::{Dieterich, LogTheta, StateLaw};
/// let law = Dieterich { slip_distance: 1e-5 };
/// let at_rest = law.advance_exact(LogTheta(0.0), 0.0, 1.0);
/// assert_eq!(at_rest, Some(LogTheta(2f64.ln()))); // theta = 1 s + 1 s
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("aging law", "ageing law", "slowness law"))]
pub struct Dieterich {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
}

impl StateLaw for Dieterich {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        (-alpha).exp() - slip_rate / self.slip_distance
    }

    fn evolutions(laws: &[Self]) -> Option<Box<dyn Evolutions<LogTheta>>> {
        Some(Box::new(ManyNodes::new(laws, |law| law.slip_distance)))
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, _slip_rate: f64) -> f64 {
        -(-alpha).exp()
    }

    /// Backward Euler in closed form: with `omega = W(y)`, `y = dt exp(r)`, `r = dt V/L - from`,
    /// `alpha = omega - r = ln dt - ln omega`.
    fn advance(
        &self,
        LogTheta(from): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> Result<LogTheta, StateError> {
        StateError::check_step(slip_rate, dt)?;
        if dt == 0.0 {
            return Ok(LogTheta(from));
        }
        let r = dt * (slip_rate / self.slip_distance) - from;
        let y = dt * r.exp();
        // omega - r cancels where omega is large, ln dt - ln omega where the change is small.
        Ok(LogTheta(if y <= 1.0 {
            lambert(y) - r
        } else {
            let ln_dt = dt.ln();
            let q = ln_dt + r;
            if q <= 1.0 {
                omega(q) - r
            } else {
                ln_dt - ln_omega(q)
            }
        }))
    }

    /// `ln( exp(from - x) + dt m )` with `x = dt V/L` and `m = (1 - exp(-x))/x`.
    ///
    /// A state with a small change is `from + ln(1 + m (dt exp(-from) - x))`: the cancelling terms are at most `1/m`,
    /// and rounded as 1 is. Any other one is a sum of exponentials that never forms the larger one.
    fn advance_exact(&self, LogTheta(from): LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        let x = dt * (slip_rate / self.slip_distance);
        let mean_decay = mean_decay(x);
        let growth = mean_decay * (dt * (-from).exp() - x);
        if growth.abs() <= 0.5 {
            return Some(LogTheta(from + growth.ln_1p()));
        }
        let worn = from - x;
        let healed = (dt * mean_decay).ln();
        Some(LogTheta(if worn >= healed {
            worn + (healed - worn).exp().ln_1p()
        } else {
            healed + (worn - healed).exp().ln_1p()
        }))
    }

    /// `-(dt/L) / (1 + omega)`, with `omega = to - from + dt V/L = dt exp(-to)`.
    fn advance_rate_slope(
        &self,
        LogTheta(from): LogTheta,
        LogTheta(to): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let weight = dt / self.slip_distance;
        let omega = (to - from) + dt * (slip_rate / self.slip_distance);
        if weight.is_normal() && omega < f64::INFINITY {
            // Where the sum cancels it is small beside 1.
            -weight / (1.0 + omega.max(0.0))
        } else {
            // Nothing here is infinity over infinity, nor zero times infinity.
            -(dt.recip() + (-to).exp()).recip() / self.slip_distance
        }
    }

    /// `-(dt/L) (w + (1 - w) (1/x - 1/(exp(x) - 1)))` with `x = dt V/L` and `w = exp(from - x - to)`, the share of the
    /// old state in `theta`.
    fn advance_at_constant_rate_rate_slope(
        &self,
        LogTheta(from): LogTheta,
        LogTheta(to): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let x = dt * (slip_rate / self.slip_distance);
        let left = (from - x - to).min(0.0).exp();
        -dt / self.slip_distance * (left + (1.0 - left) * mean_age(x))
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}

/// `(1 - exp(-x))/x` for `x >= 0`, from 1 down to 0.
fn mean_decay(x: f64) -> f64 {
    if x > 1.0 / 256.0 {
        return -(-x).exp_m1() / x;
    }
    // The next term is below a hundredth of the rounding of 1.
    let tail = 1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0);
    1.0 - x * (0.5 - x * (1.0 / 6.0 - x * tail))
}

/// `1/x - 1/(exp(x) - 1)` for `x >= 0`, from 1/2 down to 0.
fn mean_age(x: f64) -> f64 {
    if x > 0.5 {
        return x.recip() - x.exp_m1().recip();
    }
    // Bernoulli numbers over factorials; the next term is below rounding of 1/2.
    let y = x * x;
    let tail = 1.0 / 1_209_600.0
        - y * (1.0 / 47_900_160.0 - y * (691.0 / 1_307_674_368_000.0 - y / 74_724_249_600.0));
    0.5 - x * (1.0 / 12.0 - y * (1.0 / 720.0 - y * (1.0 / 30_240.0 - y * tail)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_of_mean_decay_meets_the_closed_form() {
        let below = 1.0_f64 / 256.0;
        let above = below.next_up();
        let difference = (mean_decay(below) - mean_decay(above)).abs();
        assert!(difference <= 2.0 * f64::EPSILON, "{difference}");
        assert_eq!(mean_decay(0.0), 1.0);
        for x in [1e-3_f64, 1e-5, 1e-300] {
            let exact = -(-x).exp_m1() / x;
            assert!((mean_decay(x) - exact).abs() <= 2.0 * f64::EPSILON, "{x}");
        }
    }

    #[test]
    fn the_series_of_mean_age_meets_the_closed_form() {
        let below = mean_age(0.5);
        let above = mean_age(0.5f64.next_up());
        assert!(
            (below - above).abs() <= 4.0 * f64::EPSILON,
            "{below} {above}"
        );
        assert_eq!(mean_age(0.0), 0.5);
        assert!((mean_age(1e-3) - (0.5 - 1e-3 / 12.0 + 1e-9 / 720.0)).abs() < 1e-16);
        assert_eq!(mean_age(1e300), 1e-300);
        assert_eq!(mean_age(f64::INFINITY), 0.0);
    }
}
