//! Backward Euler for displacement and velocity.

use crate::{Coefficients, Motion, Predicted, RateScheme};

/// Backward Euler: `u = u_o + tau v`, `a = (v - v_o)/tau`. Of first order, strongly damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BackwardEuler;

impl RateScheme for BackwardEuler {
    fn coefficients(&self, dt: f64) -> Coefficients {
        Coefficients {
            displacement: dt,
            acceleration: 1.0 / dt,
        }
    }

    fn predict(&self, dt: f64, from: Motion) -> Predicted {
        Predicted {
            displacement: from.displacement,
            acceleration: -from.velocity / dt,
        }
    }
}
