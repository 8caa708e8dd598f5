//! A reduced body: its operators, scenes on it, and the way back to all vertices.

use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{BlockMatrix, ConjugateGradients, MeshId, Symmetric};

use super::loads::{spread, to_coordinates};
use super::marks::marks;
use super::projector::Projector;
use super::support::Support;
use crate::placement::{Parts, connect};
use crate::scene::{AnyContact, Conditions, Prescribed, Sides, check_reducible, common_mesh};
use crate::{BoundaryPart, MeshMismatch, Scene, SceneError};

/// A driven part outside the boundary.
pub(super) struct Handle<const C: usize> {
    pub(super) components: [bool; C],
    /// The unit displacements of its vertices, one list per driven component.
    pub(super) units: Vec<Vec<(usize, SVector<f64, C>)>>,
}

/// A body after the Craig-Bampton reduction by [`Reduced`](crate::reduced::Reduced). It serves any number of scenes
/// that differ in laws, normal stress, loads or initial conditions; the expensive computations are done once.
///
/// Its vertices are those of the contacts and the retained ones, in the order of the body's, then one for each driven
/// part, then modes, as many per vertex as it has components. Parts, vertices and fields of the full body do not apply
/// to the reduced one; [`part`](ReducedBody::part) and [`vertex`](ReducedBody::vertex) convert them.
#[doc(alias = "Craig-Bampton")]
pub struct ReducedBody<const C: usize> {
    /// The identity of the reduced body in its parts.
    pub(super) mesh: MeshId,
    /// The fingerprint of the operators.
    pub(super) marks: u64,
    /// The mesh of the whole body, if it is known.
    pub(super) origin: Option<MeshId>,
    pub(super) support: Arc<Support<C>>,
    pub(super) projector: Arc<Projector<C>>,
    /// The mass matrix of the body.
    pub(super) inertia: Option<BlockMatrix<C>>,
    /// The vertex of each driven part, and the part itself, if it is outside the boundary.
    pub(super) handles: Vec<(Option<usize>, Option<Handle<C>>)>,
    /// The frequency of the first omitted mode, if there is one \[Hz\].
    pub(super) next: Option<f64>,
    pub(super) stiffness: Symmetric<C>,
    pub(super) mass: Option<Symmetric<C>>,
    pub(super) viscosity: Option<Symmetric<C>>,
    /// The components that are coordinates.
    pub(super) moves: Vec<[bool; C]>,
}

impl<const C: usize> fmt::Debug for ReducedBody<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("ReducedBody")
            .field("coordinates", &self.projector.size())
            .field("modes", &self.projector.squares.len())
            .finish_non_exhaustive()
    }
}

