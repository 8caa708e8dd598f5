//! Contacts that can open: at their vertices the normal velocity is free, and bounded where the gap closes.

use nalgebra::SVector;

use super::gap::Gap;
use super::{ContactSet, DiscreteContact};
use crate::StepState;

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
            let body = contact.body.iter().map(|body| &body.unrelaxed);
            let delayed = body.into_iter().find(|stress| !stress.is_empty());
            contact.add_reactions(delayed.unwrap_or(&contact.normal_stress), load);
        }
    }
}
