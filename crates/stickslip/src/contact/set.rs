//! All contacts of a scene, and their frictional nodes.

use nalgebra::SVector;

use super::DiscreteContact;
use super::frictional_node::{Contribution, FrictionalNode};
use crate::scene::Clamping;
use crate::{ContactState, StepError};

/// The contacts of a scene in a simulation.
#[derive(Clone)]
pub(crate) struct ContactSet<const C: usize> {
    pub(crate) contacts: Vec<DiscreteContact<C>>,
    /// The frictional vertices with a free tangential component, or that can open, increasing.
    pub(crate) vertices: Vec<usize>,
    /// One node per frictional vertex.
    pub(crate) sites: Vec<FrictionalNode<C>>,
    pub(crate) shares: Vec<Contribution>,
    /// The nodes with a prescribed tangential component.
    pub(crate) moved: Vec<usize>,
    /// The normal stress that follows the displacement, if any.
    pub(crate) clamping: Option<Clamping<C>>,
}

impl<const C: usize> ContactSet<C> {
    /// Sets the normal stresses to those of a time, with the last change by a displacement.
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), StepError> {
        let change = self.clamping.as_ref().map_or(&[][..], |own| &own.values);
        let mut contacts = self.contacts.iter_mut();
        contacts.try_for_each(|contact| contact.set_time(time, change))
    }

    /// The friction at each frictional vertex that the normal stresses in trial miss \[N\].
    pub(crate) fn missing_forces(&self) -> impl Iterator<Item = f64> {
        (0..self.sites.len()).map(|k| {
            let shares = self.shares_of(k);
            let missing = |(contact, place): (&DiscreteContact<C>, usize)| {
                (contact.body.as_ref()).map_or(0.0, |body| body.missing[place])
            };
            shares.map(missing).sum()
        })
    }

    /// Sets the normal stresses in trial of the contacts where they come from the body, one after the other.
    pub(crate) fn try_normal_stresses(&mut self, mut values: &[f64]) {
        for body in self.contacts.iter_mut().filter_map(|own| own.body.as_mut()) {
            let (own, others) = values.split_at(body.trial.len());
            body.trial.copy_from_slice(own);
            values = others;
        }
    }

    /// Takes the reactions of the accepted rates as normal stresses, those of the contacts where they come from the body,
    /// one after the other.
    pub(crate) fn accept_reactions(&mut self, reactions: &[f64]) {
        self.try_normal_stresses(reactions);
        for contact in &mut self.contacts {
            contact.use_trial_stress();
        }
    }

    /// Extrapolates the normal stresses that come from the body from those of the last two steps, whose second is by
    /// `growth` shorter than the next one.
    pub(crate) fn extrapolate_normal_stresses(&mut self, from: &[ContactState<C>], growth: f64) {
        for (contact, from) in self.contacts.iter_mut().zip(from) {
            let Some(body) = &mut contact.body else {
                continue;
            };
            let stresses = from.normal_stress.iter().zip(&from.earlier_normal_stress);
            for (trial, (now, earlier)) in body.trial.iter_mut().zip(stresses) {
                *trial = now + growth * (now - earlier);
            }
        }
    }

    /// Refuses tension where it does not open the contact, beyond the rounding of forces at a vertex \[N\].
    pub(crate) fn check_tension(&self, rounding: impl Fn(usize) -> f64) -> Result<(), StepError> {
        let mut contacts = self.contacts.iter();
        contacts.try_for_each(|contact| contact.check_tension(&rounding))
    }

    /// Whether the normal stress of any contact comes from the body.
    pub(crate) fn follow_body(&self) -> bool {
        self.contacts.iter().any(|contact| contact.body.is_some())
    }

    /// Sets the normal stresses that come from the body to those of the start, by its displacement;
    /// `rounding` is that of the forces at a vertex \[N\].
    pub(crate) fn start_from_body(
        &mut self,
        unbalanced: impl Fn(usize) -> SVector<f64, C>,
        rounding: impl Fn(usize) -> f64,
    ) -> Result<(), StepError> {
        for contact in self.contacts.iter_mut().filter(|own| own.body.is_some()) {
            let forces: Vec<_> = contact
                .part
                .vertices
                .iter()
                .map(|&p| unbalanced(p))
                .collect();
            contact.start_from_body(&forces);
            contact.check_tension(&rounding)?;
        }
        Ok(())
    }

    /// Whether any contact has a state.
    pub(crate) fn have_state(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|contact| contact.trial.has_state())
    }

    /// Whether friction depends on the slip rate at every frictional vertex, at constant state.
    pub(crate) fn resist_rates(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.all(|contact| contact.reads_rate)
    }

    /// Copies the prescribed velocities of tangential components.
    pub(crate) fn prescribe(&mut self, fixed: &[[bool; C]], velocity: &[SVector<f64, C>]) {
        for &k in &self.moved {
            let (site, vertex) = (&mut self.sites[k], self.vertices[k]);
            let (slides, fixed, v) = (&site.slides, &fixed[vertex], &velocity[vertex]);
            site.prescribed =
                SVector::from_fn(|c, _| if slides[c] && fixed[c] { v[c] } else { 0.0 });
        }
    }
}
