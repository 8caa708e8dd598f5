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

/// What the state of a vertex is advanced from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepStart<T> {
    pub(crate) state: T,
    pub(crate) slip_rate: f64,
    pub(crate) dt: f64,
    pub(crate) update: StateUpdate,
}

impl<T> StepStart<T> {
    /// The state at the slip rate `slip_rate` at the end of the step.
    #[inline]
    pub(crate) fn advance<S: StateLaw<State = T>>(
        &self,
        law: &S,
        slip_rate: f64,
    ) -> Result<T, StateError>
    where
        T: Copy,
    {
        match self.update {
            StateUpdate::BackwardEuler => law.advance(self.state, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                law.advance_at_constant_rate(self.state, self.midpoint(slip_rate), self.dt)
            }
        }
    }

    /// The derivative of [`advance`](Self::advance), whose result is `to`, in the slip rate.
    #[inline]
    pub(crate) fn slope<S: StateLaw<State = T>>(&self, law: &S, to: T, slip_rate: f64) -> f64
    where
        T: Copy,
    {
        match self.update {
            StateUpdate::BackwardEuler => law.advance_slope(self.state, to, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                let rate = self.midpoint(slip_rate);
                0.5 * law.advance_at_constant_rate_slope(self.state, to, rate, self.dt)
            }
        }
    }

    fn midpoint(&self, slip_rate: f64) -> f64 {
        0.5 * self.slip_rate + 0.5 * slip_rate
    }
}
