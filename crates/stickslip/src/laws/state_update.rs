//! The state update of a vertex in a step.

/// The discrete evolution of the state over a step of `dt`, from the slip rate `V_o` to `V`.
///
/// | | rate used | order in time | |
/// | --- | --- | --- | --- |
/// | `BackwardEuler` | `V` | 1 | the pairing of the paper |
/// | `Midpoint` (default) | `(V_o + V)/2` | 2 | the law's exact solution at that rate, or an L-stable rule of second order |
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum StateUpdate {
    /// `alpha - dt g(alpha, V) = alpha_o`.
    BackwardEuler,
    /// `alpha' = g(alpha, (V_o + V)/2)`, integrated by
    /// [`StateLaw::advance_at_constant_rate`](crate::state::StateLaw::advance_at_constant_rate).
    #[default]
    Midpoint,
}

impl StateUpdate {
    /// The shares of a normal stress change that act on the state before and after the step of the law.
    ///
    /// Equal shares around a midpoint step are of second order (G. Strang, SIAM J. Numer. Anal. 5 (1968)). Backward
    /// Euler in the variable that is free of the normal stress puts the whole change before the step.
    pub(crate) fn shares(self) -> [f64; 2] {
        match self {
            Self::BackwardEuler => [1.0, 0.0],
            Self::Midpoint => [0.5, 0.5],
        }
    }
}
