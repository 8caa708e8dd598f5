//! The generalised-alpha method for systems of first order.

use crate::{RateScheme, SchemeProperties, TimeError, UpdateFormula, Weights};

/// The generalised-alpha method for `u' = v`, bodies without inertia. It is of second order, with adjustable damping of
/// unresolved motion.
///
/// The balance of forces, friction included, holds at the new time with the velocity `v`. The displacement is
/// integrated with a velocity `w` of its own, at an intermediate time,
///
/// ```text
/// am w + (1 - am) w_o = af v + (1 - af) v_o,   am = (3 - r)/(2 (1 + r)),   af = 1/(1 + r)
/// u = u_o + dt ((1 - gamma) w_o + gamma w),    gamma = 1/2 + am - af
/// ```
///
/// with `r` the spectral radius at infinity. `r = 1` is the trapezoidal rule, under which a velocity that friction does
/// not resist alternates forever; `r = 0` is BDF2 for constant steps. See K. Jansen, C. Whiting, G. Hulbert, "A
/// generalized-alpha method for integrating the filtered Navier-Stokes equations with a stabilized finite element
/// method", Comput. Methods Appl. Mech. Eng. 190 (2000).
///
/// `w` differs from `v` by a share of a step. The scheme stores the rate `(w - v)/dt`, by which `w` is right for a next
/// step of any size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstOrderAlpha {
    /// `r`, in [0, 1].
    pub spectral_radius: f64,
}

impl Default for FirstOrderAlpha {
    /// A spectral radius of 0.8.
    fn default() -> Self {
        Self {
            spectral_radius: 0.8,
        }
    }
}

impl RateScheme for FirstOrderAlpha {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let r = self.spectral_radius;
        let (am, af) = (0.5 * (3.0 - r) / (1.0 + r), 1.0 / (1.0 + r));
        let gamma = 0.5 + am - af;
        let old = Weights {
            velocity: 1.0,
            algorithmic: dt,
            ..Weights::ZERO
        };
        let rates = Weights {
            velocity: 1.0 - af,
            new_velocity: af,
            ..Weights::ZERO
        };
        let new = (rates + old * (am - 1.0)) * am.recip();
        let velocity = Weights {
            new_velocity: -1.0,
            ..Weights::ZERO
        };
        UpdateFormula {
            displacement: Weights::STAY + (old * (1.0 - gamma) + new * gamma) * dt,
            acceleration: Weights::ZERO,
            algorithmic: (new + velocity) * dt.recip(),
            prescribed: UpdateFormula::mean_velocity(dt),
        }
    }

    fn properties(&self) -> SchemeProperties {
        SchemeProperties {
            order: 2,
            quasi_static_order: 2,
            has_algorithmic: true,
            ..SchemeProperties::FIRST_ORDER
        }
    }

    fn validate(&self) -> Result<(), TimeError> {
        TimeError::radius("first-order generalised-alpha", self.spectral_radius)
    }
}
