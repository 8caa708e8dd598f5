//! The contract of a time discretisation in velocity form.

use crate::{SchemeProperties, TimeError, UpdateFormula};

/// A one-step time discretisation with the velocity as unknown, as a value.
///
/// Implement [`update_formula`](RateScheme::update_formula), the linear formulas of displacement and acceleration at
/// the new time in the old motion and the new velocity, and [`properties`](RateScheme::properties), the properties of
/// the scheme. Override [`validate`](RateScheme::validate) for parameters that have a range.
/// [`check_rate_scheme`](crate::check_rate_scheme) checks the properties.
///
/// ```
/// use stickslip_time::{SchemeProperties, Motion, RateScheme, UpdateFormula, Weights, check_rate_scheme};
///
/// /// The trapezoidal rule for the displacement, backward Euler for the velocity.
/// struct Mixed;
///
/// impl RateScheme for Mixed {
///     fn update_formula(&self, dt: f64) -> UpdateFormula {
///         let mean = Weights { velocity: dt / 2.0, new_velocity: dt / 2.0, ..Weights::STAY };
///         UpdateFormula {
///             displacement: mean,
///             acceleration: Weights { velocity: -1.0 / dt, new_velocity: 1.0 / dt, ..Weights::ZERO },
///             algorithmic: Weights::ZERO,
///             prescribed: mean,
///         }
///     }
///
///     fn properties(&self) -> SchemeProperties {
///         SchemeProperties { quasi_static_order: 2, ..SchemeProperties::FIRST_ORDER }
///     }
/// }
///
/// let from = Motion { velocity: 2.0, ..Motion::default() };
/// let to = Mixed.update_formula(0.1).motion(from, 2.0);
/// assert!((to.displacement - 0.2).abs() < 1e-15 && to.acceleration.abs() < 1e-15);
/// check_rate_scheme(&Mixed)?;
/// # Ok::<(), stickslip_time::RateSchemeViolation>(())
/// ```
pub trait RateScheme: Send + Sync {
    /// The weights of a step, or of each of its stages, of length `dt` \[s\], positive.
    fn update_formula(&self, dt: f64) -> UpdateFormula;

    /// Order, symmetry, step limit and stages.
    fn properties(&self) -> SchemeProperties;

    /// The spectral radius of the [first-order generalised-alpha method](crate::FirstOrderAlpha) that replaces this
    /// scheme in a scene without inertia. `None`, the default, keeps the scheme [as it is there](crate::QuasiStatic).
    fn quasi_static_radius(&self) -> Option<f64> {
        None
    }

    /// Checks the parameters of the scheme.
    ///
    /// # Errors
    /// [`TimeError`] for a parameter out of its range.
    fn validate(&self) -> Result<(), TimeError> {
        Ok(())
    }
}

macro_rules! forward {
    ($pointer:ty) => {
        impl<T: RateScheme + ?Sized> RateScheme for $pointer {
            fn update_formula(&self, dt: f64) -> UpdateFormula {
                (**self).update_formula(dt)
            }

            fn properties(&self) -> SchemeProperties {
                (**self).properties()
            }

            fn quasi_static_radius(&self) -> Option<f64> {
                (**self).quasi_static_radius()
            }

            fn validate(&self) -> Result<(), TimeError> {
                (**self).validate()
            }
        }
    };
}

forward!(&T);
forward!(Box<T>);
forward!(std::sync::Arc<T>);
