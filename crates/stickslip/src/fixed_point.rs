//! The paper's coupling: a relaxed fixed point.

use crate::{Coupling, CouplingReport, StepError, StepMaps};

/// `alpha <- S(|v|)`, `v <- R(alpha)`, until two successive velocities agree.
///
/// The velocity of the last step starts the iteration. A full step is taken in the first two
/// iterations and afterwards as long as the change of the state is at most half the change before,
/// half a step otherwise. At least two velocity problems are solved: the first change, from the
/// last step's velocity, says nothing about convergence. The state of the final velocity is kept.
///
/// The last velocity problems are solved to a twentieth of the tolerance, the ones before to 0.3 %
/// of the change that is expected of the next. An inexact solver makes the relaxation rule see
/// changes that are none; at this share the iteration counts are those of exact solves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPoint {
    max_iterations: usize,
    /// The change of the last step's second velocity problem: the first that shows the coupling.
    second_change: f64,
}

/// The share of the tolerance to which the last velocity problems are solved.
const FINAL_SHARE: f64 = 0.05;
/// The share of the expected change to which the ones before are solved.
const FORCING: f64 = 3e-3;

impl FixedPoint {
    /// Gives a step up after `max_iterations` velocity problems; 200 by default.
    pub fn with_max_iterations(max_iterations: usize) -> Self {
        Self {
            max_iterations,
            second_change: 0.0,
        }
    }
}

impl Default for FixedPoint {
    fn default() -> Self {
        Self::with_max_iterations(200)
    }
}

impl Coupling for FixedPoint {
    fn couple(
        &mut self,
        maps: &mut dyn StepMaps,
        tolerance: f64,
    ) -> Result<CouplingReport, StepError> {
        let mut state_change = f64::INFINITY;
        let mut change = f64::INFINITY;
        let mut second_change = f64::INFINITY;
        for iterations in 1..=self.max_iterations {
            let last_state_change = std::mem::replace(&mut state_change, maps.propose_states()?);
            let contracts = iterations < 3 || state_change <= 0.5 * last_state_change;
            maps.relax_states(if contracts { 1.0 } else { 0.5 });
            let expected = match iterations {
                1 | 2 => self.second_change,
                _ if state_change < last_state_change => change * state_change / last_state_change,
                _ => change,
            };
            change = maps.solve_rates((FINAL_SHARE * tolerance).max(FORCING * expected))?;
            if iterations == 2 {
                second_change = change;
            }
            if iterations > 1 && change <= tolerance {
                maps.propose_states()?;
                maps.relax_states(1.0);
                // Only now: a step that fails leaves nothing behind.
                self.second_change = second_change;
                return Ok(CouplingReport {
                    iterations,
                    ..CouplingReport::default()
                });
            }
        }
        Err(StepError::NotCoupled {
            iterations: self.max_iterations,
            change,
            tolerance,
        })
    }
}
