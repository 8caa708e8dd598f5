//! Regularised friction of many cells, several of them per instruction.

mod error;

use std::ops::Range;

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{CellState, QuasiDynamicFriction, modulus};

use super::threads::{in_shares, on_shares};
use crate::BoundaryPart;
use crate::contact::{ContactSet, DiscreteContact};
use crate::laws::regularized;
use crate::numerics::NUMERICS;

/// All contacts of a scene, if each is regularised friction of many cells with one radiation damping.
pub(super) struct ManyCells<const C: usize> {
    contacts: Vec<Cells<C>>,
}

/// The cells of a contact.
struct Cells<const C: usize> {
    /// The vertices of the body, if they follow one another.
    cells: Option<Range<usize>>,
    friction: QuasiDynamicFriction,
    /// `a` and `b` of each cell.
    direct_and_evolving: Vec<[f64; 2]>,
    /// `eta` [Pa s/m].
    damping: f64,
    /// The inverse areas [1/m^2].
    per_area: Vec<f64>,
    /// Shear stress \[Pa\] and slip rate [m/s], component by component.
    shear_stress: [Vec<f64>; C],
    slip_rate: [Vec<f64>; C],
}

impl<const C: usize> ManyCells<C> {
    /// The contacts of a scene without prescribed components, with the damping of its frictional vertices; none if any
    /// contact is another one, or any vertex of the body has no friction.
    pub(super) fn new(
        contacts: &ContactSet<C>,
        damping: &[SMatrix<f64, C, C>],
        size: usize,
    ) -> Option<Self> {
        let cells: usize = (contacts.contacts.iter())
            .map(|contact| contact.part.vertices.len())
            .sum();
        // Each cell is of one contact.
        if cells != contacts.vertices.len() || cells != size || size == 0 {
            return None;
        }
        let of_contact = |contact| Cells::new(contact, &contacts.vertices, damping);
        let contacts = contacts.contacts.iter().map(of_contact);
        let contacts: Option<_> = contacts.collect();
        contacts.map(|contacts| Self { contacts })
    }

    /// The number of cells of all contacts.
    pub(super) fn count(&self) -> usize {
        let counts = self
            .contacts
            .iter()
            .map(|cells| cells.direct_and_evolving.len());
        counts.sum()
    }

    /// Slip rates and rates of states in balance with the forces `drive`. The states of all contacts follow one another.
    /// An error is a vertex whose rates are not finite, with its slip rate, state and rate of the state.
    pub(super) fn rates(
        &mut self,
        contacts: &[DiscreteContact<C>],
        drive: &[SVector<f64, C>],
        states: &[f64],
        (velocity, state_rates): (&mut [SVector<f64, C>], &mut [f64]),
    ) -> Result<(), (usize, [f64; 3])> {
        let mut first = 0;
        for (cells, contact) in self.contacts.iter_mut().zip(contacts) {
            let range = first..first + contact.part.vertices.len();
            first = range.end;
            let state_rates = &mut state_rates[range.clone()];
            cells.rates(contact, drive, &states[range], (velocity, state_rates))?;
        }
        Ok(())
    }
}

impl<const C: usize> Cells<C> {
    fn new(
        contact: &DiscreteContact<C>,
        vertices: &[usize],
        damping: &[SMatrix<f64, C, C>],
    ) -> Option<Self> {
        let count = contact.part.vertices.len();
        let slides = contact.slides.iter().all(|slides| *slides == [true; C]);
        let coheres = (0..count).any(|k| contact.cohesion(k) != 0.0);
        if count < QuasiDynamicFriction::BLOCK || !slides || coheres {
            return None;
        }
        let (laws, evolution) = regularized(contact.trial.laws(), count)?;
        let per_area = |k: usize| {
            let at = vertices.binary_search(&contact.part.vertices[k]).ok()?;
            Some(damping[at] / contact.part.weights[k])
        };
        let eta = per_area(0)?[(0, 0)];
        let uniform = SMatrix::from_diagonal_element(eta);
        for k in 0..count {
            // NaN is not uniform either.
            let is_uniform = (per_area(k)? - uniform).amax() <= NUMERICS.rounding * eta;
            if !is_uniform {
                return None;
            }
        }
        // A cell without normal stress is balanced by itself.
        let least = f64::MIN_POSITIVE.sqrt();
        let variable = CellState::LogTheta;
        let friction = QuasiDynamicFriction::new(&laws, eta, variable, evolution, least).ok()?;
        let (first, last) = (
            contact.part.vertices.first()?,
            contact.part.vertices.last()?,
        );
        let follow = (contact.part.vertices.iter().enumerate()).all(|(k, &at)| at == first + k);
        Some(Self {
            cells: follow.then_some(*first..last + 1),
            friction,
            direct_and_evolving: laws.iter().map(|law| [law.a, law.b]).collect(),
            damping: eta,
            per_area: (contact.part.weights.iter())
                .map(|weight| weight.recip())
                .collect(),
            shear_stress: std::array::from_fn(|_| vec![0.0; count]),
            slip_rate: std::array::from_fn(|_| vec![0.0; count]),
        })
    }

