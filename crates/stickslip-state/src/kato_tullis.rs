//! The composite law of Kato and Tullis.

use crate::{
    LogTheta, StateError, StateLaw,
    wright::{ln_omega, omega},
};

/// The composite law of Kato and Tullis, `theta' = exp(-V/Vc) - (V theta/L) ln(V theta/L)`: aging below the rate `Vc`,
/// the slip law above.
///
/// As an equation for `alpha = ln theta` it is `alpha' = exp(-alpha - V/Vc) - (V/L) (alpha + ln(V/L))`. Far above `Vc`
/// its steady state is `L/V`, far below it is `1.763 L/V`, where `x ln x = 1`. There is no closed form at constant slip
/// rate.
///
/// Source: N. Kato, T. E. Tullis, *A composite rate- and state-dependent law for rock friction*, Geophys. Res. Lett. 28
/// (2001), where `Vc` is 1e-8 m/s.
///
/// ```
/// # use stickslip_state::{KatoTullis, LogTheta, StateLaw};
/// let law = KatoTullis { slip_distance: 1e-5, aging_velocity: 1e-8 };
/// let LogTheta(aged) = law.advance(LogTheta(0.0), 0.0, 1e-3)?;
/// assert!((aged - 1e-3).abs() < 1e-6); // theta = 1 s + 1 ms
/// let LogTheta(steady) = law.advance(LogTheta(0.0), 1e-5, 1e9)?;
/// assert!(steady.abs() < 1e-8); // theta = L/V
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "composite law")]
pub struct KatoTullis {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    pub slip_distance: f64,
    /// `Vc` \[m/s\], the slip rate up to which contacts age, finite and positive.
    pub aging_velocity: f64,
}

impl KatoTullis {
    /// `ln(V/L)`, bounded below; the quotient of subnormal numbers would have too few digits.
    fn ln_rate(&self, slip_rate: f64) -> f64 {
        slip_rate.max(f64::MIN_POSITIVE).ln() - self.slip_distance.ln()
    }

    /// `exp(-alpha - V/Vc)`.
    fn aging(&self, alpha: f64, slip_rate: f64) -> f64 {
        (-alpha - slip_rate / self.aging_velocity).exp()
    }
}

impl StateLaw for KatoTullis {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / self.slip_distance;
        let slipping = if rate > 0.0 {
            rate * (alpha + self.ln_rate(slip_rate))
        } else {
            0.0
        };
        self.aging(alpha, slip_rate) - slipping
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        -self.aging(alpha, slip_rate) - slip_rate / self.slip_distance
    }

    /// Backward Euler in closed form: with `c = dt V/L`, `q = (from - c ln(V/L))/(1 + c)`,
    /// `k = dt exp(-V/Vc)/(1 + c)` and `omega` of `ln k - q`, `alpha = q + omega = ln k - ln omega`.
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
        let c = dt * (slip_rate / self.slip_distance);
        let q = if c > 0.0 {
            (from - c * self.ln_rate(slip_rate)) / (1.0 + c)
        } else {
            from
        };
        let ln_k = dt.ln() - slip_rate / self.aging_velocity - c.ln_1p();
        let argument = ln_k - q;
        // As for Dieterich's law, the form that does not cancel.
        Ok(LogTheta(if argument <= 1.0 {
            q + omega(argument)
        } else {
            ln_k - ln_omega(argument)
        }))
    }

    /// `-dt ( (1 + to + ln(V/L))/L + exp(-to - V/Vc)/Vc ) / (1 + c + dt exp(-to - V/Vc))`; towards rest it grows like
    /// `-ln V` and stays at its value for the smallest normal `V`.
    fn advance_rate_slope(
        &self,
        _from: LogTheta,
        LogTheta(to): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let aging = self.aging(to, slip_rate);
        let excess = 1.0 + to + self.ln_rate(slip_rate);
        let drive = excess / self.slip_distance + aging / self.aging_velocity;
        -drive / (dt.recip() + slip_rate / self.slip_distance + aging)
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)?;
        StateError::check_positive("aging_velocity", self.aging_velocity)
    }
}
