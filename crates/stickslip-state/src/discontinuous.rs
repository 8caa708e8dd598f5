//! A state law with a discontinuous right-hand side.

use crate::{StateError, StateLaw, Theta};

/// The discontinuous law, `theta' = V` below and `-V` above `theta V = 1`.
///
/// It is minus the subdifferential of `abs(theta V - 1)` in `theta`: on the hyperbola itself any rate in `[-V, V]` is
/// admissible and the state stays. Both ways to advance agree, since the state changes at constant speed and stops at
/// `1/V`. At `V = 0` the state is constant. There are no parameters.
///
/// ```
/// # use stickslip_state::{Discontinuous, StateLaw, Theta};
/// assert_eq!(Discontinuous.advance(Theta(1.0), 0.25, 2.0)?, Theta(1.5));
/// assert_eq!(Discontinuous.advance(Theta(1.0), 0.25, 100.0)?, Theta(4.0));
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Discontinuous;

impl Discontinuous {
    fn moved(Theta(from): Theta, slip_rate: f64, dt: f64) -> Theta {
        if slip_rate == 0.0 {
            return Theta(from);
        }
        // Infinite for a subnormal slip rate, which is as good as any target out of reach.
        let target = slip_rate.recip();
        let way = dt * slip_rate;
        Theta(if from < target {
            (from + way).min(target)
        } else {
            (from - way).max(target)
        })
    }
}

impl StateLaw for Discontinuous {
    type State = Theta;

    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let excess = theta * slip_rate - 1.0;
        if excess == 0.0 {
            0.0
        } else {
            -slip_rate * excess.signum()
        }
    }

    fn evolution_state_slope(&self, _state: Theta, _slip_rate: f64) -> f64 {
        0.0
    }

    /// Toward `1/V` by at most `dt V`.
    fn advance(&self, from: Theta, slip_rate: f64, dt: f64) -> Result<Theta, StateError> {
        StateError::check_step(slip_rate, dt)?;
        Ok(Self::moved(from, slip_rate, dt))
    }

    /// Toward `1/V` by at most `dt V`.
    fn advance_exact(&self, from: Theta, slip_rate: f64, dt: f64) -> Option<Theta> {
        Some(Self::moved(from, slip_rate, dt))
    }

    /// `dt` on the way up, `-dt` on the way down and `-1/V^2` on `theta V = 1`.
    fn advance_rate_slope(
        &self,
        Theta(from): Theta,
        Theta(to): Theta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let target = slip_rate.recip();
        if to == target {
            (-target * target).max(f64::MIN)
        } else if from < target {
            dt
        } else {
            -dt
        }
    }

    /// The slope of backward Euler, which is exact.
    fn advance_at_constant_rate_rate_slope(
        &self,
        from: Theta,
        to: Theta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        self.advance_rate_slope(from, to, slip_rate, dt)
    }

    /// Accepts a `theta` that is finite and not negative.
    fn validate_state(&self, Theta(theta): Theta) -> Result<(), StateError> {
        StateError::check_state(theta)?;
        StateError::check("state theta [s]", "non-negative", theta, theta >= 0.0)
    }
}
