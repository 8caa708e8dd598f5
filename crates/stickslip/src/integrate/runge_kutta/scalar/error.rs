//! The local error of contacts with scalar local problems.

use std::ops::Range;

use nalgebra::SVector;
use stickslip_core::lanes::LANES;
use stickslip_friction::modulus;

use super::super::threads::in_shares;
use super::ScalarContact;
use crate::LocalError;
use crate::contact::DiscreteContact;
use crate::integrate::distance::rate_distance;

/// The end of a step at the vertices of the body, with its errors.
pub(in super::super) struct AtEnd<'a, const C: usize> {
    pub(in super::super) velocity: &'a [SVector<f64, C>],
    /// The forces that friction and viscosity balance \[N\], and their errors.
    pub(in super::super) forces: &'a [SVector<f64, C>],
    pub(in super::super) force_errors: &'a [SVector<f64, C>],
    /// The errors of the normal stresses; empty if none changes \[Pa\].
    pub(in super::super) clamped: &'a [f64],
}

impl<const C: usize> ScalarContact<C> {
    /// The largest errors of slip rates and states: those of the linearised local problems, by the errors of forces, of
    /// normal stresses and of the `states` of the contact (empty if it has none). `floor` is that of slip rates by the
    /// place of a vertex, and `at_rest` the change of the velocity of one that rests.
    pub(in super::super) fn local_error(
        &self,
        contact: &DiscreteContact<C>,
        at: &AtEnd<'_, C>,
        states: &[f64],
        floor: &(impl Fn(usize) -> f64 + Sync),
        at_rest: &(impl Fn(usize, &SVector<f64, C>) -> SVector<f64, C> + Sync),
    ) -> LocalError {
        let laws = contact.trial.laws();
        let share = |range: Range<usize>| {
            let mut found = LocalError::default();
            for first in range.clone().step_by(LANES) {
                let block = first..range.end.min(first + LANES);
                let slopes = slopes(contact, at.velocity, block.clone());
                for k in block {
                    let vertex = contact.part.vertices[k];
                    let mut by_state = 0.0;
                    if let Some(&error) = states.get(k) {
                        let state = contact.trial.state(k);
                        let distance = laws.distance(state, state - error);
                        found.state.raise(distance, vertex, || state);
                        by_state = slopes[1][k - first] * error;
                    }
                    let velocity = at.velocity[vertex];
                    let deviation = if modulus(&velocity) > 0.0 {
                        self.deviation(contact, k, at, [slopes[0][k - first], by_state])
                    } else {
                        at_rest(k, &at.force_errors[vertex])
                    };
                    let distance = rate_distance(velocity, velocity - deviation, floor(k));
                    (found.slip_rate).raise(distance, vertex, || modulus(&velocity));
                }
            }
            found
        };
        in_shares(self.mobility.len(), &share, &LocalError::larger)
    }

    /// The change of the velocity of a vertex that slides with small changes of force, state and normal stress.
    ///
    /// Along the slip it is resisted by `eta + w sigma dmu/dV`; across it friction turns, like `friction/V`.
    #[inline]
    fn deviation(
        &self,
        contact: &DiscreteContact<C>,
        k: usize,
        at: &AtEnd<'_, C>,
        [by_rate, by_state]: [f64; 2],
    ) -> SVector<f64, C> {
        let vertex = contact.part.vertices[k];
        let (velocity, [normal, cohesive]) = (at.velocity[vertex], contact.forces[k]);
        let rate = modulus(&velocity);
        let direction = if C == 1 {
            velocity.map(f64::signum)
        } else {
            velocity / rate
        };
        let resistance = self.resistance[k];
        // What the forces leave to friction.
        let friction = (modulus(&at.forces[vertex]) - resistance * rate).max(0.0);
        let mut change = normal * by_state;
        if let Some(clamped) = at.clamped.get(vertex).filter(|_| normal > 0.0) {
            let coefficient = (friction - cohesive) / normal;
            change += contact.part.weights[k] * coefficient * clamped;
        }
        let force = at.force_errors[vertex] - direction * change;
        // 0 times an infinite slope resists nothing.
        let slope = if normal > 0.0 { normal * by_rate } else { 0.0 };
        if C == 1 {
            return force / (resistance + slope);
        }
        let along = direction * direction.dot(&force);
        along / (resistance + slope) + (force - along) / (resistance + friction / rate)
    }
}

/// `dmu/dV` and `dmu/dalpha` of a block of vertices.
fn slopes<const C: usize>(
    contact: &DiscreteContact<C>,
    velocity: &[SVector<f64, C>],
    block: Range<usize>,
) -> [[f64; LANES]; 2] {
    let (first, count) = (block.start, block.len());
    let [mut rates, mut states] = [[0.0; LANES]; 2];
    for (rate, k) in rates.iter_mut().zip(block) {
        *rate = modulus(&velocity[contact.part.vertices[k]]);
    }
    contact.trial.read_states(first, &mut states[..count]);
    let [mut by_rate, mut by_state] = [[0.0; LANES]; 2];
    let to = [&mut by_rate[..count], &mut by_state[..count]];
    let at = [&rates[..count], &states[..count]];
    contact.trial.laws().slopes(first, at, to);
    for (i, slope) in by_state[..count].iter_mut().enumerate() {
        // Friction of a state below the least one does not depend on it.
        if states[i] != contact.trial.state(first + i) {
            *slope = 0.0;
        }
    }
    [by_rate, by_state]
}
