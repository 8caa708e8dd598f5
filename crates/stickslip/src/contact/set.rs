//! All contacts of a scene, and their frictional nodes.

use nalgebra::SVector;

use super::common_gap::release;
use super::frictional_node::{Contribution, FrictionalNode};
use super::from_body::share_reactions;
use super::{AnyContact, DiscreteContact};
use crate::scene::{Axes, BoundaryCondition, Clamping, Constraints, components_of};
use crate::{BoundaryPart, ContactState, SceneError, StepError};

/// The contacts of a scene in a simulation.
#[derive(Clone)]
pub(crate) struct ContactSet<const C: usize> {
    pub(crate) contacts: Vec<DiscreteContact<C>>,
    /// The frictional vertices with a free tangential component, or that can open, increasing.
    pub(crate) vertices: Vec<usize>,
    /// One node per frictional vertex.
    pub(super) sites: Vec<FrictionalNode<C>>,
    pub(super) shares: Vec<Contribution>,
    /// The nodes with a prescribed tangential component.
    moved: Vec<usize>,
    /// The normal stress that follows the displacement, if any.
    pub(super) clamping: Option<Clamping<C>>,
}

impl<const C: usize> ContactSet<C> {
    /// Places contacts on a body, and fixes the normal velocity of the bilateral ones at zero.
    pub(crate) fn new(
        contacts: Vec<AnyContact<C>>,
        axes: &Axes<C>,
        constraints: &mut Constraints<C>,
    ) -> Result<Self, SceneError> {
        let size = constraints.fixed.len();
        let mut contacts = contacts
            .into_iter()
            .zip(&axes.normals)
            .map(|(contact, normals)| DiscreteContact::new(contact, &axes.frames, normals))
            .collect::<Result<Vec<_>, _>>()?;
        let parts = (contacts.iter()).map(|contact| (&contact.part, contact.bilateral));
        let slides = place_normals(parts, axes, constraints)?;
        let mut meeting: Vec<Vec<Contribution>> = vec![Vec::new(); size];
        for (index, contact) in contacts.iter_mut().enumerate() {
            for (place, &vertex) in contact.part.vertices.iter().enumerate() {
                contact.slides[place] = slides[vertex];
                meeting[vertex].push(Contribution {
                    contact: index as u32,
                    place: place as u32,
                });
            }
        }
        share_reactions(&mut contacts, &meeting, axes);
        release(&mut contacts, &meeting, axes, constraints);
        let mut set = Self {
            contacts,
            vertices: Vec::new(),
            sites: Vec::new(),
            shares: Vec::new(),
            moved: Vec::new(),
            clamping: None,
        };
        for (vertex, shares) in meeting.into_iter().enumerate() {
            let (slides, fixed) = (&slides[vertex], &constraints.fixed[vertex]);
            let slips = (0..C).any(|c| slides[c] && !fixed[c]);
            let opens = |&Contribution { contact, place }: &Contribution| {
                let contact = &set.contacts[contact as usize];
                contact.opening_axis(place as usize).is_some()
            };
            if shares.is_empty() || !slips && !shares.iter().any(opens) {
                continue;
            }
            let is_moved = (0..C).any(|c| constraints.is_moved(vertex, c));
            if is_moved {
                set.moved.push(set.sites.len());
            }
            let begin = set.shares.len();
            set.shares.extend(shares);
            set.vertices.push(vertex);
            set.sites.push(FrictionalNode {
                shares: begin..set.shares.len(),
                slides: *slides,
                plain: !is_moved && (0..C).all(|c| slides[c] || fixed[c]),
                prescribed: SVector::zeros(),
                gap: None,
            });
        }
        for k in 0..set.sites.len() {
            set.sites[k].gap = set.gap_of(k);
        }
        Ok(set)
    }

    /// Sets the normal stresses to those of a time, with the last change by a displacement.
    pub(super) fn set_time(&mut self, time: f64) -> Result<(), StepError> {
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

/// Fixes the normal components of bilateral contacts, given as parts; returns the tangential components of each vertex.
pub(crate) fn place_normals<'a, const C: usize>(
    parts: impl Iterator<Item = (&'a BoundaryPart, bool)>,
    axes: &Axes<C>,
    constraints: &mut Constraints<C>,
) -> Result<Vec<[bool; C]>, SceneError> {
    let size = constraints.fixed.len();
    let mut slides = vec![[true; C]; size];
    let mut free_normals = vec![[None; C]; size];
    for (index, (part, bilateral)) in parts.enumerate() {
        for (k, &vertex) in part.vertices.iter().enumerate() {
            let Some(normal) = axes.normals[index][k] else {
                if !bilateral {
                    return Err(SceneError::Normal {
                        vertex,
                        normal: [0.0; 3],
                        requirement: "one that can be free",
                    });
                }
                continue;
            };
            let along = components_of(&axes.frames.to_frame(vertex, normal));
            let several = along.iter().filter(|&&along| along).count() > 1;
            for axis in (0..C).filter(|&axis| along[axis]) {
                // Of what is prescribed along several axes none is that of the contact.
                if several && (!bilateral || constraints.is_moved(vertex, axis)) {
                    return Err(SceneError::Normal {
                        vertex,
                        normal: part.normals[k],
                        requirement: "one to slide along",
                    });
                }
                slides[vertex][axis] = false;
                if bilateral {
                    constraints.close(vertex, axis, index);
                } else {
                    free_normals[vertex][axis] = Some(index);
                }
            }
        }
    }
    for (vertex, normals) in free_normals.iter().enumerate() {
        for (component, free) in normals.iter().enumerate() {
            // A part may hold or move what a contact leaves free; another contact may not close it.
            if let (Some(index), Some(first @ BoundaryCondition::Contact(_))) =
                (free, constraints.role(vertex, component))
            {
                return Err(SceneError::Contradiction {
                    vertex,
                    component,
                    first,
                    second: BoundaryCondition::Contact(index + 1),
                });
            }
        }
    }
    Ok(slides)
}
