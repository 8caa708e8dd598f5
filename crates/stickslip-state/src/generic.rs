//! Methods for every state law: the second-order step and slopes by finite differences.

use crate::{StateError, StateLaw, StateVariable, bracketed::increasing_root};

/// The cube root of the machine precision, the best relative step of a central difference.
const CENTRAL: f64 = 6e-6;

/// One step of the stiffly accurate, L-stable, singly diagonally implicit Runge-Kutta method of
/// second order (Alexander 1977), whose two stages are steps of backward Euler.
///
/// The exact solution moves towards the zero of `g` and never beyond. The method's stability function is negative for
/// decay rates above `1/((1 - 2 gamma) dt)`, so the method can overshoot. Then the zero is the result, which is between
/// it and the solution.
pub(crate) fn second_order<T: StateLaw + ?Sized>(
    law: &T,
    from: T::State,
    slip_rate: f64,
    dt: f64,
) -> Result<T::State, StateError> {
    let gamma = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    let first = law.advance(from, slip_rate, gamma * dt)?;
    let start = from.value();
    let ahead = start + (1.0 - gamma) / gamma * (first.value() - start);
    let second = law.advance(T::State::from_value(ahead), slip_rate, gamma * dt)?;
    let (rate, rate_there) = (
        law.evolution(from, slip_rate),
        law.evolution(second, slip_rate),
    );
    // Also where the first rate rounds to 0 but the step moved.
    if rate.signum() == rate_there.signum() || rate_there == 0.0 {
        return Ok(second);
    }
    if rate == 0.0 {
        return Ok(from);
    }
    increasing_root(first.value(), |x| {
        let state = T::State::from_value(x);
        (
            -law.evolution(state, slip_rate),
            -law.evolution_state_slope(state, slip_rate),
        )
    })
    .map(T::State::from_value)
    .map_err(|error| error.in_step(start, slip_rate, dt))
}

/// The slope of a step of backward Euler by the implicit function theorem, from the slopes of `g`.
pub(crate) fn implicit_slope<T: StateLaw + ?Sized>(
    law: &T,
    to: T::State,
    slip_rate: f64,
    dt: f64,
) -> f64 {
    let drive = dt * slope_in_rate(slip_rate, |rate| law.evolution(to, rate));
    let resistance = 1.0 - dt * law.evolution_state_slope(to, slip_rate);
    // Infinite over infinite is a state held by an infinite decay.
    if dt == 0.0 || drive == 0.0 || resistance == f64::INFINITY {
        0.0
    } else {
        drive / resistance
    }
}

/// `df/dV` by a central difference, at rest by a forward one that is exact for parabolas.
///
/// A central difference has an error of `1e-10` in `df/d ln V`, relative to `f`. At rest the scale of `V` is unknown:
/// the step grows until `f` changes.
pub(crate) fn slope_in_rate(slip_rate: f64, f: impl Fn(f64) -> f64) -> f64 {
    if slip_rate > 0.0 {
        let h = (CENTRAL * slip_rate).max(f64::from_bits(1));
        let (low, high) = (slip_rate - h, slip_rate + h);
        return (f(high) - f(low)) / (high - low);
    }
    let rest = f(0.0);
    let mut h = 1e-300;
    while h < 1e12 {
        let change = f(h) - rest;
        if change.abs() > 1e-8 * rest.abs() {
            return (4.0 * change - (f(2.0 * h) - rest)) / (2.0 * h);
        }
        h *= 1e3;
    }
    0.0
}
