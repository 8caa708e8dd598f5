//! Local steps of parts of a stiffness in levels: those of level `l` act every `2^l`-th step, `2^l` times as much.

use stickslip_solvers::{MOST_LEVELS, Matrix};

use crate::numerics::NUMERICS;
use crate::{StepError, StepState};

/// The number of steps between two actions of a level.
pub(super) fn interval(level: usize) -> usize {
    1 << level
}

/// The weights of levels in the forces after so many steps; 1 alone for a stiffness without levels.
pub(crate) fn weights_after(steps: usize) -> [f64; MOST_LEVELS] {
    std::array::from_fn(|level| {
        let interval = interval(level);
        if steps.is_multiple_of(interval) {
            interval as f64
        } else {
            0.0
        }
    })
}

/// The weight 1 of a level and all above.
pub(super) fn weights_from(level: usize) -> [f64; MOST_LEVELS] {
    std::array::from_fn(|l| if l >= level { 1.0 } else { 0.0 })
}

/// Refuses another step size amid a cycle: the forces of slow cells are those of equal steps.
pub(super) fn check_cycle<const C: usize>(
    stiffness: &dyn Matrix<C>,
    from: &StepState<C>,
    dt: f64,
) -> Result<(), StepError> {
    let cycle = interval(stiffness.levels() - 1);
    let (taken, before) = (from.clock.step() % cycle, from.last_step);
    if taken > 0 && (dt - before).abs() > NUMERICS.slack * before {
        return Err(StepError::AmidCycle {
            dt,
            before,
            taken,
            cycle,
        });
    }
    Ok(())
}
