//! Friction below a cap.

use stickslip_state::increasing_root;

use crate::{FrictionError, FrictionLaw, Response};

/// Any friction law below a cap, `min(mu(V, alpha), F)`.
///
/// A minimum of functions that do not decrease does not decrease: the potential stays convex, and the local problem has a
/// closed form if the law's has, `V = max(V_law, (drive - F)/viscosity)`. Where the cap holds, friction does not depend on slip
/// rate and state, and nothing but viscosity, inertia or the body opposes faster slip.
///
/// [`ForcedCap`](crate::ForcedCap) is a cap that falls with time.
///
/// ```
/// use stickslip_friction::{Capped, FrictionLaw, RegularizedDieterichRuina, check_friction_law};
/// use stickslip_state::LogTheta;
///
/// let law = RegularizedDieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 8e-3,
/// };
/// let (capped, state) = (Capped { law, cap: 0.4 }, LogTheta(9.0));
/// assert_eq!(capped.coefficient(1e-6, state), 0.4);
/// // The drive beyond the cap is left to viscosity.
/// assert!((capped.slip_rate(0.1, 0.5, state) - 1.0).abs() < 1e-12);
/// check_friction_law(&capped, &[state])?;
/// # Ok::<(), stickslip_friction::FrictionViolation>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("strength cap", "forced nucleation"))]
pub struct Capped<L> {
    /// The law below the cap.
    pub law: L,
    /// `F`, the largest coefficient, non-negative; infinite for none.
    pub cap: f64,
}

impl<L: FrictionLaw> Capped<L> {
    /// The slip rate up to `largest` at which the law meets the cap.
    fn meeting_rate(&self, largest: f64, state: L::State) -> f64 {
        if self.law.coefficient(0.0, state) >= self.cap {
            return 0.0;
        }
        let root = increasing_root(largest.ln(), |log_rate| {
            let rate = log_rate.exp();
            let (coefficient, slope) = self.law.coefficient_and_rate_slope(rate, state);
            (coefficient - self.cap, rate * slope)
        });
        root.map_or(f64::NAN, |log_rate| log_rate.exp().min(largest))
    }
}

impl<L: FrictionLaw> FrictionLaw for Capped<L> {
    type State = L::State;

    fn coefficient(&self, slip_rate: f64, state: L::State) -> f64 {
        let coefficient = self.law.coefficient(slip_rate, state);
        // A minimum would forget what is not a number.
        if coefficient > self.cap {
            self.cap
        } else {
            coefficient
        }
    }

    /// 0 from where the law meets the cap.
    fn coefficient_rate_slope(&self, slip_rate: f64, state: L::State) -> f64 {
        self.coefficient_and_rate_slope(slip_rate, state).1
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: L::State) -> (f64, f64) {
        let (coefficient, slope) = self.law.coefficient_and_rate_slope(slip_rate, state);
        if coefficient >= self.cap {
            (self.cap, 0.0)
        } else {
            (coefficient, slope)
        }
    }

    fn response(&self, slip_rate: f64, state: L::State) -> Response {
        self.law.response(slip_rate, state).capped(self.cap)
    }

    /// That of the law up to the rate at which it meets the cap, and `F` per slip rate from there.
    fn potential(&self, slip_rate: f64, state: L::State) -> f64 {
        let coefficient = self.law.coefficient(slip_rate, state);
        if slip_rate > 0.0 && coefficient > self.cap {
            let meeting = self.meeting_rate(slip_rate, state);
            return self.law.potential(meeting, state) + self.cap * (slip_rate - meeting);
        }
        self.law.potential(slip_rate, state)
    }

    /// 0 where the cap holds.
    fn coefficient_state_slope(&self, slip_rate: f64, state: L::State) -> f64 {
        if self.law.coefficient(slip_rate, state) >= self.cap {
            0.0
        } else {
            self.law.coefficient_state_slope(slip_rate, state)
        }
    }

    /// `max(V_law, (drive - F)/viscosity)`: of two resistances the smaller one, hence of two rates the larger one.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: L::State) -> f64 {
        let below = self.law.slip_rate(viscosity, drive, state);
        let at_cap = (drive - self.cap) / viscosity;
        if at_cap > below { at_cap } else { below }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        let what = "cap of friction";
        FrictionError::check(what, "non-negative", self.cap, self.cap >= 0.0)?;
        self.law.validate()
    }
}

impl Response {
    /// The response of friction below a cap.
    #[must_use]
    pub fn capped(self, cap: f64) -> Self {
        if self.coefficient >= cap {
            Self {
                coefficient: cap,
                rate_slope: 0.0,
                state_slope: 0.0,
            }
        } else {
            self
        }
    }
}
