//! Any scheme without inertia.

use crate::{Facts, RateScheme, Rule, TimeError, Weights};

/// A scheme with the inertial term dropped: `c_a = 0` and no acceleration is predicted or stored.
///
/// A scene without a mass matrix needs no wrapper, every scheme is quasi-static there. This one
/// takes the inertia out of a scene that has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct QuasiStatic<R>(
    /// The scheme that integrates the displacement.
    pub R,
);

impl<R: RateScheme> RateScheme for QuasiStatic<R> {
    fn rule(&self, dt: f64) -> Rule {
        let rule = self.0.rule(dt);
        Rule {
            displacement: rule.displacement.without_inertia(),
            acceleration: Weights::ZERO,
            carried: Weights::ZERO,
            prescribed: rule.prescribed.without_inertia(),
        }
    }

    fn facts(&self) -> Facts {
        let facts = self.0.facts();
        Facts {
            order: facts.quasi_static_order,
            symmetric: facts.symmetric && facts.quasi_static_order > 1,
            carries: false,
            ..facts
        }
    }

    fn validate(&self) -> Result<(), TimeError> {
        self.0.validate()
    }
}
