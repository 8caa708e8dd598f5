//! The contract of a time discretisation in velocity form.

use crate::TimeError;

/// Displacement \[m\], velocity [m/s] and acceleration [m/s^2] of one component at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// `u` \[m\].
    pub displacement: f64,
    /// `v` [m/s].
    pub velocity: f64,
    /// `a` [m/s^2].
    pub acceleration: f64,
    /// What the scheme carries on beside the motion, see [`RateScheme::carry`]; 0 for most.
    pub carried: f64,
}

/// What displacement and acceleration at the new time would be with a velocity of zero there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Predicted {
    /// `u^` \[m\].
    pub displacement: f64,
    /// `a^` [m/s^2].
    pub acceleration: f64,
}

/// The weights with which the new velocity enters displacement and acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// `c_u` in `u = c_u v + u^` \[s\]; the factor of the stiffness matrix, 0 in an explicit scheme.
    pub displacement: f64,
    /// `c_a` in `a = c_a v + a^` [1/s]; the factor of the mass matrix, 0 without inertia.
    pub acceleration: f64,
}

/// A step in two stages: the scheme itself over `share dt`, and then over `share dt` again, to the end
/// of the step, from `old + weight (first - old)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stages {
    /// The length of each stage over that of the step.
    pub share: f64,
    /// How far the second stage starts beyond the first one's result.
    pub weight: f64,
}

impl Coefficients {
    /// The motion at the new time for the velocity `v` [m/s], without what a scheme carries on.
    #[inline]
    pub fn motion(&self, v: f64, predicted: Predicted) -> Motion {
        Motion {
            displacement: self.displacement * v + predicted.displacement,
            velocity: v,
            acceleration: self.acceleration * v + predicted.acceleration,
            carried: 0.0,
        }
    }
}

/// A one-step time discretisation with the velocity as unknown: `u = c_u v + u^`, `a = c_a v + a^`.
///
/// Implement the two functions, which act on one component at a time. Both are linear in the
/// motion; `predict` of a motion at rest is at rest. [`check_rate_scheme`](crate::check_rate_scheme)
/// tells whether a scheme keeps to this and converges. Override [`validate`](RateScheme::validate)
/// for parameters that have a range.
///
/// ```
/// use stickslip_time::{Coefficients, Motion, Predicted, RateScheme};
///
/// /// The implicit midpoint rule for the displacement, backward Euler for the velocity.
/// struct Mixed;
///
/// impl RateScheme for Mixed {
///     fn coefficients(&self, dt: f64) -> Coefficients {
///         Coefficients { displacement: dt / 2.0, acceleration: 1.0 / dt }
///     }
///     fn predict(&self, dt: f64, from: Motion) -> Predicted {
///         Predicted {
///             displacement: from.displacement + dt / 2.0 * from.velocity,
///             acceleration: -from.velocity / dt,
///         }
///     }
/// }
///
/// let predicted = Mixed.predict(0.1, Motion { velocity: 2.0, ..Motion::default() });
/// let motion = Mixed.coefficients(0.1).motion(2.0, predicted);
/// assert!((motion.displacement - 0.2).abs() < 1e-15 && motion.acceleration.abs() < 1e-15);
/// stickslip_time::check_rate_scheme(&Mixed)?;
/// # Ok::<(), stickslip_time::RateSchemeViolation>(())
/// ```
pub trait RateScheme {
    /// `c_u` and `c_a` for a step of `dt` \[s\], positive; `c_u` is 0 for every step, or for none.
    fn coefficients(&self, dt: f64) -> Coefficients;

    /// `u^` and `a^` at the end of a step of `dt` \[s\] that starts in `from`.
    fn predict(&self, dt: f64, from: Motion) -> Predicted;

    /// What the scheme carries on from a step of `dt` \[s\] that starts in `from` and ends with the
    /// velocity `v`: a number a component that returns in [`Motion::carried`], linear in all of them.
    /// `None`, and nothing is stored, unless the scheme says otherwise. With it, a simulation moves
    /// components of prescribed velocity by the mean over the step, not by `c_u` and `u^`.
    fn carry(&self, dt: f64, from: Motion, v: f64) -> Option<f64> {
        let _ = (dt, from, v);
        None
    }

    /// Two stages in place of one, `None` unless the scheme says otherwise.
    fn stages(&self) -> Option<Stages> {
        None
    }

    /// The largest `omega dt` for which oscillations of the angular frequency `omega` stay bounded,
    /// `None` for a scheme that is stable for every step.
    fn stability_limit(&self) -> Option<f64> {
        None
    }

    /// Whether a step back leads to where a step forth began, so that the error has even powers of
    /// the step only; `false` unless the scheme says otherwise.
    fn is_symmetric(&self) -> bool {
        false
    }

    /// The order of the scheme in time, 1 unless it says otherwise.
    fn order(&self) -> usize {
        1
    }

    /// Checks the parameters of the scheme.
    ///
    /// # Errors
    /// [`TimeError::InvalidParameter`] for a parameter out of its range.
    fn validate(&self) -> Result<(), TimeError> {
        Ok(())
    }
}

macro_rules! forward {
    ($pointer:ty) => {
        impl<T: RateScheme + ?Sized> RateScheme for $pointer {
            fn coefficients(&self, dt: f64) -> Coefficients {
                (**self).coefficients(dt)
            }

            fn predict(&self, dt: f64, from: Motion) -> Predicted {
                (**self).predict(dt, from)
            }

            fn carry(&self, dt: f64, from: Motion, v: f64) -> Option<f64> {
                (**self).carry(dt, from, v)
            }

            fn stages(&self) -> Option<Stages> {
                (**self).stages()
            }

            fn stability_limit(&self) -> Option<f64> {
                (**self).stability_limit()
            }

            fn is_symmetric(&self) -> bool {
                (**self).is_symmetric()
            }

            fn order(&self) -> usize {
                (**self).order()
            }

            fn validate(&self) -> Result<(), TimeError> {
                (**self).validate()
            }
        }
    };
}

forward!(&T);
forward!(Box<T>);
