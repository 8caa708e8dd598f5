//! A cap of friction that falls with time, for a forced rupture by any law.

use crate::{Capped, FrictionError};

/// A forced rupture for any friction law: friction is at most `F(t)`, which falls to a dynamic coefficient,
///
/// ```text
/// F(t) = f_d + (f_s - f_d) r(1 - (t - T)/t_0),   r(x) = 0 for x < 0,  x^2 (2 - x) for 0 < x < 1,  x for x > 1
///
///        \
/// f_s     \                 far ahead of the front there is no cap,
///          \                it is f_s at T, and f_d from T + t_0 on
/// f_d       `-._________
///   -------+----+------> t
///          T    T + t_0
/// ```
///
/// `F` falls throughout, with a continuous derivative. Take `f_s` no less than friction before the rupture, and the law acts
/// alone until the front arrives. It is no law itself, but the cap of one at a time ([`capped`](Self::capped)):
/// `Contact::with_friction_cap` of the crate `stickslip` takes it for any law, with and without a state. With slip weakening
/// the SCEC benchmarks take [`ForcedRupture`](crate::ForcedRupture), which fixes the fracture energy.
///
/// A front at a prescribed speed, as in Kostrov's self-similar crack, by the distance of each vertex:
///
/// ```
/// use stickslip_friction::{ForcedCap, FrictionLaw, StrongRateWeakening};
///
/// # fn main() -> Result<(), stickslip_friction::FrictionError> {
/// let law = StrongRateWeakening {
///     a: 0.01,
///     b: 0.014,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.4,
///     weakened_friction: 0.2,
///     weakening_velocity: 0.1,
/// };
/// // From 0.7 to 0.3 within 200 m behind a front at 2 km/s; nothing is forced beyond 3 km.
/// let cap = |r: f64| match r {
///     0.0..3e3 => ForcedCap::behind_front(r, 2e3, 200.0, [0.7, 0.3]),
///     _ => ForcedCap::none(),
/// };
/// let start = law.state_of_friction(0.6, 1e-9);
/// let mu = |r: f64, time| cap(r).capped(law, time).coefficient(1e-9, start);
/// assert!((mu(1e3, 0.4) - 0.6).abs() < 1e-12); // ahead of the front
/// assert_eq!((mu(1e3, 0.61), mu(4e3, 9.0)), (0.3, law.coefficient(1e-9, start)));
/// cap(1e3).validate()
/// # }
/// ```
///
/// Sources: B. V. Kostrov, *Selfsimilar problems of propagation of shear cracks*, J. Appl. Math. Mech. 28 (1964); D. J.
/// Andrews, *Dynamic plane-strain shear rupture with a slip-weakening friction law calculated by a boundary integral method*,
/// Bull. Seismol. Soc. Am. 75 (1985).
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("forced nucleation", "time weakening", "Kostrov", "kinematic front"))]
pub struct ForcedCap {
    /// `T` \[s\], the time at which the front arrives; infinite for a vertex that is not forced.
    pub rupture_time: f64,
    /// `t_0` \[s\], the time from there to the dynamic coefficient, finite and positive.
    pub duration: f64,
    /// `f_s`, the cap at the arrival, finite and above `dynamic_friction`.
    pub static_friction: f64,
    /// `f_d`, the cap in the end, finite and non-negative.
    pub dynamic_friction: f64,
}

impl ForcedCap {
    /// The cap at a distance `r` \[m\] from the hypocentre of a front with the speed `v` \[m/s\], which falls from `f_s` to
    /// `f_d` within a distance \[m\] behind it: `T = r/v`, `t_0 = width/v`.
    #[must_use]
    pub fn behind_front(distance: f64, speed: f64, width: f64, [f_s, f_d]: [f64; 2]) -> Self {
        Self {
            rupture_time: distance / speed,
            duration: width / speed,
            static_friction: f_s,
            dynamic_friction: f_d,
        }
    }

    /// No cap at any time.
    #[must_use]
    pub fn none() -> Self {
        Self {
            rupture_time: f64::INFINITY,
            duration: 1.0,
            static_friction: 1.0,
            dynamic_friction: 0.0,
        }
    }

    /// `F(t)` at a time \[s\]; infinite for a vertex that is not forced.
    #[must_use]
    pub fn cap(&self, time: f64) -> f64 {
        let left = 1.0 - (time - self.rupture_time) / self.duration;
        let ramp = if left >= 1.0 {
            left
        } else if left > 0.0 {
            left * left * (2.0 - left)
        } else {
            0.0
        };
        self.dynamic_friction + (self.static_friction - self.dynamic_friction) * ramp
    }

    /// A law below the cap of a time \[s\].
    #[must_use]
    pub fn capped<L>(&self, law: L, time: f64) -> Capped<L> {
        let cap = self.cap(time);
        Capped { law, cap }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// A rupture time that is NaN, a duration that is not finite and positive, a dynamic coefficient that is negative or not
    /// finite, a static one that is not above it or not finite.
    pub fn validate(&self) -> Result<(), FrictionError> {
        let [time, above] = [self.rupture_time, self.static_friction];
        FrictionError::check("rupture_time", "a number", time, !time.is_nan())?;
        FrictionError::check_positive("duration", self.duration)?;
        FrictionError::check_non_negative("dynamic_friction", self.dynamic_friction)?;
        FrictionError::check(
            "static_friction",
            "finite and above dynamic_friction",
            above,
            above.is_finite() && above > self.dynamic_friction,
        )
    }
}
