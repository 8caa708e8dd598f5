//! State-dependent Tresca friction, without rate dependence.

use stickslip_state::LogTheta;

use crate::{DieterichRuina, FrictionError, FrictionLaw};

/// State-dependent Tresca's law: `mu = max(0, mu0 + b (alpha + ln(V0/L)))`.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, StateDependentTresca};
/// # use stickslip_state::LogTheta;
/// let law = StateDependentTresca {
///     reference_friction: 0.6,
///     b: 0.015,
///     reference_velocity: 1e-6,
///     slip_distance: 1e-5,
/// };
/// let steady = LogTheta(10f64.ln()); // theta = L/V0
/// assert!((law.coefficient(1.0, steady) - 0.6).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateDependentTresca {
    /// `mu0`, the coefficient at `theta = L/V0`, finite and non-negative.
    pub reference_friction: f64,
    /// `b`, the coefficient of the evolution effect, finite and non-negative.
    pub b: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    pub slip_distance: f64,
}

impl From<DieterichRuina> for StateDependentTresca {
    /// The law with these parameters except `a`.
    fn from(law: DieterichRuina) -> Self {
        Self {
            reference_friction: law.reference_friction,
            b: law.b,
            reference_velocity: law.reference_velocity,
            slip_distance: law.slip_distance,
        }
    }
}

impl FrictionLaw for StateDependentTresca {
    type State = LogTheta;

    fn coefficient(&self, _slip_rate: f64, LogTheta(alpha): LogTheta) -> f64 {
        let aging = alpha + (self.reference_velocity / self.slip_distance).ln();
        (self.reference_friction + self.b * aging).max(0.0)
    }

    fn coefficient_rate_slope(&self, _slip_rate: f64, _state: LogTheta) -> f64 {
        0.0
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.coefficient(slip_rate, state) * slip_rate
    }

    /// `b` for positive friction, else 0.
    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        if self.coefficient(slip_rate, state) > 0.0 {
            self.b
        } else {
            0.0
        }
    }

    /// `max(0, drive - mu) / viscosity`.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        (drive - self.coefficient(0.0, state)).max(0.0) / viscosity
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_non_negative("reference_friction", self.reference_friction)?;
        FrictionError::check_non_negative("b", self.b)?;
        FrictionError::check_positive("reference_velocity", self.reference_velocity)?;
        FrictionError::check_positive("slip_distance", self.slip_distance)
    }
}
