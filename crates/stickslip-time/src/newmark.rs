//! Newmark's family of schemes.

use crate::{RateScheme, SchemeProperties, TimeError, UpdateFormula, Weights};

/// Newmark's scheme: `u = u_o + tau v_o + tau^2 ((1/2 - beta) a_o + beta a)`,
/// `v = v_o + tau ((1 - gamma) a_o + gamma a)`.
///
/// It is of second order for `gamma = 1/2`, and unconditionally stable for `2 beta >= gamma >= 1/2`. It needs
/// `beta > 0`: with `beta = 0` the displacement does not depend on the velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("Newmark-beta", "trapezoidal formula"))]
pub struct Newmark {
    /// `beta`, in (0, 1].
    pub beta: f64,
    /// `gamma`, in (0, 1].
    pub gamma: f64,
}

impl Newmark {
    /// `beta = 1/4`, `gamma = 1/2`: the acceleration constant at its average, energy conserved.
    pub const AVERAGE_ACCELERATION: Self = Self {
        beta: 0.25,
        gamma: 0.5,
    };
}

impl Default for Newmark {
    fn default() -> Self {
        Self::AVERAGE_ACCELERATION
    }
}

impl RateScheme for Newmark {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let Self { beta, gamma } = *self;
        let ratio = beta / gamma;
        UpdateFormula {
            displacement: Weights {
                velocity: dt * (1.0 - ratio),
                acceleration: dt * dt * (0.5 - ratio),
                new_velocity: ratio * dt,
                ..Weights::STAY
            },
            acceleration: Weights {
                velocity: -1.0 / (gamma * dt),
                acceleration: -(1.0 - gamma) / gamma,
                new_velocity: 1.0 / (gamma * dt),
                ..Weights::ZERO
            },
            algorithmic: Weights::ZERO,
            prescribed: UpdateFormula::mean_velocity(dt),
        }
    }

    fn properties(&self) -> SchemeProperties {
        let centred = self.gamma == 0.5;
        let order = if centred { 2 } else { 1 };
        let trapezoidal = centred && self.beta == 0.25;
        SchemeProperties {
            order,
            quasi_static_order: if trapezoidal { 2 } else { 1 },
            symmetric: centred,
            ..SchemeProperties::FIRST_ORDER
        }
    }

    /// The average acceleration is the trapezoidal formula.
    fn quasi_static_radius(&self) -> Option<f64> {
        (*self == Self::AVERAGE_ACCELERATION).then_some(1.0)
    }

    fn validate(&self) -> Result<(), TimeError> {
        for (parameter, value) in [("beta", self.beta), ("gamma", self.gamma)] {
            let legal = value > 0.0 && value <= 1.0;
            TimeError::check("Newmark", parameter, "(0, 1]", value, legal)?;
        }
        Ok(())
    }
}
