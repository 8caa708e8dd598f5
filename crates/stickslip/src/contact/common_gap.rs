//! Which vertices can open, and the one gap of contacts that meet at a vertex.

use super::ContactSet;
use super::DiscreteContact;
use super::frictional_node::Contribution;
use crate::StepState;
use crate::scene::{Axes, BoundaryCondition, Constraints, components_of};

/// Frees the normal components that nothing but contacts that can open keeps at zero: a vertex opens in all contacts that
/// meet there, along one normal, or in none.
pub(super) fn release<const C: usize>(
    contacts: &mut [DiscreteContact<C>],
    meeting: &[Vec<Contribution>],
    axes: &Axes<C>,
    constraints: &mut Constraints<C>,
) {
    let mut any = false;
    for contact in contacts.iter_mut().filter(|contact| contact.can_open()) {
        let count = contact.part.vertices.len();
        contact.released = vec![None; count];
        contact.bounds = vec![0.0; count];
        any = true;
    }
    for (vertex, shares) in meeting.iter().enumerate().filter(|_| any) {
        let Some(axis) = common_axis(contacts, shares, axes) else {
            continue;
        };
        let kept = |c: usize| {
            matches!(
                constraints.role(vertex, c),
                Some(BoundaryCondition::Contact(_))
            )
        };
        // A copy that moves as others is kept along its surface, too.
        if (0..C).all(|c| kept(c) == (c == axis)) {
            constraints.release(vertex, axis);
            for share in shares {
                contacts[share.contact as usize].released[share.place as usize] = Some(axis);
            }
        }
    }
}

/// The component along which all of these contacts can open.
fn common_axis<const C: usize>(
    contacts: &[DiscreteContact<C>],
    shares: &[Contribution],
    axes: &Axes<C>,
) -> Option<usize> {
    let at = |share: &Contribution| (share.contact as usize, share.place as usize);
    let (first, place) = at(shares.first()?);
    let normal = axes.normals[first][place]?;
    let alike = shares.iter().map(at).all(|(contact, place)| {
        contacts[contact].can_open() && axes.normals[contact][place] == Some(normal)
    });
    let along = components_of(contacts[first].outward.get(place).filter(|_| alike)?);
    let mut along = (0..C).filter(|&c| along[c]);
    along.next().filter(|_| along.next().is_none())
}

impl<const C: usize> DiscreteContact<C> {
    /// Whether its sides can part.
    fn can_open(&self) -> bool {
        self.body.is_some() && self.strength.opens
    }
}

impl<const C: usize> ContactSet<C> {
    /// Makes the bounds of a step those of all contacts that meet at a vertex, with the sum of their given forces.
    pub(super) fn join_gaps(&mut self) {
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
                contact.bounds[place] = gap.bound;
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
