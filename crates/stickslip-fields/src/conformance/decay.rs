//! Steps without sources.

use super::FieldViolation;
use super::samples::{HELD, Samples, difference, steps};

/// The steps of one length.
const REPEATED: usize = 12;

/// The growth that an advance may have, in units of the largest pressure: that between samples, or the undershoot of
/// L-stable methods.
const GROWTH: f64 = 0.25;

/// Checks that pressures without source do not grow, and vanish or stay in a long step as in two.
pub(super) fn check(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    for source in &samples.sources {
        let [with, without] = samples.held(source, HELD)?;
        let size = samples.range(source)?;
        let mut is_driven = false;
        for dt in steps() {
            let mut memories = [with.clone(), without.clone()];
            for _ in 0..REPEATED {
                for memory in &mut memories {
                    *memory = samples.advance(memory, [&samples.none; 2], dt)?;
                }
                let [with, later] = &memories;
                is_driven |= samples.pressure(later)? != samples.pressure(&without)?;
                let now = samples.fed([with, later])?;
                let (place, largest) = difference(&now, &vec![0.0; now.len()]);
                if !is_driven && largest > (1.0 + GROWTH) * size {
                    return Err(FieldViolation::Differs {
                        what: "pressure without source at vertex",
                        place,
                        dt: Some(dt),
                        found: now[place],
                        requirement: "at most, in magnitude, the largest with it,",
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
        samples.fed([&once[0], &once[1]])?,
        samples.fed([&twice[0], &twice[1]])?,
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
