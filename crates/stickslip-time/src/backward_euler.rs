//! Backward Euler for displacement and velocity.

use crate::{RateScheme, SchemeProperties, UpdateFormula, Weights};

/// Backward Euler: `u = u_o + tau v`, `a = (v - v_o)/tau`. It is of first order and strongly damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[doc(alias("implicit Euler", "BDF1"))]
pub struct BackwardEuler;

impl RateScheme for BackwardEuler {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let displacement = Weights {
            new_velocity: dt,
            ..Weights::STAY
        };
        UpdateFormula {
            displacement,
            acceleration: Weights {
                velocity: -1.0 / dt,
                new_velocity: 1.0 / dt,
                ..Weights::ZERO
            },
            algorithmic: Weights::ZERO,
            prescribed: displacement,
        }
    }

    fn properties(&self) -> SchemeProperties {
        SchemeProperties::FIRST_ORDER
    }
}