impl<const C: usize> ReducedBody<C> {
    /// The frequencies of the retained modes, lowest first \[Hz\].
    pub fn frequencies(&self) -> impl Iterator<Item = f64> + '_ {
        (self.projector.squares.iter()).map(|square| square.sqrt() / TAU)
    }

    /// The reduced vertex of a vertex of the body, if it is retained.
    pub fn vertex(&self, vertex: usize) -> Option<usize> {
        self.support.place(vertex)
    }

    /// A part of the body on the reduced one: its retained vertices.
    ///
    /// # Errors
    /// [`SceneError::EmptyBoundary`] if there is none, [`SceneError::Mesh`] for a part of another body.
    pub fn part(&self, part: impl Into<BoundaryPart>) -> Result<BoundaryPart, SceneError> {
        let (what, part) = ("part of a reduced body", part.into());
        MeshMismatch::check(what, self.origin, part.mesh)?;
        (self.support.restrict(&part, self.mesh)).ok_or(SceneError::EmptyBoundary { what })
    }

    /// Transfers a scene to this body: the contacts, fixed and driven parts, loads and initial conditions of `scene`,
    /// which has the body's operators. The initial conditions must be in equilibrium, or a motion that the retained
    /// modes represent.
    /// Time-dependent loads are projected at each evaluation, by a substitution in the whole body.
    ///
    /// # Errors
    /// [`SceneError`]: a scene of another body ([`SceneError::Mesh`]) or with parts of one, initial conditions that the
    /// modes do not represent ([`SceneError::ReducedStart`], [`SceneError::HeldApart`]).
    pub fn reduce(
        &self,
        mut scene: Scene<BlockMatrix<C>, C>,
    ) -> Result<Scene<Symmetric<C>, C>, SceneError> {
        check_reducible(&scene.conditions)?;
        scene.check()?;
        scene.conditions.check_walls()?;
        scene.conditions.mesh = scene.conditions.mesh.or(self.origin);
        MeshMismatch::check(
            "scene to reduce",
            self.origin,
            common_mesh(&scene.conditions)?,
        )?;
        let (expected, found) = (self.support.fixed.len(), scene.stiffness.rows());
        if found != expected {
            return Err(SceneError::Length {
                what: "stiffness matrix",
                expected,
                found,
            });
        }
        if marks(&scene) != self.marks {
            return Err(SceneError::unsupported(
                SceneError::REDUCTION,
                "the matrices of the reduced body, which another material changes",
            ));
        }
        let support = Support::new(&scene, &self.support.boundary)?;
        if !self.support.suits(&support) {
            return Err(SceneError::unsupported(
                SceneError::REDUCTION,
                "the fixed, prescribed and frictional vertices of the reduced body",
            ));
        }
        let initial = self.start(&scene, &support)?;
        let in_equilibrium = scene.equilibrium.is_some();
        let Conditions {
            loads,
            mut contacts,
            mut prescribed,
            periodic,
            open_walls,
            ..
        } = scene.conditions;
        // Their jumps are coordinates of the body; where faults meet, shares of surfaces move.
        let parts = Parts {
            contacts: &mut contacts,
            prescribed: &mut prescribed,
            periodic: &periodic,
        };
        connect(parts, expected, false, |_| 0.0)?;
        let contacts = contacts.into_iter().map(|contact| {
            let AnyContact {
                part,
                laws,
                strength,
                bilateral,
                ..
            } = contact;
            Ok(AnyContact {
                part: self.part(part)?,
                laws,
                strength,
                bilateral,
                sides: Sides::Rigid,
            })
        });
        let mut reduced = Scene::new(self.stiffness.clone());
        reduced.mass.clone_from(&self.mass);
        reduced.viscosity.extend(self.viscosity.clone());
        if in_equilibrium {
            reduced.equilibrium = Some(Box::new(ConjugateGradients::default()));
        }
        reduced.conditions = Conditions {
            contacts: contacts.collect::<Result<_, SceneError>>()?,
            prescribed: self.prescribed(prescribed),
            loads: self.loads(loads)?,
            initial,
            mesh: Some(self.mesh),
            turned: true,
            open_walls,
            ..reduced.conditions
        };
        Ok(reduced)
    }

    /// Fixed and driven parts, and conditions for components that are not coordinates.
    fn prescribed(&self, given: Vec<Prescribed<C>>) -> Vec<Prescribed<C>> {
        let mut reduced = Vec::new();
        let mut handles = self.handles.iter();
        let part_of = |vertices: Vec<usize>| BoundaryPart {
            weights: vec![1.0; vertices.len()],
            vertices,
            points: Vec::new(),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 0,
            mesh: Some(self.mesh),
        };
        for given in given {
            let handle = given.velocity.as_ref().and_then(|_| handles.next());
            if let Some((Some(vertex), _)) = handle {
                reduced.push(Prescribed {
                    part: part_of(vec![*vertex]),
                    turned: Vec::new(),
                    ..given.clone()
                });
            }
            if let Some(part) = self.support.restrict(&given.part, self.mesh) {
                reduced.push(Prescribed {
                    part,
                    turned: Vec::new(),
                    ..given
                });
            }
        }
        let behind = self.support.boundary.len()..self.moves.len();
        for vertex in behind {
            let components = self.moves[vertex].map(|moves| !moves);
            if components.contains(&true) {
                reduced.push(Prescribed {
                    part: part_of(vec![vertex]),
                    minus: None,
                    components,
                    velocity: None,
                    turned: Vec::new(),
                });
            }
        }
        reduced
    }

    /// Coordinates as a field of the reduced body, on the boundary along the coordinate axes.
    pub(super) fn field(&self, coordinates: &[f64]) -> Vec<SVector<f64, C>> {
        let mut field = vec![SVector::zeros(); self.moves.len()];
        spread(&self.moves, coordinates, &mut field);
        to_coordinates(&self.support, &mut field);
        field
    }

    /// The coordinates of a field of the reduced body.
    pub(super) fn coordinates(&self, field: &[SVector<f64, C>]) -> Result<Vec<f64>, SceneError> {
        if field.len() != self.moves.len() {
            return Err(SceneError::Length {
                what: "displacement",
                expected: self.moves.len(),
                found: field.len(),
            });
        }
        let mut coordinates = Vec::with_capacity(self.projector.size());
        for (vertex, value) in field.iter().enumerate() {
            let value = match self.support.boundary.get(vertex) {
                Some(&of_body) => self.support.basis.axes.to_frame(of_body, *value),
                None => *value,
            };
            let components = (0..C).filter(|&c| self.moves[vertex][c]);
            coordinates.extend(components.map(|c| value[c]));
        }
        Ok(coordinates)
    }
}
