//! How far two results of a step may differ because the solver has stopped: what is below is no error of the step.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use crate::contact::Placed;
use crate::step::Tolerance;
use crate::{Simulation, StepState};

/// The tolerances of the coupling by which two results may differ: one of the whole step, three of its halves, the
/// first of which moves the second by its velocity and by its acceleration, and what the acceleration of the start
/// makes of the last step, times the growth of the step.
const DOUBTS: f64 = 8.0;

/// What the solver leaves open in the difference of two results; nothing unless the tolerance is absolute and the
/// scheme implicit. A relative tolerance is near rounding, and an explicit scheme has its velocities in closed form.
pub(super) struct Resolution {
    /// By how much two velocities may differ, in the norm of the coupling.
    open: f64,
    /// The velocities differ by more.
    resolved: bool,
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// What is open in the difference from `coarser`, for which there is room in `difference`.
    pub(super) fn resolution(
        &self,
        coarser: &StepState<C>,
        difference: &mut [SVector<f64, C>],
    ) -> Resolution {
        let open = match self.method.tolerance {
            Tolerance::Absolute(tolerance) if self.weight_of_velocity() > 0.0 => DOUBTS * tolerance,
            _ => {
                return Resolution {
                    open: 0.0,
                    resolved: true,
                };
            }
        };
        let pairs = self.state.velocity.iter().zip(&coarser.velocity);
        for (difference, (now, coarser)) in difference.iter_mut().zip(pairs) {
            *difference = now - coarser;
        }
        Resolution {
            open,
            resolved: self.operators.norm().norm(difference) > open,
        }
    }

    /// How far the motion may be off, in the norm `sqrt(u . A u + v . M v)`: a velocity that is off moves the
    /// displacement by `c_u` of it.
    pub(super) fn open_motion(&self, resolution: &Resolution) -> f64 {
        resolution.open * 1.0_f64.hypot(self.weight_of_velocity())
    }

    /// `c_u` of the last step \[s\], 0 in an explicit scheme.
    fn weight_of_velocity(&self) -> f64 {
        let rule = self.method.scheme.rule(self.state.last_step);
        rule.displacement.new_velocity
    }

    /// How much of a difference of two slip rates at a vertex may be the solver's [m/s].
    pub(super) fn open_rate(&self, resolution: &Resolution, vertex: usize, difference: f64) -> f64 {
        if !resolution.resolved {
            return difference;
        }
        self.operators.velocity_of(resolution.open, vertex)
    }
}

impl Resolution {
    /// Whether nothing is open.
    pub(super) fn is_exact(&self) -> bool {
        self.open == 0.0
    }
}

/// How far a state may be off where its slip rate may be off by `open` [m/s].
pub(super) fn open_state<const C: usize>(
    contact: &Placed<C>,
    k: usize,
    slip_rate: f64,
    open: f64,
) -> f64 {
    let rates = [(slip_rate - open).max(0.0), slip_rate + open];
    match contact.interface.proposals(k, rates) {
        Some([slow, fast]) => contact.interface.distance(slow, fast),
        None => 0.0,
    }
}
