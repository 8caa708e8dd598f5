//! Schemes without inertia.

use crate::{RateScheme, SchemeProperties, TimeError, UpdateFormula, Weights};

/// A scheme without the inertial term: `c_a = 0`, and no acceleration is predicted or stored.
///
/// In a scene without a mass matrix every scheme is quasi-static, and needs no wrapper. This wrapper drops the inertia
/// of a scene with a mass matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct QuasiStatic<R>(
    /// The scheme that integrates the displacement.
    pub R,
);

impl<R: RateScheme> RateScheme for QuasiStatic<R> {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let formula = self.0.update_formula(dt);
        UpdateFormula {
            displacement: formula.displacement.without_inertia(),
            acceleration: Weights::ZERO,
            algorithmic: Weights::ZERO,
            prescribed: formula.prescribed.without_inertia(),
        }
    }

    fn properties(&self) -> SchemeProperties {
        let properties = self.0.properties();
        SchemeProperties {
            order: properties.quasi_static_order,
            symmetric: properties.symmetric && properties.quasi_static_order > 1,
            has_algorithmic: false,
            ..properties
        }
    }

    fn validate(&self) -> Result<(), TimeError> {
        self.0.validate()
    }
}
