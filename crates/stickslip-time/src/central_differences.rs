//! Central differences in velocity form.

use crate::{Coefficients, Motion, Predicted, RateScheme};

/// Central differences, Newmark's scheme with `beta = 0` and `gamma = 1/2`: the displacement is known
/// before the velocity, `u = u_o + tau v_o + tau^2/2 a_o`, and `a = 2/tau (v - v_o) - a_o`.
///
/// Of second order and explicit: stable for steps up to `2/omega_max` of the undamped body, which a
/// simulation computes and enforces. With a lumped mass the matrix of a step is diagonal, and friction
/// is solved vertex by vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CentralDifferences;

impl RateScheme for CentralDifferences {
    fn coefficients(&self, dt: f64) -> Coefficients {
        Coefficients {
            displacement: 0.0,
            acceleration: 2.0 / dt,
        }
    }

    fn predict(&self, dt: f64, from: Motion) -> Predicted {
        let half = 0.5 * dt * from.acceleration;
        Predicted {
            displacement: from.displacement + dt * (from.velocity + half),
            acceleration: -2.0 / dt * from.velocity - from.acceleration,
        }
    }

    fn order(&self) -> usize {
        2
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn stability_limit(&self) -> Option<f64> {
        Some(2.0)
    }
}
