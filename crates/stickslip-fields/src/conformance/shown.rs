//! Pressures, readings and totals.

use super::FieldViolation;
use super::samples::{Samples, difference, finite, largest};

/// Pressures that are compared to rounding, in units of the largest.
const ROUNDING: f64 = 1e-12;

/// The same of pressures in which memories may cancel.
const LINEAR: f64 = 1e-8;

/// The times for which sources are held \[s\].
const TIMES: [f64; 4] = [1e-3, 1.0, 1e4, 1e9];

/// Checks what the field shows of its initial memory, and of those that sources lead to.
pub(super) fn check(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    check_memory(samples, &samples.memory)?;
    for source in &samples.sources {
        let range = samples.range(source)?;
        for time in TIMES {
            let [with, without] = samples.held(source, time)?;
            check_memory(samples, &with)?;
            check_linear(samples, [&with, &without], range)?;
            samples.sources_at(&with)?;
        }
    }
    Ok(())
}

fn check_memory(samples: &Samples<'_>, memory: &[f64]) -> Result<(), FieldViolation> {
    let (field, vertices) = (samples.field, samples.vertices);
    let pressure = samples.pressure(memory)?;
    let before: Vec<f64> = (0..vertices).map(|k| 1e6 * (k + 1) as f64).collect();
    let mut sum = before.clone();
    field.pressure(memory, &mut sum);
    let expected: Vec<f64> = before.iter().zip(&pressure).map(|(a, b)| a + b).collect();
    let (place, by) = difference(&sum, &expected);
    if by > ROUNDING * largest(&expected).max(largest(&before)) {
        return Err(FieldViolation::Differs {
            what: "pressure added to that of another field, at vertex",
            place,
            dt: None,
            found: sum[place],
            requirement: "the sum",
            expected: expected[place],
        });
    }
    for number in 0..field.readings().len() {
        let mut values = vec![f64::NAN; vertices];
        field.read(number, memory, &mut values);
        finite(field.readings()[number].name, None, &values)?;
    }
    for (number, total) in field.totals().iter().enumerate() {
        finite(total.name, None, &[field.total(number, memory)])?;
    }
    Ok(())
}

/// The pressure is linear along the line through two memories of one time.
fn check_linear(
    samples: &Samples<'_>,
    [with, without]: [&[f64]; 2],
    range: f64,
) -> Result<(), FieldViolation> {
    let between = |a: &[f64], b: &[f64], factor: f64| -> Vec<f64> {
        (a.iter().zip(b))
            .map(|(a, b)| b + factor * (a - b))
            .collect()
    };
    let (of_with, of_without) = (samples.pressure(with)?, samples.pressure(without)?);
    for factor in [0.375, -2.0] {
        let found = samples.pressure(&between(with, without, factor))?;
        let expected = between(&of_with, &of_without, factor);
        let (place, by) = difference(&found, &expected);
        let bound = LINEAR * range.max(largest(&of_with)).max(largest(&of_without));
        let agrees = by <= bound;
        if !agrees {
            return Err(FieldViolation::Differs {
                what: "pressure of a mean of two memories, at vertex",
                place,
                dt: None,
                found: found[place],
                requirement: "the mean",
                expected: expected[place],
            });
        }
    }
    Ok(())
}
