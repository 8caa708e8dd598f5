//! The paper's coupling: a relaxed fixed point.

use crate::numerics::NUMERICS;
use crate::{Coupling, CouplingReport, StepError, StepMaps};

/// `alpha <- S(|v|)`, `v <- R(alpha)`, until two successive velocities agree.
///
/// The iteration starts from the velocity of the last step. At least two velocity problems are solved: the first
/// change, from the last step's velocity, does not indicate convergence. Nor does a change below the tolerance that
/// exceeds the one before it: under logarithmic friction an iteration can multiply a tiny slip rate, `4e-24` m/s, by
/// `1e7`. The state of the final velocity is stored. If it differs much from a relaxed one, an unrelaxed iteration comes
/// first. The relaxation factor of the state is a choice:
///
/// | | relaxation factor |
/// | --- | --- |
/// | [`paper`](Self::paper) (default) | 1; from the third iteration on 1/2 while the change exceeds half the last one |
/// | [`accelerated`](Self::accelerated) | 1 twice, then by Aitken's rule for vectors, from the last two changes |
///
/// The multiplier of Dieterich's law is positive, so that half steps only slow the iteration down, and a rule based on
/// halved changes never ends them. Aitken's rule lengthens the steps there, and shortens them where the multiplier is
/// negative (B. Irons, R. Tuck, Int. J. Numer. Meth. Eng. 1 (1969)). A state with a strong response to the slip rate,
/// as that of [`PerrinRiceZheng`](crate::state::PerrinRiceZheng) through an event, requires it, or more than the 200
/// iterations of the default.
///
/// The last velocity problems are solved to a twentieth of the tolerance, the previous ones to 0.3 % of the expected
/// next change. An inexact solver perturbs the changes that the relaxation rule uses; at this share the iteration
/// counts equal those of exact solves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPoint {
    accelerated: bool,
    max_iterations: usize,
}

impl FixedPoint {
    /// Uses the relaxation rule of the paper.
    pub fn paper() -> Self {
        Self {
            accelerated: false,
            max_iterations: 200,
        }
    }

    /// Uses Aitken's rule.
    pub fn accelerated() -> Self {
        Self {
            accelerated: true,
            ..Self::paper()
        }
    }

    /// Limits the number of velocity problems to `max_iterations`; 200 by default.
    #[must_use]
    pub fn with_max_iterations(mut self, max_iterations: usize) -> Self {
        self.max_iterations = max_iterations;
        self
    }
}

impl Default for FixedPoint {
    fn default() -> Self {
        Self::paper()
    }
}

impl Coupling for FixedPoint {
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
        // The change of the last step's second velocity problem: the first that shows the coupling.
        let last_second_change = maps.memory()[0];
        let mut share = 1.0;
        let mut state_change = f64::INFINITY;
        let mut change = f64::INFINITY;
        let mut second_change = f64::INFINITY;
        // By how much the velocity answered to the last change of the state, and to the one before.
        let mut answers = [0.0, 0.0];
        let mut settle = false;
        for iterations in 1..=self.max_iterations {
            let last_state_change = std::mem::replace(&mut state_change, maps.propose_states()?);
            share = if iterations < 3 || settle {
                1.0
            } else if self.accelerated {
                let [shortest, longest] = NUMERICS.shares;
                let aitken = share * maps.secant_factor();
                if aitken.is_finite() {
                    aitken.clamp(shortest, longest)
                } else {
                    1.0
                }
            } else if state_change <= 0.5 * last_state_change {
                1.0
            } else {
                0.5
            };
            maps.relax_states(share);
            let expected = match iterations {
                1 | 2 => last_second_change,
                _ if state_change < last_state_change => change * state_change / last_state_change,
                _ => change,
            };
            // From the third problem on, what is left is about a geometric series: the next change follows
            // from the last one and the ratio of the changes of the state.
            let lead = if iterations > 2 && state_change < last_state_change {
                state_change / last_state_change
            } else {
                0.0
            };
            let solved_to = (NUMERICS.final_share * tolerance).max(NUMERICS.forcing * expected);
            let last_change = std::mem::replace(&mut change, maps.solve_rates(lead, solved_to)?);
            if change <= tolerance && solved_to > tolerance {
                // Solved so roughly the velocity may not have moved at all. What it has moved before counts, too.
                change = change.max(maps.solve_rates(0.0, NUMERICS.final_share * tolerance)?);
            }
            if iterations > NUMERICS.patience && change <= maps.rate_rounding()? {
                change = 0.0;
            }
            if iterations == 2 {
                second_change = change;
            }
            answers = [answers[1], change / (share * state_change)];
            settle = iterations > 1 && change <= tolerance && change <= last_change;
            if settle {
                let left = maps.propose_states()?;
                // A contact that sticks, or nearly so, does not answer to a state on its way to one
                // with which it would slide: then a whole step must leave the velocity where it is.
                let answer = answers[0].max(answers[1]) * left;
                if share != 1.0 && answer > NUMERICS.unsettled * tolerance {
                    continue;
                }
                maps.relax_states(1.0);
                // Only now: a step that fails leaves nothing behind.
                maps.memory()[0] = second_change;
                return Ok(CouplingReport {
                    iterations,
                    fell_back: false,
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
