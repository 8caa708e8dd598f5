//! Central differences in velocity form.

use crate::{RateScheme, SchemeProperties, UpdateFormula, Weights};

/// Central differences, Newmark's scheme with `beta = 0` and `gamma = 1/2`: the displacement is known
/// before the velocity, `u = u_o + tau v_o + tau^2/2 a_o`, and `a = 2/tau (v - v_o) - a_o`.
///
/// The scheme is of second order and explicit: stable for steps up to `2/omega_max` of the undamped body, which a
/// simulation computes and enforces. With a lumped mass the matrix of a step is diagonal, and friction is solved vertex
/// by vertex.
///
/// A diagonal viscosity, such as that of dashpots, is part of that matrix. One that couples vertices, such as
/// Kelvin-Voigt viscosity `C = beta A`, is not: beside a lumped mass its force is taken at the velocity of the half step,
/// `v_o + tau/2 a_o`, before the new velocity is known. Such a force lags by `tau/2`, of first order, and it lowers the
/// stability limit, to
///
/// ```text
/// tau = 2/omega_max (sqrt(1 + xi^2) - xi),     xi = beta omega_max/2
/// ```
///
/// for `C = beta A`, with the damping ratio `xi` of the highest frequency: `sqrt(beta^2 + 4/omega_max^2) - beta`. In
/// general it is the largest `tau` at which `4 M - 2 tau C - tau^2 A` is positive semidefinite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[doc(alias("leapfrog", "explicit"))]
pub struct CentralDifferences;

impl RateScheme for CentralDifferences {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let displacement = Weights {
            velocity: dt,
            acceleration: 0.5 * dt * dt,
            ..Weights::STAY
        };
        UpdateFormula {
            displacement,
            acceleration: Weights {
                velocity: -2.0 / dt,
                acceleration: -1.0,
                new_velocity: 2.0 / dt,
                ..Weights::ZERO
            },
            algorithmic: Weights::ZERO,
            prescribed: displacement,
        }
    }

    fn properties(&self) -> SchemeProperties {
        SchemeProperties {
            order: 2,
            symmetric: true,
            stability_limit: Some(2.0),
            implicit: false,
            ..SchemeProperties::FIRST_ORDER
        }
    }
}
