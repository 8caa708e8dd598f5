//! Contacts on a body: their nodes, what they hold of it, and what opens together.

use nalgebra::SVector;

use super::axes::Axes;
use super::constraints::Constraints;
use crate::contact::{ContactSet, Contribution, DiscreteContact, FrictionalNode, Opening};
use crate::scene::{AnyContact, components_of};
use crate::{BoundaryCondition, BoundaryPart, SceneError};

/// Places contacts on a body, and fixes the normal velocity of the bilateral ones at zero.
pub(crate) fn place<const C: usize>(
    contacts: Vec<AnyContact<C>>,
    axes: &Axes<C>,
    constraints: &mut Constraints<C>,
) -> Result<ContactSet<C>, SceneError> {
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
    let mut set = ContactSet {
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
/// Frees the normal components that nothing but contacts that can open keeps at zero: a vertex opens in all contacts that
/// meet there, along one normal, or in none.
fn release<const C: usize>(
    contacts: &mut [DiscreteContact<C>],
    meeting: &[Vec<Contribution>],
    axes: &Axes<C>,
    constraints: &mut Constraints<C>,
) {
    let mut any = false;
    for contact in contacts.iter_mut().filter(|contact| contact.can_open()) {
        contact.opening = Some(Opening::new(contact.part.vertices.len()));
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
                if let Some(opening) = &mut contacts[share.contact as usize].opening {
                    opening.released[share.place as usize] = Some(axis);
                }
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

/// Finds the areas that bear reactions: contacts that meet with one normal share the reaction there by their areas. What
/// is beside the tip of one of them is so in all.
fn share_reactions<const C: usize>(
    contacts: &mut [DiscreteContact<C>],
    meeting: &[Vec<Contribution>],
    axes: &Axes<C>,
) {
    let at = |share: Contribution| (share.contact as usize, share.place as usize);
    // Contacts that meet on a smooth surface share the bits of their normal.
    let normal = |share: Contribution| {
        let (contact, place) = at(share);
        axes.normals[contact][place]
    };
    for shares in meeting {
        for &own in shares {
            let alike = |&&other: &&Contribution| {
                contacts[at(other).0].bilateral && normal(other) == normal(own)
            };
            let area = |&other: &Contribution| {
                let (contact, place) = at(other);
                contacts[contact].part.weights[place]
            };
            let bearing = shares.iter().filter(alike).map(area).sum();
            let beside = |&other: &Contribution| {
                let (contact, place) = at(other);
                let side = contacts[contact].part.opposite.as_ref();
                side.is_some_and(|side| side.beside_tip[place])
            };
            let beside_tip = shares.iter().filter(alike).any(beside);
            let (contact, place) = at(own);
            if contacts[contact].body.is_some() {
                let own = &mut contacts[contact];
                if let Some(side) = &mut own.part.opposite {
                    side.beside_tip[place] = beside_tip;
                }
                own.bearing.resize(own.part.vertices.len(), 0.0);
                own.bearing[place] = bearing;
            }
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
