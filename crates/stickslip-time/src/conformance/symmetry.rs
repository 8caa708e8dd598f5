//! Check of a step forward and one back.

use super::RateSchemeViolation;
use super::oscillator::Oscillator;
use crate::{Motion, RateScheme};

/// The distance from a start of size one at which a symmetric scheme returns.
const BACK: f64 = 1e-13;

/// Checks that a step, a reversal of the velocity, and a step return to the start.
pub(super) fn check<R: RateScheme + ?Sized>(
    scheme: &R,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    if !scheme.properties().symmetric || !inertia {
        return Ok(());
    }
    let free = Oscillator {
        mass: 1.0,
        damping: 0.0,
        stiffness: 1.0,
    };
    let turn = |motion: Motion| Motion {
        velocity: -motion.velocity,
        algorithmic: -motion.algorithmic,
        ..motion
    };
    let start = Motion {
        displacement: 0.6,
        velocity: -0.8,
        acceleration: -0.6,
        algorithmic: 0.0,
    };
    let there = free.step(scheme, start, 0.0, 0.3, |_| 0.0);
    let back = turn(free.step(scheme, turn(there), 0.0, 0.3, |_| 0.0));
    let distance = (back.displacement - start.displacement)
        .hypot(back.velocity - start.velocity)
        .hypot(back.acceleration - start.acceleration);
    if distance <= BACK {
        Ok(())
    } else {
        Err(RateSchemeViolation {
            property: "symmetry",
            quantity: "distance from the start after a step forth and one back",
            at: None,
            value: distance,
            requirement: "at most",
            bound: Some(BACK),
        })
    }
}
