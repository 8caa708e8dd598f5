//! Any scheme without inertia.

use crate::{Coefficients, Motion, Predicted, RateScheme, Stages, TimeError};

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
    fn coefficients(&self, dt: f64) -> Coefficients {
        Coefficients {
            acceleration: 0.0,
            ..self.0.coefficients(dt)
        }
    }

    fn predict(&self, dt: f64, from: Motion) -> Predicted {
        let at_constant_rate = Motion {
            acceleration: 0.0,
            carried: 0.0,
            ..from
        };
        Predicted {
            acceleration: 0.0,
            ..self.0.predict(dt, at_constant_rate)
        }
    }

    fn stages(&self) -> Option<Stages> {
        self.0.stages()
    }

    fn is_symmetric(&self) -> bool {
        self.0.is_symmetric()
    }

    /// Without inertia a displacement is of second order by the trapezoidal rule only.
    fn order(&self) -> usize {
        let staged = self.0.stages().is_some();
        if staged || self.0.coefficients(1.0).displacement == 0.5 {
            self.0.order()
        } else {
            1
        }
    }

    fn validate(&self) -> Result<(), TimeError> {
        self.0.validate()
    }
}
