//! Tresca friction, without rate and state dependence.

use crate::{FrictionError, FrictionLaw};

/// Tresca's law, `mu` constant: Coulomb friction with prescribed normal stress. The contact sticks up to a given force
/// and slides at it.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, Tresca};
/// let law = Tresca { coefficient: 0.6 };
/// assert_eq!(law.slip_rate(1e6, 0.5, ()), 0.0);
/// assert!((law.slip_rate(1e6, 1.6, ()) - 1e-6).abs() < 1e-21);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("Coulomb", "constant coefficient"))]
pub struct Tresca {
    /// `mu`, finite and non-negative.
    pub coefficient: f64,
}

impl FrictionLaw for Tresca {
    type State = ();

    fn coefficient(&self, _slip_rate: f64, (): ()) -> f64 {
        self.coefficient
    }

    fn coefficient_rate_slope(&self, _slip_rate: f64, (): ()) -> f64 {
        0.0
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        self.coefficient * slip_rate
    }

    fn coefficient_state_slope(&self, _slip_rate: f64, (): ()) -> f64 {
        0.0
    }

    /// `max(0, drive - mu) / viscosity`.
    fn slip_rate(&self, viscosity: f64, drive: f64, (): ()) -> f64 {
        (drive - self.coefficient).max(0.0) / viscosity
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_non_negative("coefficient", self.coefficient)
    }
}
