//! The local error of many cells.

use std::cmp::Ordering;
use std::ops::Range;

use nalgebra::SVector;
use stickslip_friction::modulus;

use super::super::threads::in_shares;
use super::{Cells, ManyCells};
use crate::contact::DiscreteContact;
use crate::integrate::distance::rate_distance;
use crate::numerics::NUMERICS;
use crate::{LocalError, StepState};

impl<const C: usize> ManyCells<C> {
    /// The largest errors of slip rates and states in the last stage, from the errors of elastic forces, of states and of
    /// normal stresses (empty if none changes): those of the linearised balance of each cell.
    pub(in super::super) fn local_error(
        &self,
        (contacts, now): (&[DiscreteContact<C>], &StepState<C>),
        (forces, states, clamped): (&[SVector<f64, C>], &[f64], &[f64]),
        floor: f64,
    ) -> LocalError {
        let mut found = LocalError::default();
        let mut errors = states;
        for (n, (cells, contact)) in self.contacts.iter().zip(contacts).enumerate() {
            let (own, others) = errors.split_at(contact.part.vertices.len());
            errors = others;
            let states = &now.contacts[n].states;
            let share = |range: Range<usize>| {
                let mut found = LocalError::default();
                for k in range {
                    let vertex = contact.part.vertices[k];
                    found.state.raise(own[k].abs(), vertex, || states[k]);
                    let change = clamped.get(vertex).copied().unwrap_or(0.0);
                    let stress = forces[vertex] * cells.per_area[k];
                    let velocity = now.velocity[vertex];
                    let at = (velocity, contact.normal_stress[k]);
                    let errors = (stress, own[k], change);
                    if cells.exceeds(k, at, errors, [found.slip_rate.error, floor]) {
                        let deviation = cells.deviation(k, at, errors);
                        let distance = rate_distance(velocity, velocity - deviation, floor);
                        (found.slip_rate).raise(distance, vertex, || modulus(&velocity));
                    }
                }
                found
            };
            let of_contact = in_shares(own.len(), &share, &LocalError::larger);
            found = found.larger(of_contact);
        }
        found
    }
}

impl<const C: usize> Cells<C> {
    /// Whether the error of the slip rate of a cell may exceed another one: by a bound that takes neither `tanh`, of which
    /// `tanh(s) >= s/(1 + s)`, nor the direction of the error.
    #[inline]
    fn exceeds(
        &self,
        k: usize,
        (velocity, normal): (SVector<f64, C>, f64),
        (stress, state, clamped): (SVector<f64, C>, f64, f64),
        [error, floor]: [f64; 2],
    ) -> bool {
        let [a, b] = self.direct_and_evolving[k];
        let rate = modulus(&velocity);
        let friction = self.shear(k) - self.damping * rate;
        if !(error > 0.0 && rate > 0.0 && normal > 0.0 && friction > 0.0) {
            return true;
        }
        let mut change = stress.abs().sum() + normal * b * state.abs();
        if clamped != 0.0 {
            change += friction / normal * clamped.abs();
        }
        let direct = a * normal;
        let resistance = self.damping * rate + direct * friction / (friction + direct);
        let error = error * (1.0 - NUMERICS.rounding) * resistance * (rate + floor);
        // NaN exceeds all numbers.
        (rate * change)
            .partial_cmp(&error)
            .is_none_or(Ordering::is_gt)
    }

    /// The modulus of the shear stress of the last stage.
    fn shear(&self, k: usize) -> f64 {
        modulus(&SVector::<f64, C>::from_fn(|c, _| self.shear_stress[c][k]))
    }

    /// The change of the slip rate of a cell with small changes of shear stress, state and normal stress.
    ///
    /// With `s = mu/a`: `dmu/dV = a tanh(s)/V`, `dmu/dalpha = b tanh(s)`. Across the slip rate friction turns like `mu/V`.
    #[inline]
    fn deviation(
        &self,
        k: usize,
        (velocity, normal): (SVector<f64, C>, f64),
        (mut stress, state, clamped): (SVector<f64, C>, f64, f64),
    ) -> SVector<f64, C> {
        let rate = modulus(&velocity);
        if rate == 0.0 || normal == 0.0 {
            return if normal == 0.0 {
                stress / self.damping
            } else {
                SVector::zeros()
            };
        }
        let [a, b] = self.direct_and_evolving[k];
        let coefficient = (self.shear(k) - self.damping * rate) / normal;
        let tanh = (coefficient / a).tanh();
        let direction = velocity / rate;
        stress -= direction * (normal * b * tanh * state + coefficient * clamped);
        let along = direction * direction.dot(&stress);
        let resistance = |slope: f64| self.damping + normal * slope / rate;
        along / resistance(a * tanh) + (stress - along) / resistance(coefficient)
    }
}

#[cfg(test)]
#[path = "../../../../tests/unit/many_cells_error.rs"]
mod tests;
