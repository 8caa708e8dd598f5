//! Backward Euler for displacement and velocity.

use crate::{Facts, RateScheme, Rule, Weights};

/// Backward Euler: `u = u_o + tau v`, `a = (v - v_o)/tau`. Of first order, strongly damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BackwardEuler;

impl RateScheme for BackwardEuler {
    fn rule(&self, dt: f64) -> Rule {
        let displacement = Weights {
            new_velocity: dt,
            ..Weights::STAY
        };
        Rule {
            displacement,
            acceleration: Weights {
                velocity: -1.0 / dt,
                new_velocity: 1.0 / dt,
                ..Weights::ZERO
            },
            carried: Weights::ZERO,
            prescribed: displacement,
        }
    }

    fn facts(&self) -> Facts {
        Facts::FIRST_ORDER
    }
}
