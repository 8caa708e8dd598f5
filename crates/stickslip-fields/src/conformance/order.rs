//! The order of an advance that is not exact.

use super::FieldViolation;
use super::samples::{Samples, difference, largest};

/// The longest step \[s\], and the times it is halved.
const LONGEST: f64 = 1e12;
const HALVINGS: i32 = 80;

/// The smallest difference of pressures that is measured, in units of the largest pressure.
const RESOLVED: f64 = 1e-10;

/// The factors by which the difference falls with half the step, in the limit, with a source that is constant and with
/// one that changes by as much whatever the step; methods of first order have half of them.
const FACTORS: [f64; 2] = [8.0, 4.0];

/// The least factors, in units of those.
const LEAST: f64 = 0.75;

/// The halvings in a row that show a factor: one alone may be that of a difference that changes its sign.
const SPAN: usize = 3;

/// The factor of some halvings.
#[derive(Clone, Copy)]
struct Shown {
    dt: f64,
    by: f64,
    factor: f64,
}

/// Checks that two halves of a step differ from the whole by the third power of its length. It is seen at steps shorter
/// than relaxations, if rounding lets it be seen: the best of all samples counts.
pub(super) fn check(samples: &Samples<'_>) -> Result<(), FieldViolation> {
    for expected in FACTORS {
        let mut best: Option<Shown> = None;
        for pair in samples.sources.windows(2) {
            let [begin, end] = [pair[0].as_slice(), &pair[1]];
            let end = if expected == FACTORS[0] { begin } else { end };
            let [with, _] = samples.held(begin, 1e6)?;
            for memory in [&samples.memory, &with] {
                let shown = shown(samples, memory, [begin, end])?;
                best = best.into_iter().chain(shown).reduce(better);
            }
        }
        if let Some(Shown { dt, by, factor }) = best
            && factor < LEAST * expected
        {
            return Err(FieldViolation::Order {
                dt,
                by,
                factor,
                expected,
            });
        }
    }
    Ok(())
}

fn better(a: Shown, b: Shown) -> Shown {
    if b.factor > a.factor { b } else { a }
}

/// The largest factor that all of [`SPAN`] halvings have.
fn shown(
    samples: &Samples<'_>,
    memory: &[f64],
    source: [&[f64]; 2],
) -> Result<Option<Shown>, FieldViolation> {
    let mut resolved = Vec::new();
    let mut best = None;
    for halving in 0..HALVINGS {
        let dt = LONGEST * 0.5_f64.powi(halving);
        let whole = samples.pressure(&samples.advance(memory, source, dt)?)?;
        let halves = samples.pressure(&samples.halves(memory, source, dt)?)?;
        let size = largest(&whole).max(largest(&halves));
        let size = size.max(largest(&samples.pressure(memory)?));
        let (_, by) = difference(&whole, &halves);
        if by <= RESOLVED * size {
            resolved.clear();
            continue;
        }
        resolved.push(by);
        let Some(first) = resolved.len().checked_sub(SPAN + 1) else {
            continue;
        };
        let factors = resolved[first..].windows(2).map(|by| by[0] / by[1]);
        let shown = Shown {
            dt,
            by: by / size,
            factor: factors.fold(f64::INFINITY, f64::min),
        };
        best = best.into_iter().chain([shown]).reduce(better);
    }
    Ok(best)
}
