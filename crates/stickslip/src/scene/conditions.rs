//! A scene beside its matrices.

use stickslip_solvers::{MeshId, Walls};

use super::{AnyContact, Clamping, Initial, Load, Prescribed};
use crate::{BoundaryPart, SceneError};

/// Contacts, loads, boundary and initial conditions of a scene: all but its matrices.
#[derive(Clone)]
pub(crate) struct Conditions<const C: usize> {
    pub(crate) loads: Vec<Load<C>>,
    pub(crate) contacts: Vec<AnyContact<C>>,
    pub(crate) prescribed: Vec<Prescribed<C>>,
    /// The two sides of each periodic boundary.
    pub(crate) periodic: Vec<[BoundaryPart; 2]>,
    pub(crate) initial: Initial<C>,
    /// The normal stress that follows the displacement, if any.
    pub(crate) clamping: Option<Clamping<C>>,
    /// The body's mesh, if it is known.
    pub(crate) mesh: Option<MeshId>,
    /// The meshes on which matrices were assembled.
    pub(crate) assembled: Vec<(&'static str, MeshId)>,
    /// The walls of the surfaces along which the mesh was split.
    pub(crate) walls: Vec<Walls>,
    /// Walls of an open mesh without a contact between them are allowed.
    pub(crate) open_walls: bool,
    /// The operators are already in the local frames of their vertices.
    pub(crate) turned: bool,
    /// The first error: a matrix that is not an operator, or a repeated quantity that does not add.
    pub(crate) wrong: Option<SceneError>,
    /// The error of a stiffness matrix that is not symmetric.
    pub(crate) asymmetric: Option<SceneError>,
}

impl<const C: usize> Default for Conditions<C> {
    fn default() -> Self {
        Self {
            loads: Vec::new(),
            contacts: Vec::new(),
            prescribed: Vec::new(),
            periodic: Vec::new(),
            initial: Initial::default(),
            clamping: None,
            mesh: None,
            assembled: Vec::new(),
            walls: Vec::new(),
            open_walls: false,
            turned: false,
            wrong: None,
            asymmetric: None,
        }
    }
}
