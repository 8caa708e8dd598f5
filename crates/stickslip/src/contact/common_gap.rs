//! Which vertices can open, and the one gap of contacts that meet at a vertex.

use super::frictional_node::Contribution;
use super::{ContactSet, DiscreteContact};
use crate::StepState;

impl<const C: usize> DiscreteContact<C> {
    /// Whether its sides can part.
    pub(crate) fn can_open(&self) -> bool {
        self.body.is_some() && self.strength.opens
    }
}

impl<const C: usize> ContactSet<C> {
    /// Makes the bounds of a step those of all contacts that meet at a vertex, with the sum of their given forces.
    pub(crate) fn join_gaps(&mut self) {
        for site in &mut self.sites {
            let shares = &self.shares[site.shares.clone()];
            let Some(gap) = &mut site.gap else {
                continue;
            };
            gap.pull = 0.0;
            for share in shares {
                let contact = &mut self.contacts[share.contact as usize];
                let place = share.place as usize;
                let given = contact.body.as_ref().map_or(0.0, |body| body.beside[place]);
                gap.pull += contact.part.weights[place] * given;
                if let Some(opening) = &mut contact.opening {
                    opening.bounds[place] = gap.bound;
                }
            }
        }
    }

    /// Distributes the pressure where contacts meet that can open: those of which one would bear a tension beside the
    /// pressure of another bear their sum together. The normal stresses are those of the contacts where they come from
    /// the body, one after the other.
    pub(crate) fn share_pressure(&self, stresses: &mut [f64]) {
        for site in self.sites.iter().filter(|site| site.gap.is_some()) {
            let shares = &self.shares[site.shares.clone()];
            if shares.len() < 2 {
                continue;
            }
            let (mut sum, mut pressed) = (0.0, 0.0);
            for &share in shares {
                let (stress, area) = (stresses[self.place_of(share)], self.area_of(share));
                sum += area * stress;
                pressed += area * stress.max(0.0);
            }
            // Bits of a sum without tension are its own.
            let part = if sum == pressed {
                1.0
            } else {
                sum.max(0.0) / pressed
            };
            for &share in shares {
                let stress = &mut stresses[self.place_of(share)];
                *stress = if *stress > 0.0 { part * *stress } else { 0.0 };
            }
        }
    }

    fn area_of(&self, share: Contribution) -> f64 {
        self.contacts[share.contact as usize].part.weights[share.place as usize]
    }

    /// The place of a share among the normal stresses that come from the body.
    fn place_of(&self, share: Contribution) -> usize {
        let before = self.contacts[..share.contact as usize].iter();
        let before = before.filter_map(|contact| contact.body.as_ref());
        before.map(|body| body.trial.len()).sum::<usize>() + share.place as usize
    }

    /// Closes the gaps that an extrapolation has left negative.
    pub(crate) fn end_penetration(&self, end: &mut StepState<C>) {
        for (site, &vertex) in self.sites.iter().zip(&self.vertices) {
            let Some(gap) = &site.gap else {
                continue;
            };
            if gap.outward * end.displacement[vertex][gap.axis] > 0.0 {
                end.displacement[vertex][gap.axis] = 0.0;
                end.velocity[vertex][gap.axis] = 0.0;
            }
        }
    }
}
