//! The trait of all state laws.

use crate::{Evolutions, StateError, StateVariable, bracketed::increasing_root, generic};

/// A state law `alpha' = g(alpha, V)` with `g` non-increasing in `alpha`.
///
/// Implement [`evolution`](Self::evolution) and [`evolution_state_slope`](Self::evolution_state_slope), and
/// [`validate`](Self::validate) if there are parameters. Override [`advance`](Self::advance) if the step of backward
/// Euler has a closed form and [`advance_exact`](Self::advance_exact) if the equation has one at constant slip rate,
/// each together with its slope in the slip rate, [`advance_rate_slope`](Self::advance_rate_slope) and
/// [`advance_at_constant_rate_rate_slope`](Self::advance_at_constant_rate_rate_slope).
///
/// `g` may jump down (a set-valued law): a step then stops at the jump. It may be infinite, but
/// must not be NaN, for any finite state and any slip rate `V >= 0`.
///
/// ```
/// use stickslip_state::{StateError, StateLaw, Theta, check_state_law};
///
/// /// theta' = 1 - (V theta / 2L)^2
/// struct PerrinRiceZheng {
///     slip_distance: f64,
/// }
///
/// impl StateLaw for PerrinRiceZheng {
///     type State = Theta;
///
///     // The square keeps its sign, so that g also decreases where theta < 0.
///     fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
///         let x = slip_rate * theta / (2.0 * self.slip_distance);
///         1.0 - x * x.abs()
///     }
///
///     fn evolution_state_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
///         let rate = slip_rate / (2.0 * self.slip_distance);
///         -2.0 * theta.abs() * rate * rate
///     }
///
///     fn validate(&self) -> Result<(), StateError> {
///         StateError::check_positive("slip_distance", self.slip_distance)
///     }
/// }
///
/// let law = PerrinRiceZheng { slip_distance: 1e-5 };
/// let Theta(theta) = law.advance(Theta(1.0), 1e-6, 1e9)?;
/// assert!((theta - 20.0).abs() < 1e-6); // steady sliding: theta = 2L/V
///
/// check_state_law(&law, &[Theta(1e-5), Theta(1.0), Theta(1e3)])?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait StateLaw: Send + Sync {
    /// The state variable of the law.
    type State: StateVariable;

    /// The rate of the state, `g(alpha, V)` \[unit of the state per s\], for `V >= 0` \[m/s\].
    fn evolution(&self, state: Self::State, slip_rate: f64) -> f64;

    /// Passes over the rates of many states, by the laws of their nodes, or by one law of all; `None` for a loop over
    /// [`evolution`](Self::evolution). Override it where several nodes can be computed per instruction.
    fn evolutions(_laws: &[Self]) -> Option<Box<dyn Evolutions<Self::State>>>
    where
        Self: Sized,
    {
        None
    }

    /// `dg/dalpha <= 0` \[1/s\]. It only steers Newton's method: any value is accepted at a jump.
    fn evolution_state_slope(&self, state: Self::State, slip_rate: f64) -> f64;

    /// One step of backward Euler: the `alpha` with `alpha - dt g(alpha, V) = from`.
    ///
    /// The solution is unique because `g` does not increase. It is found by
    /// [`increasing_root`](crate::increasing_root).
    ///
    /// # Errors
    ///
    /// A slip rate or time step that is negative or not finite, or a `g` that is NaN.
    fn advance(
        &self,
        from: Self::State,
        slip_rate: f64,
        dt: f64,
    ) -> Result<Self::State, StateError> {
        StateError::check_step(slip_rate, dt)?;
        // dt g may be 0 times infinity.
        if dt == 0.0 {
            return Ok(from);
        }
        let start = from.value();
        increasing_root(start, |x| {
            let state = Self::State::from_value(x);
            (
                x - start - dt * self.evolution(state, slip_rate),
                1.0 - dt * self.evolution_state_slope(state, slip_rate),
            )
        })
        .map(Self::State::from_value)
        .map_err(|error| error.in_step(start, slip_rate, dt))
    }

    /// The exact solution after the time `dt >= 0` \[s\] at constant slip rate `V >= 0` \[m/s\],
    /// `None` if no closed form is known.
    fn advance_exact(&self, _from: Self::State, _slip_rate: f64, _dt: f64) -> Option<Self::State> {
        None
    }

    /// `dalpha/dV` \[unit of the state per m/s\] of the step of backward Euler that led from `from`
    /// to `to`, the result of [`advance`](Self::advance).
    ///
    /// The default is the implicit function theorem, `dt dg/dV / (1 - dt dg/dalpha)` at `to`, with `dg/dV` by a
    /// difference of [`evolution`](Self::evolution). At rest it is the slope from the right. Override it for a law that
    /// jumps, since the theorem does not hold on the jump.
    fn advance_rate_slope(
        &self,
        from: Self::State,
        to: Self::State,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let _ = from;
        generic::implicit_slope(self, to, slip_rate, dt)
    }

    /// One step of second order at constant slip rate: [`advance_exact`](Self::advance_exact) if there is a closed
    /// form.
    ///
    /// Otherwise two steps of backward Euler, of length `gamma dt` from `alpha_o` and from
    /// `alpha_o + (1 - gamma)/gamma (alpha_1 - alpha_o)`, with `gamma = 1 - 1/sqrt(2)`, are an L-stable Runge-Kutta
    /// method. It is stopped at the steady state, like the solution.
    ///
    /// # Errors
    ///
    /// The errors of [`advance`](Self::advance).
    fn advance_at_constant_rate(
        &self,
        from: Self::State,
        slip_rate: f64,
        dt: f64,
    ) -> Result<Self::State, StateError> {
        StateError::check_step(slip_rate, dt)?;
        match self.advance_exact(from, slip_rate, dt) {
            Some(to) => Ok(to),
            None => generic::second_order(self, from, slip_rate, dt),
        }
    }

    /// `dalpha/dV` \[unit of the state per m/s\] of the step from `from` to `to`, the result of
    /// [`advance_at_constant_rate`](Self::advance_at_constant_rate).
    ///
    /// The default is a difference of that method, NaN if the step fails. At rest it is the slope from the right.
    fn advance_at_constant_rate_rate_slope(
        &self,
        from: Self::State,
        to: Self::State,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let _ = to;
        generic::slope_in_rate(slip_rate, |rate| {
            self.advance_at_constant_rate(from, rate, dt)
                .map_or(f64::NAN, StateVariable::value)
        })
    }

    /// Checks an initial state; called once per vertex, when a scene is built. By default any finite number passes.
    ///
    /// # Errors
    ///
    /// A state outside the range of the law.
    fn validate_state(&self, state: Self::State) -> Result<(), StateError> {
        StateError::check_state(state.value())
    }

    /// Checks the parameters; called once, when a scene is built.
    ///
    /// # Errors
    ///
    /// A parameter outside the range of the law.
    fn validate(&self) -> Result<(), StateError> {
        Ok(())
    }
}
