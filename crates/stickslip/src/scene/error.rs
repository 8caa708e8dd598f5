//! What can go wrong when a scene is built.

use stickslip_friction::{FrictionError, FrictionViolation};
use stickslip_solvers::{MatrixDefect, MeshMismatch, SolveError};
use stickslip_state::{StateError, StateLawViolation};
use stickslip_time::TimeError;
use thiserror::Error;

use crate::{BoundaryCondition, StepError};

/// A scene that cannot be run; found before the first step.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The friction law has a parameter out of its range, or breaks its contract; see
    /// [`Contact::unchecked`](crate::Contact::unchecked).
    #[error("friction law: {0}")]
    Friction(#[from] FrictionViolation),
    /// The state law has a parameter out of its range, or breaks its contract; see
    /// [`Contact::unchecked`](crate::Contact::unchecked).
    #[error("state law: {0}")]
    State(#[from] StateLawViolation),
    /// The time discretisation has a parameter out of its range.
    #[error("time discretisation: {0}")]
    Time(#[from] TimeError),
    /// The solver cannot work with the operator, or found no static equilibrium.
    #[error("static equilibrium: {0}")]
    Equilibrium(#[from] SolveError),
    /// Data of the first time cannot be used.
    #[error("at the start: {0}")]
    Start(#[from] StepError),
    /// A mesh, space or form cannot be built.
    #[cfg(feature = "fem")]
    #[error("finite elements: {0}")]
    Fem(#[from] stickslip_fem::FemError),
    /// A fault without a mesh cannot be built.
    #[cfg(feature = "bie")]
    #[error("fault: {0}")]
    Kernel(#[from] stickslip_bie::KernelError),
    /// A field, matrix or list that does not fit the stiffness matrix or the boundary part.
    #[error("{what}: {expected} entries expected, {found} found")]
    Length {
        /// What was given.
        what: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// A value that is not a finite number, or out of its range.
    #[error("{what} must be {requirement}, is {value:e} at position {position}")]
    Value {
        /// What was given.
        what: &'static str,
        /// What holds for a legal value.
        requirement: &'static str,
        /// Where in its list it stands.
        position: usize,
        /// The value.
        value: f64,
    },
    /// A vertex or contact that there is not.
    #[error("no {what} {index}: there are {count}, counted from 0")]
    Index {
        /// What it is.
        what: &'static str,
        /// The number asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A part of the boundary with other vertices than the contact.
    #[error(
        "the trace has vertex {found} where contact {contact} has {expected}: give the part that it was made of"
    )]
    OtherVertices {
        /// The contact, counted from 0.
        contact: usize,
        /// A vertex of the contact.
        expected: usize,
        /// The vertex in its place.
        found: usize,
    },
    /// Two vertices of contacts at one place: the mesh is open there, cut along a fault or not merged, and both walls would
    /// slide on a rigid surface, each by itself.
    #[error(
        "vertices {} and {} of contacts both lie at {at:?}: the mesh is open there (Mesh::nonconforming_nodes), and each \
         wall would slide on a rigid surface of its own; merge them or take one wall, or allow it by Scene::with_open_walls",
        .vertices[0], .vertices[1]
    )]
    Coincident {
        /// The vertices.
        vertices: [usize; 2],
        /// Where the second one lies \[m\].
        at: [f64; 3],
    },
    /// A boundary part without vertices.
    #[error("{what}: the boundary part has no vertex")]
    EmptyBoundary {
        /// The part's role.
        what: &'static str,
    },
    /// A matrix, boundary part, solver or reduced body that belongs to another mesh or body, maybe one of equal size.
    #[error(transparent)]
    Mesh(#[from] MeshMismatch),
    /// A matrix that is no operator on fields.
    #[error("the {what} {defect}")]
    Matrix {
        /// Which it is.
        what: &'static str,
        /// Why not.
        defect: MatrixDefect,
    },
    /// A matrix that is not symmetric: `x . A y` is not `y . A x` for two fields x and y with components up to 1/2.
    #[error("the {what} is not symmetric: products that should agree are {products:?}")]
    NotSymmetric {
        /// Which it is.
        what: &'static str,
        /// The two products.
        products: [f64; 2],
    },
    /// Something that cannot be added was given a second time.
    #[error("{what} given twice")]
    Repeated {
        /// What it is.
        what: &'static str,
    },
    /// Two boundary parts say different things of one component.
    #[error("component {component} of vertex {vertex}: {second} contradicts {first}")]
    Contradiction {
        /// The vertex.
        vertex: usize,
        /// The component.
        component: usize,
        /// The part that came first.
        first: BoundaryCondition,
        /// The part that contradicts it.
        second: BoundaryCondition,
    },
    /// A start without inertia whose slip rate needs another shear stress than there is.
    #[error(
        "the start at vertex {vertex}: a slip rate of {slip_rate:e} m/s needs {missing:e} Pa of shear stress more than there \
         is; change rate, state or stress, or use `Scene::with_balanced_rates`"
    )]
    Unbalanced {
        /// The vertex.
        vertex: usize,
        /// Its slip rate as given [m/s].
        slip_rate: f64,
        /// The missing shear stress, negative where there is too much \[Pa\].
        missing: f64,
    },
    /// A contact without a normal at a vertex, as at a corner, or with one that cannot be free or closed beside the motion
    /// prescribed there.
    #[error(
        "contact: the normal {normal:?} at vertex {vertex} must be {requirement}: make the surfaces that meet there \
         contacts of their own, or give normals by BoundaryPart::with_normals"
    )]
    Normal {
        /// The vertex.
        vertex: usize,
        /// The normal, zero if there is none.
        normal: [f64; 3],
        /// What it has to be: "one to slide along", or "one that can be free" of a contact with a free normal.
        requirement: &'static str,
    },
    /// An operator of a format that cannot be turned to normals along no axis, see
    /// [`Operator::turn`](crate::Operator::turn).
    #[error(
        "the format of the {what} has no rotated frames: align contacts and boundary parts with the axes, or use a BlockMatrix"
    )]
    NoFrames {
        /// The operator.
        what: &'static str,
    },
    /// A scene that an explicit scheme or integration cannot take.
    #[error("explicit integration needs {requirement}")]
    Explicit {
        /// What is missing, or must be.
        requirement: &'static str,
    },
    /// A vertex whose motion nothing resists, in a scene that is a differential equation for its displacement.
    #[error(
        "neither friction nor viscosity resists the motion of vertex {vertex}: explicit integration needs a viscosity there"
    )]
    Undamped {
        /// The vertex.
        vertex: usize,
    },
    /// A viscosity by which a vertex feels the velocities of others, in a scene that is a differential equation vertex by
    /// vertex.
    #[error(
        "the viscosity couples vertex {vertex} to others: explicit integration needs one that is block diagonal"
    )]
    CoupledDamping {
        /// The vertex.
        vertex: usize,
    },
    /// A state of another scene.
    #[error("the state belongs to another scene: {what} of {found}, not {expected}")]
    Foreign {
        /// What does not fit.
        what: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// A scene whose body cannot be reduced.
    #[cfg(feature = "condensed")]
    #[error("Craig-Bampton reduction needs {requirement}")]
    Unreducible {
        /// What is missing.
        requirement: &'static str,
    },
    /// No mode has a frequency as low as that up to which they are to be kept.
    #[cfg(feature = "condensed")]
    #[error(
        "the first mode is at {first:e} Hz, above the {frequency:e} Hz up to which modes are kept: raise that frequency"
    )]
    BelowModes {
        /// The frequency asked for \[Hz\].
        frequency: f64,
        /// That of the first mode \[Hz\].
        first: f64,
    },
    /// A start that static responses and the modes which are kept cannot follow.
    #[cfg(feature = "condensed")]
    #[error("{what}: the modes that are kept lose {share:.1e} of its energy; keep more of them")]
    ReducedStart {
        /// What was given.
        what: &'static str,
        /// The share of its energy that is lost.
        share: f64,
    },
    /// A start in which a component that is held, closed or moved as one with others is displaced beside them.
    #[cfg(feature = "condensed")]
    #[error(
        "initial displacement: component {component} of vertex {vertex} is {value:e} m away from where the reduced body fixes it, or from the part it moves with: displace the whole part, or keep the vertex"
    )]
    HeldApart {
        /// The vertex.
        vertex: usize,
        /// The component, along the axes of the vertex.
        component: usize,
        /// How far it is away \[m\].
        value: f64,
    },
}

impl SceneError {
    /// The index of a vertex or contact, if it is in range.
    pub(crate) fn check_index(
        what: &'static str,
        index: usize,
        count: usize,
    ) -> Result<usize, Self> {
        if index < count {
            return Ok(index);
        }
        Err(Self::Index { what, index, count })
    }
}

impl From<FrictionError> for SceneError {
    fn from(error: FrictionError) -> Self {
        Self::Friction(error.into())
    }
}

impl From<StateError> for SceneError {
    fn from(error: StateError) -> Self {
        Self::State(error.into())
    }
}
