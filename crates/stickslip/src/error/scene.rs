//! Errors in the construction of a scene.

use stickslip_friction::FrictionViolation;
use stickslip_solvers::{MOST_LEVELS, MatrixDefect, MeshMismatch, SolveError};
use stickslip_state::{Number, StateLawViolation};
use stickslip_time::TimeError;
use thiserror::Error;

use super::scene_hint as hint;
use crate::{BoundaryCondition, OpenWalls, ShearAlongNormal, StepError};

/// An error of a scene, found before the first step.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The friction law has a parameter out of its range, or violates its contract; see
    /// [`Contact::unchecked`](crate::Contact::unchecked).
    #[error("friction law: {0}")]
    Friction(#[from] FrictionViolation),
    /// The state law has a parameter out of its range, or violates its contract; see
    /// [`Contact::unchecked`](crate::Contact::unchecked).
    #[error("state law: {0}")]
    State(#[from] StateLawViolation),
    /// The time discretisation has a parameter out of its range.
    #[error("time discretisation: {0}")]
    Time(#[from] TimeError),
    /// The solver does not support the operator, or found no static equilibrium.
    #[error("static equilibrium: {0}")]
    Equilibrium(#[from] SolveError),
    /// The data of the first time are invalid.
    #[error("at the start: {0}")]
    Start(#[from] StepError),
    /// A mesh, space or form cannot be built.
    #[cfg(feature = "fem")]
    #[error("finite elements: {0}")]
    Fem(#[from] stickslip_fem::FemError),
    /// A planar fault by boundary integrals cannot be built.
    #[cfg(feature = "bie")]
    #[error("fault: {0}")]
    Kernel(#[from] stickslip_bie::KernelError),
    /// The length of a field, matrix or list differs from that of the stiffness matrix or the boundary part.
    #[error("{what}: {expected} entries expected, {found} found")]
    Length {
        /// The name of the quantity.
        what: &'static str,
        /// The required length.
        expected: usize,
        /// The given length.
        found: usize,
    },
    /// A value is infinite, NaN or out of its range.
    #[error("{what} must be {requirement}, is {} at position {position}", Number(*.value))]
    Value {
        /// The name of the quantity.
        what: &'static str,
        /// The condition on the value.
        requirement: &'static str,
        /// The position of the value in its list.
        position: usize,
        /// The value.
        value: f64,
    },
    /// A vertex or contact does not exist.
    #[error("no {what} {index}: there are {count}, counted from 0")]
    Index {
        /// The kind of object.
        what: &'static str,
        /// The requested number.
        index: usize,
        /// The number of existing objects.
        count: usize,
    },
    /// A point of a recorder lies outside of the contact, or in a cell that the contact does not have.
    #[error(
        "the point {point:?} m does not lie in a cell of the contact, which extends from end to end over {ends:?} m"
    )]
    OutsideContact {
        /// The coordinates of the point \[m\]: one on a line, two on a plane.
        point: Vec<f64>,
        /// Both ends of the contact along each coordinate \[m\].
        ends: Vec<[f64; 2]>,
    },
    /// The vertices of a boundary part differ from those of the contact.
    #[error(
        "the trace has vertex {found} where contact {contact} has {expected}: {}",
        hint::SAME_PART
    )]
    OtherVertices {
        /// The contact, counted from 0.
        contact: usize,
        /// A vertex of the contact.
        expected: usize,
        /// The vertex in its place.
        found: usize,
    },
    /// Two vertices of contacts coincide. The mesh is open there, cut along a fault or not merged, and both walls would
    /// slide independently on a rigid surface.
    #[error(
        "vertices {} and {} of contacts both lie at {at:?}: the mesh is open there, and each \
         wall would slide on a rigid surface of its own; {}",
        .vertices[0], .vertices[1], hint::ONE_WALL
    )]
    Coincident {
        /// The vertices.
        vertices: [usize; 2],
        /// The position of the second one \[m\].
        at: [f64; 3],
    },
    /// The mesh was split along a surface whose walls have no contact between them.
    #[error(transparent)]
    OpenWalls(#[from] OpenWalls),
    /// The initial shear stress of a contact is not tangential, which friction cannot balance.
    #[error(transparent)]
    ShearAlongNormal(#[from] ShearAlongNormal),
    /// A boundary part has no vertices.
    #[error("{what}: the boundary part has no vertex")]
    EmptyBoundary {
        /// The boundary condition of the part.
        what: &'static str,
    },
    /// A matrix, boundary part, solver or reduced body belongs to another mesh or body, possibly of equal size.
    #[error(transparent)]
    Mesh(#[from] MeshMismatch),
    /// A matrix does not define an operator on fields.
    #[error("the {what} {defect}")]
    Matrix {
        /// The name of the matrix.
        what: &'static str,
        /// The defect of the matrix.
        defect: MatrixDefect,
    },
    /// A matrix is not symmetric: `x . A y` differs from `y . A x` for two fields x and y with components up to 1/2.
    #[error(
        "the {what} is not symmetric, and implicit steps minimise an energy: products that should agree are {products:?}; {}",
        hint::EXPLICIT
    )]
    NotSymmetric {
        /// The name of the matrix.
        what: &'static str,
        /// The two products.
        products: [f64; 2],
    },
    /// A quantity that does not add was given twice.
    #[error("{what} given twice")]
    Repeated {
        /// The name of the quantity.
        what: &'static str,
    },
    /// The conditions of two boundary parts contradict each other in one component.
    #[error("component {component} of vertex {vertex}: {second} contradicts {first}")]
    Contradiction {
        /// The vertex.
        vertex: usize,
        /// The component.
        component: usize,
        /// The part that came first.
        first: BoundaryCondition,
        /// The contradicting part.
        second: BoundaryCondition,
    },
    /// The initial slip rate of a scene without inertia is not in balance with the shear stress.
    #[error(
        "the start at vertex {vertex}: a slip rate of {} m/s needs {} Pa of shear stress more than there is; {}",
        Number(*.slip_rate), Number(*.missing), hint::BALANCED
    )]
    Unbalanced {
        /// The vertex.
        vertex: usize,
        /// The given slip rate there [m/s].
        slip_rate: f64,
        /// The missing shear stress, negative for an excess \[Pa\].
        missing: f64,
    },
    /// A contact has no normal at a vertex, as at a corner, or one that cannot be free or fixed along with the velocity
    /// prescribed there.
    #[error(
        "contact: the normal {normal:?} at vertex {vertex} must be {requirement}: {}",
        hint::NORMALS
    )]
    Normal {
        /// The vertex.
        vertex: usize,
        /// The normal, zero if there is none.
        normal: [f64; 3],
        /// The condition on the normal: "one to slide along", or "one that can be free" for a contact with a free
        /// normal.
        requirement: &'static str,
    },
    /// A contact lies at cells that do not act in every step.
    #[error(
        "vertex {vertex} of contact {contact} has cells of level {level} of local steps: name the vertices of contacts among the \
         finest ones"
    )]
    LocalSteps {
        /// The contact, counted from 0.
        contact: usize,
        /// The vertex.
        vertex: usize,
        /// The highest level of its cells.
        level: usize,
    },
    /// A stiffness or a viscosity has no level of local steps, or more than [`MOST_LEVELS`].
    #[error("the {what} has {levels} levels of local steps: from 1 to {MOST_LEVELS} are possible")]
    Levels {
        /// The name of the operator.
        what: &'static str,
        /// The number of its levels.
        levels: usize,
    },
    /// An operator format has no local axes, or no jumps: [`Operator::change_basis`](crate::Operator::change_basis).
    #[error("the format of the {what} has no local axes and jumps: {}", hint::AXES)]
    NoBasis {
        /// The name of the operator.
        what: &'static str,
    },
    /// A vertex of the plus side of a contact has no partner on the minus side.
    #[error(
        "vertex {vertex} of the plus side, at {at:?} m, has no partner: {}",
        hint::SIDES
    )]
    NotPaired {
        /// The vertex.
        vertex: usize,
        /// Its position \[m\]; NaN if unknown.
        at: [f64; 3],
    },
    /// Two parts are not the sides of a periodic boundary.
    #[error(
        "periodic boundary: vertex {vertex} at {at:?} m needs {requirement} at a translation of {translation:?} m; {}",
        hint::ALIKE
    )]
    NotPeriodic {
        /// The vertex, of the second side.
        vertex: usize,
        /// Its position \[m\].
        at: [f64; 3],
        /// The translation from the first to the second side \[m\].
        translation: [f64; 3],
        /// The condition on the first side.
        requirement: &'static str,
    },
    /// A vertex does not satisfy a condition: of a junction, where faults meet, or of the viscosity in explicit
    /// integration, which is block diagonal and resists each motion that friction does not.
    #[error("the {what} at vertex {vertex} must be {requirement}")]
    Vertex {
        /// The quantity or place: "viscosity" or "junction of faults".
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// The condition.
        requirement: &'static str,
    },
    /// A Dirichlet condition prescribes a component of one side of a fault that the other side leaves free.
    #[error(
        "component {component} of vertex {vertex} is prescribed on one side alone: {}",
        hint::BOTH
    )]
    HalfHeld {
        /// The vertex.
        vertex: usize,
        /// The component, in the local axes of the vertex.
        component: usize,
    },
    /// A method does not support the scene: implicit steps, explicit ones, or the reduction of the body.
    #[error("{by} needs {requirement}")]
    Unsupported {
        /// The method, such as [`IMPLICIT`](Self::IMPLICIT), or the option of the scene.
        by: &'static str,
        /// The condition on the scene.
        requirement: &'static str,
    },
    /// A solver for matrices of another format than those of the scene.
    #[error("`{solver}` solves for matrices `{matrices}`; those of the scene are `{body}`")]
    Format {
        /// The type of the solver.
        solver: &'static str,
        /// The format of its matrices.
        matrices: &'static str,
        /// The format of the scene's matrices.
        body: &'static str,
    },
    /// The first mode lies above the frequency limit.
    #[cfg(feature = "condensed")]
    #[error(
        "the first mode is at {} Hz, above the {} Hz up to which modes are kept: {}",
        Number(*.first), Number(*.frequency), hint::FREQUENCY
    )]
    BelowModes {
        /// The frequency limit \[Hz\].
        frequency: f64,
        /// The frequency of the first mode \[Hz\].
        first: f64,
    },
    /// Static responses and retained modes do not represent an initial field.
    #[cfg(feature = "condensed")]
    #[error(
        "{what}: the modes that are kept lose {share:.1e} of its energy; {}",
        hint::MORE_MODES
    )]
    ReducedStart {
        /// The name of the field.
        what: &'static str,
        /// The lost share of its energy.
        share: f64,
    },
    /// An initial displacement violates a component that is fixed, bilateral or driven as one with others.
    #[cfg(feature = "condensed")]
    #[error(
        "initial displacement: component {component} of vertex {vertex} is {} m away from where the reduced body fixes it, or from the part it moves with: {}",
        Number(*.value), hint::WHOLE_PART
    )]
    HeldApart {
        /// The vertex.
        vertex: usize,
        /// The component, along the axes of the vertex.
        component: usize,
        /// The distance from the reduced body's displacement \[m\].
        value: f64,
    },
}
