//! The boundary conditions and retained vertices of a reduction.

use stickslip_solvers::{Basis, BlockMatrix, Matrix, MeshId};

use crate::placement::{Connected, Parts, place_normals};
use crate::scene::{AnyContact, Prescribed, Source};
use crate::{BoundaryCondition, BoundaryPart, Scene, SceneError};

/// The boundary conditions of a scene in its reduction.
pub(super) struct Support<const C: usize> {
    pub(super) basis: Basis<C>,
    /// The Dirichlet components of the body.
    pub(super) fixed: Vec<[bool; C]>,
    /// The driven ones among them.
    pub(super) moved: Vec<[bool; C]>,
    /// The components along which contacts bear a reaction that is their normal stress: coordinates at rest, whose rows
    /// of the operators are the reactions.
    pub(super) reacting: Vec<[bool; C]>,
    /// The retained vertices, increasing: those of contacts, and others on request.
    pub(super) boundary: Vec<usize>,
    /// The driven parts, in the local frames of their vertices.
    pub(super) parts: Vec<Prescribed<C>>,
}

impl<const C: usize> Support<C> {
    pub(super) fn new(
        scene: &Scene<BlockMatrix<C>, C>,
        kept: &[usize],
    ) -> Result<Self, SceneError> {
        let size = scene.stiffness.rows();
        if scene.conditions.contacts.is_empty() && kept.is_empty() {
            return Err(SceneError::unsupported(
                SceneError::REDUCTION,
                "a contact, or vertices that are kept",
            ));
        }
        for (position, &vertex) in kept.iter().enumerate() {
            if vertex >= size {
                return Err(SceneError::Value {
                    what: "kept vertex",
                    requirement: "one of the body",
                    position,
                    value: vertex as f64,
                });
            }
        }
        if (scene.conditions.contacts.iter()).any(|own| !reacts_as_whole(scene, own)) {
            return Err(SceneError::unsupported(
                SceneError::REDUCTION,
                "contacts under a normal stress from the body that start in equilibrium, and with inertia stay closed",
            ));
        }
        let (mut contacts, mut prescribed) = (
            scene.conditions.contacts.clone(),
            scene.conditions.prescribed.clone(),
        );
        let stiffness = |i| scene.stiffness.diagonal_block(i).trace();
        let parts = Parts {
            contacts: &mut contacts,
            prescribed: &mut prescribed,
            periodic: &scene.conditions.periodic,
        };
        let Connected {
            axes,
            basis,
            mut constraints,
        } = Connected::new(parts, size, false, stiffness)?;
        // A jump that is prescribed, or one with its unknown on the minus side, has no place in a reduced body.
        if constraints.prescribes_jumps() || basis.links.iter().any(|link| link.reversed) {
            return Err(SceneError::unsupported(
                SceneError::REDUCTION,
                "Dirichlet conditions beside the faults between two sides",
            ));
        }
        let is_image = |vertex: &&usize| {
            matches!(
                constraints.role(**vertex, 0),
                Some(BoundaryCondition::Periodic(_))
            )
        };
        if let Some(&vertex) = kept.iter().find(is_image) {
            return Err(SceneError::Vertex {
                what: "kept place",
                vertex,
                requirement: "on the first side of a periodic boundary",
            });
        }
        let parts = (contacts.iter()).map(|contact| (&contact.part, contact.bilateral));
        let slides = place_normals(parts, &axes, &mut constraints)?;
        let reacting = reacting(&contacts, &slides);
        let of_contacts = contacts.iter().flat_map(|contact| &contact.part.vertices);
        let mut boundary: Vec<usize> = of_contacts.chain(kept).copied().collect();
        boundary.sort_unstable();
        boundary.dedup();
        let moved = (0..size)
            .map(|vertex| std::array::from_fn(|c| constraints.is_moved(vertex, c)))
            .collect();
        Ok(Self {
            basis,
            fixed: constraints.fixed,
            moved,
            reacting,
            boundary,
            parts: constraints.moved,
        })
    }

    /// The fixed components for the condensation of the interior; driven components of the boundary are unknowns, and so
    /// are those with reactions.
    pub(super) fn eliminated(&self) -> Vec<[bool; C]> {
        let mut fixed = self.fixed.clone();
        for &vertex in &self.boundary {
            for c in 0..C {
                fixed[vertex][c] &= !(self.moved[vertex][c] || self.reacting[vertex][c]);
            }
        }
        fixed
    }

    /// The place of a vertex on the boundary.
    pub(super) fn place(&self, vertex: usize) -> Option<usize> {
        self.boundary.binary_search(&vertex).ok()
    }

    /// The vertices of a part on the boundary, by their places; none if it has none there.
    pub(super) fn restrict(&self, part: &BoundaryPart, mesh: MeshId) -> Option<BoundaryPart> {
        let kept: Vec<usize> = (0..part.vertices.len())
            .filter(|&k| self.place(part.vertices[k]).is_some())
            .collect();
        if kept.is_empty() {
            return None;
        }
        let mut part = part.select(&kept);
        part.vertices = (part.vertices.iter())
            .filter_map(|&vertex| self.place(vertex))
            .collect();
        // Jumps are coordinates: of the other side the tips beside it remain.
        if let Some(side) = &mut part.opposite {
            side.vertices.clone_from(&part.vertices);
        }
        part.mesh = Some(mesh);
        Some(part)
    }

    /// Whether another scene has the same fixed and driven parts, on a boundary that contains its contacts.
    pub(super) fn suits(&self, other: &Self) -> bool {
        let alike = |one: &Prescribed<C>, other: &Prescribed<C>| {
            one.part.vertices == other.part.vertices
                && one.components == other.components
                && one.turned == other.turned
        };
        self.basis == other.basis
            && self.fixed == other.fixed
            && self.moved == other.moved
            && self.reacts_like(&other.reacting)
            && self.parts.len() == other.parts.len()
            && self
                .parts
                .iter()
                .zip(&other.parts)
                .all(|(one, other)| alike(one, other))
            && other
                .boundary
                .iter()
                .all(|&vertex| self.place(vertex).is_some())
    }

    /// Whether the reactions of a scene are among those of the body.
    fn reacts_like(&self, reacting: &[[bool; C]]) -> bool {
        let mut both = self.reacting.iter().zip(reacting);
        both.all(|(own, other)| (0..C).all(|c| own[c] || !other[c]))
    }
}

/// Whether the reactions of a contact are those of the whole body: at the start the interior balances none but those in
/// equilibrium.
fn reacts_as_whole<const C: usize>(
    scene: &Scene<BlockMatrix<C>, C>,
    contact: &AnyContact<C>,
) -> bool {
    let (start, strength) = (&scene.conditions.initial, &contact.strength);
    let unloaded = start.displacement.is_empty() && scene.conditions.loads.is_empty();
    let balanced = scene.equilibrium.is_some() || unloaded;
    let has_inertia = scene.mass.is_some();
    let of_start = has_inertia || strength.source == Source::Change || strength.relaxation.delays();
    let closed = !(has_inertia && strength.opens);
    strength.source == Source::Given || closed && (balanced || !of_start)
}

/// The components along which the normal stresses of contacts come from the body.
fn reacting<const C: usize>(contacts: &[AnyContact<C>], slides: &[[bool; C]]) -> Vec<[bool; C]> {
    let mut reacting = vec![[false; C]; slides.len()];
    let from_body = contacts
        .iter()
        .filter(|own| own.strength.source != Source::Given);
    for &vertex in from_body.flat_map(|contact| &contact.part.vertices) {
        reacting[vertex] = slides[vertex].map(|slides| !slides);
    }
    reacting
}
