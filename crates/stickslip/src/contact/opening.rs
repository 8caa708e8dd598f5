//! Contacts that can open: at their vertices the normal velocity is free, and bounded where the gap closes.

use nalgebra::SVector;
use stickslip_friction::{ConvexPotential, Unilateral};

use super::{ContactSet, DiscreteContact};
use crate::StepState;

/// The normal motion of a vertex that can open, in a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// The normal component.
    pub(crate) axis: usize,
    /// The outward normal along it, 1 or -1.
    pub(crate) outward: f64,
    /// The normal velocity at which the gap is closed at the end of the step [m/s].
    pub(crate) bound: f64,
    /// The force of the given normal stress, which is in balance with none of the body \[N\].
    pub(crate) pull: f64,
}

/// The vertices of a contact that can open.
#[derive(Debug, Clone)]
pub(crate) struct Opening {
    /// The normal component of each; none of one that cannot.
    pub(crate) released: Vec<Option<usize>>,
    /// The normal velocities at which their gaps are closed in the step [m/s].
    pub(crate) bounds: Vec<f64>,
}

impl Opening {
    /// A contact of so many vertices, of which none can open so far.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            released: vec![None; count],
            bounds: vec![0.0; count],
        }
    }
}

impl Gap {
    /// The potential of a vertex with this gap.
    pub(crate) fn with<P: ConvexPotential<C>, const C: usize>(
        &self,
        potential: P,
    ) -> Unilateral<P, C> {
        Unilateral {
            potential,
            axis: self.axis,
            outward: self.outward,
            bound: self.bound,
            pull: self.pull,
        }
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// The normal component of vertex number `k` and the outward normal along it, if it can open.
    pub(crate) fn opening_axis(&self, k: usize) -> Option<(usize, f64)> {
        let axis = self.opening.as_ref()?.released[k]?;
        Some((axis, self.outward[k][axis].signum()))
    }

    /// The normal distance of both sides at vertex number `k`, by the displacement there \[m\].
    pub(crate) fn gap(&self, k: usize, displacement: &SVector<f64, C>) -> f64 {
        self.opening_axis(k).map_or(0.0, |(axis, outward)| {
            // No negative zero.
            0.0 - outward * displacement[axis]
        })
    }

    /// Whether vertex number `k` is open at this velocity in a step: its normal stress is then 0.
    pub(crate) fn is_open(&self, k: usize, velocity: &SVector<f64, C>) -> bool {
        let bound = self.opening.as_ref().map(|opening| opening.bounds[k]);
        (self.opening_axis(k).zip(bound))
            .is_some_and(|((axis, outward), bound)| outward * velocity[axis] < bound)
    }

    /// Adds the normal tractions of vertices that can open, less those that the body balances without a reaction.
    pub(crate) fn add_reactions(&self, normal_stress: &[f64], load: &mut [SVector<f64, C>]) {
        let Some(body) = &self.body else {
            return;
        };
        for (k, &vertex) in self.part.vertices.iter().enumerate() {
            if let Some((axis, outward)) = self.opening_axis(k) {
                let reaction = normal_stress[k] - body.beside[k];
                load[vertex][axis] -= outward * self.part.weights[k] * reaction;
            }
        }
    }
}

impl<const C: usize> ContactSet<C> {
    /// The gap of frictional vertex number `k`, if it can open.
    pub(crate) fn gap_of(&self, k: usize) -> Option<Gap> {
        let mut shares = self.shares_of(k);
        let (contact, place) = shares.next()?;
        let (axis, outward) = contact.opening_axis(place)?;
        Some(Gap {
            axis,
            outward,
            bound: 0.0,
            pull: 0.0,
        })
    }

    /// Whether any vertex can open.
    pub(crate) fn can_open(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|contact| contact.opening.is_some())
    }

    /// Marks the normal component of frictional vertex number `k`, if it can open.
    pub(crate) fn mark_normal(&self, k: usize, mask: &mut [bool; C]) {
        if let Some(gap) = &self.sites[k].gap {
            mask[gap.axis] = true;
        }
    }

    /// Whether frictional vertex number `k` can open, and touches the opposite side at rest.
    pub(crate) fn rests_closed(&self, k: usize, state: &StepState<C>) -> bool {
        let vertex = self.vertices[k];
        (self.sites[k].gap.as_ref()).is_some_and(|gap| {
            gap.outward * state.displacement[vertex][gap.axis] >= 0.0
                && state.velocity[vertex][gap.axis] == 0.0
        })
    }

    /// Adds the reactions of vertices that can open, with the normal stresses in force.
    pub(crate) fn add_reactions(&self, load: &mut [SVector<f64, C>]) {
        for contact in &self.contacts {
            contact.add_reactions(&contact.normal_stress, load);
        }
    }
}