    fn rates(
        &mut self,
        contact: &DiscreteContact<C>,
        drive: &[SVector<f64, C>],
        states: &[f64],
        (velocity, state_rates): (&mut [SVector<f64, C>], &mut [f64]),
    ) -> Result<(), (usize, [f64; 3])> {
        let part = &contact.part;
        self.set_shear_stress(part, drive);
        let stress = self.shear_stress.each_ref().map(Vec::as_slice);
        let slip_rate = self.slip_rate.each_mut().map(Vec::as_mut_slice);
        let normal = &contact.normal_stress;
        (self.friction).vector_rates(stress, normal, states, slip_rate, state_rates);
        self.copy_slip_rates(part, velocity);
        if self.are_finite(normal, state_rates) {
            return Ok(());
        }
        for (k, &vertex) in part.vertices.iter().enumerate() {
            let own = &mut velocity[vertex];
            if contact.normal_stress[k] == 0.0 || modulus(own) == 0.0 {
                // It is open, or rests: the limits of both laws.
                *own = SVector::from_fn(|c, _| self.shear_stress[c][k] / self.damping);
                if contact.normal_stress[k] > 0.0 {
                    own.fill(0.0);
                }
                let rate = modulus(own);
                state_rates[k] = contact.trial.laws().evolution(k, rate, states[k]);
            }
            let rate = modulus(own);
            if !(rate.is_finite() && state_rates[k].is_finite()) {
                return Err((vertex, [rate, states[k], state_rates[k]]));
            }
        }
        Ok(())
    }

    /// Shear stresses by the forces on the body's vertices.
    fn set_shear_stress(&mut self, part: &BoundaryPart, drive: &[SVector<f64, C>]) {
        let cells = &self.cells;
        for (c, stress) in self.shear_stress.iter_mut().enumerate() {
            on_shares(stress, &|first, stress| {
                let per_area = &self.per_area[first..];
                if let Some(cells) = cells {
                    let forces = drive[cells.start + first..].iter().zip(per_area);
                    for (stress, (force, per_area)) in stress.iter_mut().zip(forces) {
                        *stress = force[c] * per_area;
                    }
                } else {
                    let forces = part.vertices[first..].iter().zip(per_area);
                    for (stress, (&vertex, per_area)) in stress.iter_mut().zip(forces) {
                        *stress = drive[vertex][c] * per_area;
                    }
                }
            });
        }
    }

    /// Copies slip rates to the body's vertices.
    fn copy_slip_rates(&self, part: &BoundaryPart, velocity: &mut [SVector<f64, C>]) {
        let rates = self.slip_rate.each_ref().map(Vec::as_slice);
        if let Some(cells) = self.cells.clone() {
            on_shares(&mut velocity[cells], &|first, velocity| {
                let rates = rates.map(|rates| &rates[first..first + velocity.len()]);
                for (k, own) in velocity.iter_mut().enumerate() {
                    *own = SVector::from_fn(|c, _| rates[c][k]);
                }
            });
        } else {
            for (k, &vertex) in part.vertices.iter().enumerate() {
                velocity[vertex] = SVector::from_fn(|c, _| rates[c][k]);
            }
        }
    }

    /// Whether all cells slide under normal stress, at rates that are finite, those of states included. It has no branch
    /// per cell.
    fn are_finite(&self, normal_stress: &[f64], state_rates: &[f64]) -> bool {
        let share = |range: Range<usize>| {
            let mut all = true;
            for k in range {
                let rate: f64 = self.slip_rate.iter().map(|rate| rate[k].abs()).sum();
                all &= (normal_stress[k] > 0.0) & (rate > 0.0) & (rate <= f64::MAX);
                all &= state_rates[k].abs() <= f64::MAX;
            }
            all
        };
        in_shares(normal_stress.len(), &share, &|a, b| a & b)
    }
}
