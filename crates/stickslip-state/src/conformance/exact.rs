//! Solutions in closed form.

use super::{CHANGE, StateLawViolation, Step, evolution_at, resolution};
use crate::{StateLaw, StateVariable};

/// Number of backward Euler steps for the comparison with a solution.
const SMALL_STEPS: u32 = 256;

/// `states` in increasing order.
pub(super) fn check<T: StateLaw + ?Sized>(
    law: &T,
    states: &[f64],
    slip_rate: f64,
    dt: f64,
) -> Result<(), StateLawViolation> {
    for &from in states {
        let step = Step {
            from,
            slip_rate,
            dt,
        };
        let Some(to) = advanced(law, step) else {
            continue;
        };
        if !to.is_finite() {
            return Err(StateLawViolation::NotFinite { step, to });
        }
        check_composition(law, step, to)?;
        check_beginning(law, step)?;
        check_limit(law, step, to)?;
    }
    Ok(())
}

fn advanced<T: StateLaw + ?Sized>(law: &T, step: Step) -> Option<f64> {
    law.advance_exact(T::State::from_value(step.from), step.slip_rate, step.dt)
        .map(StateVariable::value)
}

/// Checks the composition of a quarter and three quarters of the time; a part of zero length is skipped.
fn check_composition<T: StateLaw + ?Sized>(
    law: &T,
    step: Step,
    to: f64,
) -> Result<(), StateLawViolation> {
    let Step { from, dt, .. } = step;
    for part in [0.0, 0.25] {
        let first = Step {
            dt: part * dt,
            ..step
        };
        let middle = advanced(law, first).unwrap_or(f64::NAN);
        let second = Step {
            from: middle,
            dt: (1.0 - part) * dt,
            ..step
        };
        let in_parts = advanced(law, second).unwrap_or(f64::NAN);
        // The first part's error does not grow, since g does not increase.
        let rounding = 16.0 * (resolution(from, to) + resolution(middle, in_parts));
        if (in_parts - to).abs() > rounding || in_parts.is_nan() {
            return Err(StateLawViolation::Step {
                property: "composition of exact steps",
                step,
                found: to,
                expected: in_parts,
            });
        }
    }
    Ok(())
}

/// Checks with the midpoint rule over a time short beside the decay of the law: its error is of third order.
fn check_beginning<T: StateLaw + ?Sized>(law: &T, step: Step) -> Result<(), StateLawViolation> {
    let Step {
        from,
        slip_rate,
        dt,
    } = step;
    let slope = |x: f64| law.evolution_state_slope(T::State::from_value(x), slip_rate);
    let decay = slope(from).abs();
    let step = Step {
        dt: dt.min(1e-3 / decay),
        ..step
    };
    let half = Step {
        dt: 0.5 * step.dt,
        ..step
    };
    let (Some(middle), Some(end)) = (advanced(law, half), advanced(law, step)) else {
        return Ok(());
    };
    let rate = |x| evolution_at(law, x, slip_rate);
    let (moved, expected) = (end - from, step.dt * rate(middle));
    let bend = (slope(end).abs() - decay).abs() / decay;
    // A law without slope may jump, also within rounding of the end.
    let near = resolution(from, end);
    let smooth = if decay > 0.0 {
        bend < 0.5
    } else {
        [from - near, from + near, end - near, end + near]
            .into_iter()
            .all(|x| rate(x) == rate(middle))
    };
    if !smooth || !expected.is_finite() {
        return Ok(());
    }
    let ratio = step.dt * decay;
    let bent = if decay > 0.0 { ratio * bend } else { 0.0 };
    let tolerance = (ratio * ratio + bent) * expected.abs() + 4.0 * near;
    if (moved - expected).abs() > tolerance {
        return Err(StateLawViolation::Step {
            property: CHANGE,
            step,
            found: moved,
            expected,
        });
    }
    Ok(())
}

/// For non-increasing `g` the error of backward Euler with steps `h` is at most `h abs(g(from))`
/// (Rulla 1996).
fn check_limit<T: StateLaw + ?Sized>(
    law: &T,
    step: Step,
    to: f64,
) -> Result<(), StateLawViolation> {
    let Step {
        from,
        slip_rate,
        dt,
    } = step;
    let small = dt / f64::from(SMALL_STEPS);
    let bound = small * evolution_at(law, from, slip_rate).abs();
    // Nothing to learn from a bound beyond the change itself.
    if bound > 0.1 * (to - from).abs() && bound > resolution(from, to) || !bound.is_finite() {
        return Ok(());
    }
    let mut state = T::State::from_value(from);
    for _ in 0..SMALL_STEPS {
        state = law.advance(state, slip_rate, small)?;
    }
    let limit = state.value();
    let rounding = f64::from(SMALL_STEPS) * resolution(from, to);
    if (limit - to).abs() > bound + rounding {
        return Err(StateLawViolation::Step {
            property: "limit of small steps",
            step,
            found: to,
            expected: limit,
        });
    }
    Ok(())
}
