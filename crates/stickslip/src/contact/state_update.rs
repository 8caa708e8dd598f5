//! How the state of a vertex follows its slip rate over one step.

use stickslip_state::{StateError, StateLaw};

/// The discrete evolution of the state over a step of `dt`, from the slip rate `V_o` to `V`.
///
/// | | rate used | order in time | |
/// | --- | --- | --- | --- |
/// | `BackwardEuler` | `V` | 1 | the pairing of the paper |
/// | `Midpoint` (default) | `(V_o + V)/2` | 2 | the law's exact solution at that rate, or an L-stable rule of second order |
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum StateUpdate {
    /// `alpha - dt g(alpha, V) = alpha_o`.
    BackwardEuler,
    /// `alpha' = g(alpha, (V_o + V)/2)`, integrated by
    /// [`StateLaw::advance_at_constant_rate`].
    #[default]
    Midpoint,
}

impl StateUpdate {
    /// The shares of a change of the state by the normal stress before and after the step of the law.
    ///
    /// Around a step at the midpoint they are the same, which is of second order (G. Strang, SIAM J. Numer.
    /// Anal. 5 (1968)). Backward Euler for the variable in which the normal stress does not appear is the whole
    /// of it before.
    pub(crate) fn shares(self) -> [f64; 2] {
        match self {
            Self::BackwardEuler => [1.0, 0.0],
            Self::Midpoint => [0.5, 0.5],
        }
    }
}

/// A step of the state at all vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StateStep {
    pub(crate) dt: f64,
    pub(crate) update: StateUpdate,
}

impl StateStep {
    /// The state at the slip rate `slip_rate` at the end of the step, from a state and a slip rate.
    #[inline]
    pub(crate) fn advance<S: StateLaw>(
        &self,
        law: &S,
        from: S::State,
        old_rate: f64,
        slip_rate: f64,
    ) -> Result<S::State, StateError> {
        match self.update {
            StateUpdate::BackwardEuler => law.advance(from, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                law.advance_at_constant_rate(from, midpoint(old_rate, slip_rate), self.dt)
            }
        }
    }

    /// The derivative of [`advance`](Self::advance), whose result is `to`, in the slip rate.
    #[inline]
    pub(crate) fn slope<S: StateLaw>(
        &self,
        law: &S,
        (from, to): (S::State, S::State),
        old_rate: f64,
        slip_rate: f64,
    ) -> f64 {
        match self.update {
            StateUpdate::BackwardEuler => law.advance_rate_slope(from, to, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                let rate = midpoint(old_rate, slip_rate);
                0.5 * law.advance_at_constant_rate_rate_slope(from, to, rate, self.dt)
            }
        }
    }
}

fn midpoint(old_rate: f64, slip_rate: f64) -> f64 {
    0.5 * old_rate + 0.5 * slip_rate
}
