//! Ruina's slip law.

use crate::{Evolutions, LogTheta, StateError, StateLaw, many_nodes::ManyNodes};

/// Ruina's slip law, `alpha' = -(V/L) (alpha + ln(V/L))`: the state changes only with slip.
///
/// At `V = 0` it is its limit, `alpha' = 0`. The steady state is `theta = L/V`. Closed forms hold as
/// long as `dt V / L` does not overflow.
///
/// ```
/// # use stickslip_state::{LogTheta, Ruina, StateLaw};
/// let law = Ruina { slip_distance: 1e-5 };
/// assert_eq!(law.advance(LogTheta(-10.0), 0.0, 1e6)?, LogTheta(-10.0));
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "slip law")]
pub struct Ruina {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
}

impl Ruina {
    /// `ln(V/L)`, bounded below; the quotient of subnormal numbers would have too few digits.
    fn ln_rate(&self, slip_rate: f64) -> f64 {
        slip_rate.max(f64::MIN_POSITIVE).ln() - self.slip_distance.ln()
    }
}

impl StateLaw for Ruina {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / self.slip_distance;
        if rate > 0.0 {
            -rate * (alpha + rate.ln())
        } else {
            0.0
        }
    }

    fn evolutions(laws: &[Self]) -> Option<Box<dyn Evolutions<LogTheta>>> {
        Some(Box::new(ManyNodes::new(laws, |law| law.slip_distance)))
    }

    fn evolution_state_slope(&self, _state: LogTheta, slip_rate: f64) -> f64 {
        -slip_rate / self.slip_distance
    }

    /// Backward Euler in closed form, `(from - c ln(V/L)) / (1 + c)` with `c = dt V/L`.
    fn advance(
        &self,
        LogTheta(from): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> Result<LogTheta, StateError> {
        StateError::check_step(slip_rate, dt)?;
        let rate = slip_rate / self.slip_distance;
        let c = dt * rate;
        Ok(LogTheta(if c > 0.0 {
            (from - c * rate.ln()) / (1.0 + c)
        } else {
            from
        }))
    }

    /// `from exp(-x) - (1 - exp(-x)) ln(V/L)` with `x = dt V/L`.
    fn advance_exact(&self, LogTheta(from): LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        let rate = slip_rate / self.slip_distance;
        let x = dt * rate;
        Some(LogTheta(if x > 0.0 {
            from * (-x).exp() + (-x).exp_m1() * rate.ln()
        } else {
            from
        }))
    }

    /// `-(dt/L) (1 + (from + ln(V/L)) / (1 + c)) / (1 + c)` with `c = dt V/L`; towards rest it grows
    /// like `-ln V` and stays at its value for the smallest normal `V`.
    fn advance_rate_slope(
        &self,
        LogTheta(from): LogTheta,
        _to: LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let c = dt * (slip_rate / self.slip_distance);
        let excess = from + self.ln_rate(slip_rate);
        -dt / self.slip_distance / (1.0 + c) * (1.0 + excess / (1.0 + c))
    }

    /// `-(dt/L) (exp(-x) (from + ln(V/L)) + (1 - exp(-x))/x)` with `x = dt V/L`; the limit at rest is as for backward
    /// Euler.
    fn advance_at_constant_rate_rate_slope(
        &self,
        LogTheta(from): LogTheta,
        _to: LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let x = dt * (slip_rate / self.slip_distance);
        let excess = from + self.ln_rate(slip_rate);
        let mean_decay = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
        -dt / self.slip_distance * ((-x).exp() * excess + mean_decay)
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}
