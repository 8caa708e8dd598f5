//! Steps of backward Euler, and slopes of steps.

use super::{SLOPES, StateLawViolation, Step, difference, evolution_at, resolution};
use crate::{StateLaw, StateVariable};

/// Checks that invalid steps are refused, and that a step of zero length keeps the state.
pub(super) fn check_refusals<T: StateLaw + ?Sized>(
    law: &T,
    from: f64,
) -> Result<(), StateLawViolation> {
    for (slip_rate, dt) in [(f64::NAN, 1.0), (-1.0, 1.0), (1.0, f64::NAN), (1.0, -1.0)] {
        if law
            .advance(T::State::from_value(from), slip_rate, dt)
            .is_ok()
        {
            return Err(StateLawViolation::Accepts {
                step: Step {
                    from,
                    slip_rate,
                    dt,
                },
            });
        }
    }
    Ok(())
}

/// `states` in increasing order.
pub(super) fn check<T: StateLaw + ?Sized>(
    law: &T,
    states: &[f64],
    slip_rate: f64,
    dt: f64,
) -> Result<(), StateLawViolation> {
    let mut previous: Option<(f64, f64)> = None;
    for &from in states {
        let step = Step {
            from,
            slip_rate,
            dt,
        };
        let still = law.advance(T::State::from_value(from), slip_rate, 0.0)?;
        if still.value() != from {
            return Err(StateLawViolation::Step {
                property: "state after no time",
                step: Step { dt: 0.0, ..step },
                found: still.value(),
                expected: from,
            });
        }
        let to = law
            .advance(T::State::from_value(from), slip_rate, dt)?
            .value();
        if !to.is_finite() {
            return Err(StateLawViolation::NotFinite { step, to });
        }
        if let Some((lower, to_lower)) = previous
            && to_lower > to + resolution(lower, to_lower) + resolution(from, to)
        {
            return Err(StateLawViolation::Order {
                step: Step {
                    from: lower,
                    ..step
                },
                to: to_lower,
                upper: from,
                to_upper: to,
            });
        }
        previous = Some((from, to));
    }
    for &from in states {
        let step = Step {
            from,
            slip_rate,
            dt,
        };
        let to = law.advance(T::State::from_value(from), slip_rate, dt)?;
        check_solution(law, step, to.value())?;
        check_slopes(law, step)?;
    }
    Ok(())
}

/// `alpha - from - dt g(alpha)` increases at least as fast as `alpha`: it must change sign around the
/// result.
fn check_solution<T: StateLaw + ?Sized>(
    law: &T,
    step: Step,
    to: f64,
) -> Result<(), StateLawViolation> {
    let Step {
        from,
        slip_rate,
        dt,
    } = step;
    let residual = |x| x - from - dt * evolution_at(law, x, slip_rate);
    // Laws that read the logarithm of the rate round that, too.
    let logarithm = slip_rate.max(f64::MIN_POSITIVE).ln().abs();
    let near = resolution(from, to) + f64::EPSILON * logarithm;
    if residual(to - near) <= 0.0 && residual(to + near) >= 0.0 {
        return Ok(());
    }
    let (mut width, upwards) = (1.0, residual(from) < 0.0);
    let (mut lower, mut upper) = (from, from);
    while width < 1e300 {
        let end = if upwards { from + width } else { from - width };
        if upwards {
            upper = end;
        } else {
            lower = end;
        }
        if (residual(end) < 0.0) != upwards {
            break;
        }
        width *= 2.0;
    }
    for _ in 0..2000 {
        let middle = f64::midpoint(lower, upper);
        if residual(middle) < 0.0 {
            lower = middle;
        } else {
            upper = middle;
        }
    }
    Err(StateLawViolation::Step {
        property: "backward Euler",
        step,
        found: to,
        expected: upper,
    })
}

/// Checks the slopes. At rest they need only be numbers: there may be no scale for a difference.
fn check_slopes<T: StateLaw + ?Sized>(law: &T, step: Step) -> Result<(), StateLawViolation> {
    let Step {
        from,
        slip_rate,
        dt,
    } = step;
    let start = T::State::from_value(from);
    let euler = |rate| law.advance(start, rate, dt);
    let constant = |rate| law.advance_at_constant_rate(start, rate, dt);

    let to = euler(slip_rate)?;
    let slope = law.advance_rate_slope(start, to, slip_rate, dt);
    let value = |rate| euler(rate).map_or(f64::NAN, StateVariable::value);
    if let Some(difference) = disagreement(slip_rate, slope, resolution(from, to.value()), value) {
        return Err(StateLawViolation::Step {
            property: SLOPES[0],
            step,
            found: slope,
            expected: difference,
        });
    }

    let to = constant(slip_rate)?;
    if !to.value().is_finite() {
        return Err(StateLawViolation::NotFinite {
            step,
            to: to.value(),
        });
    }
    let slope = law.advance_at_constant_rate_rate_slope(start, to, slip_rate, dt);
    let value = |rate| constant(rate).map_or(f64::NAN, StateVariable::value);
    if let Some(difference) = disagreement(slip_rate, slope, resolution(from, to.value()), value) {
        return Err(StateLawViolation::Step {
            property: SLOPES[1],
            step,
            found: slope,
            expected: difference,
        });
    }
    Ok(())
}

/// The difference quotient, if it contradicts the slope.
fn disagreement(slip_rate: f64, slope: f64, noise: f64, value: impl Fn(f64) -> f64) -> Option<f64> {
    // In units of the rate, so that nothing overflows.
    if slip_rate < f64::MIN_POSITIVE {
        return slope.is_nan().then_some(f64::NAN);
    }
    let (quotient, uncertainty) =
        difference::smooth(|ratio| value(ratio * slip_rate), 1.0, 1e-5, noise)?;
    let wrong = slope.is_nan() || (slope * slip_rate - quotient).abs() > uncertainty;
    wrong.then_some(quotient / slip_rate)
}
