//! Newmark's family of schemes.

use crate::{Facts, RateScheme, Rule, TimeError, Weights};

/// Newmark's scheme: `u = u_o + tau v_o + tau^2 ((1/2 - beta) a_o + beta a)`,
/// `v = v_o + tau ((1 - gamma) a_o + gamma a)`.
///
/// Of second order for `gamma = 1/2`; unconditionally stable for `2 beta >= gamma >= 1/2`. Needs
/// `beta > 0`: with `beta = 0` the displacement does not depend on the velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    fn rule(&self, dt: f64) -> Rule {
        let Self { beta, gamma } = *self;
        let ratio = beta / gamma;
        Rule {
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
            carried: Weights::ZERO,
            prescribed: Rule::mean_velocity(dt),
        }
    }

    fn facts(&self) -> Facts {
        let centred = self.gamma == 0.5;
        let order = if centred { 2 } else { 1 };
        let trapezoidal = centred && self.beta == 0.25;
        Facts {
            order,
            quasi_static_order: if trapezoidal { 2 } else { 1 },
            symmetric: centred,
            ..Facts::FIRST_ORDER
        }
    }

    fn validate(&self) -> Result<(), TimeError> {
        for (parameter, value) in [("beta", self.beta), ("gamma", self.gamma)] {
            let legal = value > 0.0 && value <= 1.0;
            TimeError::check("Newmark", parameter, "(0, 1]", value, legal)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motion;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn satisfies_both_defining_equations(
            beta in 0.01..1.0_f64, gamma in 0.01..1.0_f64, dt in 1e-6..1e3_f64,
            u in -1.0..1.0_f64, v in -1.0..1.0_f64, a in -1.0..1.0_f64, new in -1.0..1.0_f64,
        ) {
            let scheme = Newmark { beta, gamma };
            let from = Motion { displacement: u, velocity: v, acceleration: a, carried: 0.0 };
            let to = scheme.rule(dt).motion(from, new);
            let rate = v + dt * ((1.0 - gamma) * a + gamma * to.acceleration);
            let place = u + dt * v + dt * dt * ((0.5 - beta) * a + beta * to.acceleration);
            prop_assert!((rate - new).abs() < 1e-10 * (1.0 + dt));
            let scale = 1.0 + dt * dt * (1.0 + to.acceleration.abs());
            prop_assert!((place - to.displacement).abs() < 1e-12 * scale);
        }
    }

    #[test]
    fn rejects_an_explicit_member() {
        let explicit = Newmark {
            beta: 0.0,
            gamma: 0.5,
        };
        assert_eq!(
            explicit.validate(),
            Err(TimeError {
                scheme: "Newmark",
                parameter: "beta",
                range: "(0, 1]",
                value: 0.0
            })
        );
        assert!(
            Newmark {
                beta: 0.25,
                gamma: f64::NAN
            }
            .validate()
            .is_err()
        );
    }
}
