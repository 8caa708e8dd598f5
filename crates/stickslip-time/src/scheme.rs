//! The contract of a time discretisation in velocity form.

use crate::{Facts, Rule, TimeError};

/// A one-step time discretisation with the velocity as unknown, as a value.
///
/// Implement [`rule`](RateScheme::rule), which says how displacement and acceleration at the new time are
/// linear in the old motion and the new velocity, and [`facts`](RateScheme::facts), what is known of the
/// scheme. Override [`validate`](RateScheme::validate) for parameters that have a range.
/// [`check_rate_scheme`](crate::check_rate_scheme) tells whether a scheme is what it says.
///
/// ```
/// use stickslip_time::{Facts, Motion, RateScheme, Rule, Weights, check_rate_scheme};
///
/// /// The trapezoidal rule for the displacement, backward Euler for the velocity.
/// struct Mixed;
///
/// impl RateScheme for Mixed {
///     fn rule(&self, dt: f64) -> Rule {
///         let mean = Weights { velocity: dt / 2.0, new_velocity: dt / 2.0, ..Weights::STAY };
///         Rule {
///             displacement: mean,
///             acceleration: Weights { velocity: -1.0 / dt, new_velocity: 1.0 / dt, ..Weights::ZERO },
///             carried: Weights::ZERO,
///             prescribed: mean,
///         }
///     }
///
///     fn facts(&self) -> Facts {
///         Facts { quasi_static_order: 2, ..Facts::FIRST_ORDER }
///     }
/// }
///
/// let from = Motion { velocity: 2.0, ..Motion::default() };
/// let to = Mixed.rule(0.1).motion(from, 2.0);
/// assert!((to.displacement - 0.2).abs() < 1e-15 && to.acceleration.abs() < 1e-15);
/// check_rate_scheme(&Mixed)?;
/// # Ok::<(), stickslip_time::RateSchemeViolation>(())
/// ```
pub trait RateScheme: Send + Sync {
    /// The weights of a step, or of each of its stages, of length `dt` \[s\], positive.
    fn rule(&self, dt: f64) -> Rule;

    /// Order, symmetry, step limit and stages.
    fn facts(&self) -> Facts;

    /// The spectral radius of the [first-order generalised-alpha method](crate::FirstOrderAlpha) that takes the place of
    /// this scheme in a scene without inertia; none, the default, leaves the scheme [as it is there](crate::QuasiStatic).
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
            fn rule(&self, dt: f64) -> Rule {
                (**self).rule(dt)
            }

            fn facts(&self) -> Facts {
                (**self).facts()
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
