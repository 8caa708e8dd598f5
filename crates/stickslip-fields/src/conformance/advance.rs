//! Steps of no length, in halves, and without storing the memory.

use super::FieldViolation;
use super::samples::{Samples, difference, finite, largest, steps};

/// The digits of an exact advance, in units of the largest contribution.
const EXACT: f64 = 1e-12;

/// The digits of a pressure that is not taken from the memory.
const PRESSURE: f64 = 1e-8;

/// The times for which sources are held before the checked step \[s\].
const TIMES: [f64; 2] = [1.0, 1e6];

/// Calls a check at the initial memory and those that sources lead to, each with the range of pressures on the way, with
/// sources that change.
fn each(
    samples: &Samples<'_>,
    check: impl Fn((&[f64], f64), [&[f64]; 2]) -> Result<(), FieldViolation>,
) -> Result<(), FieldViolation> {
    let mut memories = vec![(samples.memory.clone(), 0.0)];
    for source in &samples.sources[..3] {
        let range = samples.range(source)?;
        for time in TIMES {
            let [with, _] = samples.held(source, time)?;
            memories.push((with, range));
        }
    }
    for (memory, range) in &memories {
        let memory = (memory.as_slice(), *range);
        for pair in samples.sources.windows(2) {
            check(memory, [&pair[0], &pair[1]])?;
            check(memory, [&pair[1], &pair[0]])?;
        }
        check(memory, [&samples.none; 2])?;
    }
    Ok(())
}

/// Checks steps of 0 s, and pressures without memory.
pub(super) fn check(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    each(samples, |(memory, range), source| {
        let to = samples.advance(memory, source, 0.0)?;
        for place in 0..to.len() {
            let (found, expected) = (to[place], memory[place]);
            if (found - expected).abs() > 4.0 * f64::EPSILON * expected.abs() {
                return Err(FieldViolation::Differs {
                    what: "memory",
                    place,
                    dt: Some(0.0),
                    found,
                    requirement: "as before,",
                    expected,
                });
            }
        }
        let mut size = largest(&samples.pressure(memory)?).max(range);
        for dt in [0.0].into_iter().chain(steps()) {
            size = check_pressure_after(samples, (memory, source, dt), size)?;
        }
        Ok(())
    })
}

/// The largest pressure by then; parts of the memory may cancel in later ones.
fn check_pressure_after(
    samples: &Samples<'_>,
    (memory, source, dt): (&[f64], [&[f64]; 2], f64),
    before: f64,
) -> Result<f64, FieldViolation> {
    let expected = samples.pressure(&samples.advance(memory, source, dt)?)?;
    let mut found = vec![1.0; samples.vertices];
    let mut scratch = vec![f64::NAN; memory.len()];
    (samples.field)
        .pressure_after(memory, source, dt, &mut found, &mut scratch)
        .map_err(|error| FieldViolation::Refused { dt, error })?;
    finite("pressure_after at vertex", Some(dt), &found)?;
    // The sources of a stage read what is left there.
    samples.sources_at(&scratch)?;
    for found in &mut found {
        *found -= 1.0;
    }
    let mut size = largest(&expected).max(before);
    for held in source {
        let to = samples.advance(memory, [held; 2], dt)?;
        size = largest(&samples.pressure(&to)?).max(size);
    }
    let (place, by) = difference(&found, &expected);
    if by > PRESSURE * (size + 1e-3) {
        return Err(FieldViolation::Differs {
            what: "pressure_after at vertex",
            place,
            dt: Some(dt),
            found: found[place],
            requirement: "that of the advanced memory,",
            expected: expected[place],
        });
    }
    Ok(size)
}

/// Checks that two halves of a step lead to the end of the whole, where the pressure shows a difference: a memory that it does
/// not show, such as a permeability without flow, may be of second order.
pub(super) fn check_halves(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    each(samples, |(memory, _), source| {
        for dt in steps() {
            let whole = samples.advance(memory, source, dt)?;
            let halves = samples.halves(memory, source, dt)?;
            if samples.pressure(&whole)? == samples.pressure(&halves)? {
                continue;
            }
            let [first, last] = source;
            let first = samples.advance(memory, [first; 2], dt)?;
            let last = samples.advance(memory, [last; 2], dt)?;
            for place in 0..memory.len() {
                let parts = [memory[place], whole[place], first[place], last[place]];
                if (halves[place] - whole[place]).abs() > EXACT * largest(&parts) {
                    return Err(FieldViolation::Differs {
                        what: "memory, by two halves, at place",
                        place,
                        dt: Some(dt),
                        found: halves[place],
                        requirement: "as by the whole step, since `error` adds nothing,",
                        expected: whole[place],
                    });
                }
            }
        }
        Ok(())
    })
}
