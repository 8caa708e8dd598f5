//! Dieterich's aging law.

use crate::{
    LogTheta, StateError, StateLaw,
    wright::{ln_omega, omega},
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
pub struct Dieterich {
    /// `L` \[m\], finite and positive.
    pub slip_distance: f64,
}

impl StateLaw for Dieterich {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        (-alpha).exp() - slip_rate / self.slip_distance
    }

    fn evolution_slope(&self, LogTheta(alpha): LogTheta, _slip_rate: f64) -> f64 {
        -(-alpha).exp()
    }

    /// Backward Euler in closed form: with `omega` of `q = ln dt + r`, `r = dt V/L - from`,
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
        let q = dt.ln() + r;
        // omega - r cancels where omega is large, ln dt - ln omega where the change is small.
        Ok(LogTheta(if q <= 1.0 {
            omega(q) - r
        } else {
            dt.ln() - ln_omega(q)
        }))
    }

    /// `ln( exp(from - x) + dt (1 - exp(-x))/x )` with `x = dt V/L`, as a sum of exponentials that
    /// never forms the larger one.
    fn advance_exact(&self, LogTheta(from): LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        let x = dt * (slip_rate / self.slip_distance);
        let mean_decay = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
        let worn = from - x;
        let healed = (dt * mean_decay).ln();
        Some(LogTheta(if worn >= healed {
            worn + (healed - worn).exp().ln_1p()
        } else {
            healed + (worn - healed).exp().ln_1p()
        }))
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}
