//! Steps without sources.

use super::FieldViolation;
use super::samples::{Samples, difference, largest, steps};

/// The time for which a source is held: longer than most relaxations \[s\]. The pressure that it leads to is that of the
/// slowest memory, and does not rise when the source ends.
const HELD: f64 = 1e9;

/// The steps of one length.
const REPEATED: usize = 32;

/// The growth of the largest pressure that an advance may have, in units of it: rounding, or the undershoot of L-stable
/// methods.
const GROWTH: f64 = 0.25;

/// Checks that pressures without source do not grow, and vanish or stay in a long step as in two.
pub(super) fn check(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    let growth = if samples.is_exact()? { 1e-6 } else { GROWTH };
    for source in &samples.sources {
        let [with, without] = samples.held(source, HELD)?;
        let size = largest(&fed(samples, [&with, &without])?);
        let mut is_driven = false;
        for dt in steps() {
            let mut memories = [with.clone(), without.clone()];
            for _ in 0..REPEATED {
                for memory in &mut memories {
                    *memory = samples.advance(memory, [&samples.none; 2], dt)?;
                }
                let [with, later] = &memories;
                is_driven |= samples.pressure(later)? != samples.pressure(&without)?;
                let now = fed(samples, [with, later])?;
                let (place, largest) = difference(&now, &vec![0.0; now.len()]);
                if !is_driven && largest > (1.0 + growth) * size {
                    return Err(FieldViolation::Differs {
                        what: "pressure without source at vertex",
                        place,
                        dt: Some(dt),
                        found: now[place],
                        requirement: "at most, in magnitude, the largest before,",
                        expected: size,
                    });
                }
            }
        }
        if !is_driven {
            check_limit(samples, [&with, &without], size)?;
        }
    }
    Ok(())
}

/// One step much longer than all relaxations leads where two lead: L-stable methods do, others ring.
fn check_limit(
    samples: &Samples<'_>,
    [with, without]: [&[f64]; 2],
    size: f64,
) -> Result<(), FieldViolation> {
    const LONG: f64 = 1e15;
    let none = [samples.none.as_slice(); 2];
    let once = [
        samples.advance(with, none, LONG)?,
        samples.advance(without, none, LONG)?,
    ];
    let twice = [
        samples.halves(with, none, LONG)?,
        samples.halves(without, none, LONG)?,
    ];
    let [once, twice] = [
        fed(samples, [&once[0], &once[1]])?,
        fed(samples, [&twice[0], &twice[1]])?,
    ];
    let (place, by) = difference(&once, &twice);
    if by > GROWTH * size {
        return Err(FieldViolation::Differs {
            what: "pressure without source at vertex",
            place,
            dt: Some(LONG),
            found: once[place],
            requirement: "as after two halves of the step (L-stable),",
            expected: twice[place],
        });
    }
    Ok(())
}

/// The pressure that sources have fed.
fn fed(samples: &Samples<'_>, [with, without]: [&[f64]; 2]) -> Result<Vec<f64>, FieldViolation> {
    let mut with = samples.pressure(with)?;
    for (with, without) in with.iter_mut().zip(samples.pressure(without)?) {
        *with -= without;
    }
    Ok(with)
}
