//! Rate- and state-dependent friction in time: contacts, scenes, the coupling of rate and state, the time
//! loop, recorders. Re-exports the crates it stands on, and nalgebra.
//!
//! | noun | what it is |
//! | --- | --- |
//! | [`Contact`] | a part of the boundary on which the body slides: laws, state, normal stress |
//! | [`Scene`] | operators, contacts, boundary data, loads, a start |
//! | [`Simulation`] | a scene with a [`RateScheme`], a [`NonsmoothSolver`] and a [`Coupling`] |
//! | [`Steps`] | constant or adaptive steps, to an end, with stops |
//! | [`Snapshot`], [`AtContact`] | what is seen of a step |
//! | [`StepState`] | all that the next step depends on, to be kept and restored |
//! | [`Stepper`], [`RungeKutta`] | what goes through time; rate and state as a differential equation |
//! | [`PointHistories`], [`TraceWriter`], [`TraceMemory`] | recorders, fed from the run's observer: vertices in time, contacts in space and time |
//! | [`EventCatalogue`], [`EnergyLedger`] | what happened in each event, where energy went |
//! | [`History`], [`Events`], [`Statistics`] | one vertex in memory, when a threshold was passed, what steps cost |
//! | [`WorkPrecision`] | error against run time of any methods on a scene |
//!
//! | feature | default | what it adds |
//! | --- | --- | --- |
//! | `fem` | yes | meshes, P1 spaces and their operators |
//! | `tnnmg` | yes | the multigrid solver, and with it faer |
//! | `condensed` | yes | the direct solver on the frictional boundary, and with it faer |
//! | `vtk` | no | files of the body and its contacts for ParaView, and with it vtkio |
//! | `serde` | no | states and recorders by serde, checkpoint files (`Checkpoint`), and with it postcard |
//!
//! With all off a spring slider remains: a scene of one vertex, solved by [`Point`].

#[cfg(all(doctest, feature = "fem", feature = "tnnmg", feature = "condensed"))]
#[doc = include_str!("../../../README.md")]
struct Readme;

#[cfg(all(doctest, feature = "fem", feature = "tnnmg", feature = "condensed"))]
#[doc = include_str!("../../../docs/custom-laws.md")]
struct CustomLaws;

#[cfg(all(doctest, feature = "fem", feature = "tnnmg", feature = "condensed"))]
#[doc = include_str!("../../../docs/extend.md")]
struct Extend;

#[cfg(all(doctest, feature = "fem", feature = "tnnmg", feature = "condensed"))]
#[doc = include_str!("../../../docs/recipes.md")]
struct Recipes;

#[cfg(feature = "serde")]
mod checkpoint;
mod contact;
pub mod problems;
mod record;
mod run;
mod scene;
mod step;

#[cfg(feature = "serde")]
pub use checkpoint::{Checkpoint, CheckpointError, Difference};
pub use contact::{Contact, StateUpdate};
#[cfg(feature = "vtk")]
pub use record::VtkSeries;
pub use record::{
    Balance, EnergyLedger, Entry, Event, EventCatalogue, Events, History, Measurement,
    PointHistories, Quantity, RecordError, Sample, Statistics, Table, Total, TraceMemory,
    TraceWriter, Tracing, WorkPrecision, observed_order, seconds_to,
};
pub use run::{
    Ended, ErrorControl, ErrorOf, Limit, LocalError, Run, RunReport, RungeKutta, Stepper, Steps,
    Verdict, VertexError,
};
pub use scene::{Part, Role, Scene, SceneError};
pub use step::{
    AtContact, Clock, ContactState, ControlState, Convexity, Coupling, CouplingReport, Failure,
    FixedPoint, Monolithic, Residuals, Simulation, Snapshot, Staggered, StepError, StepMaps,
    StepReport, StepState,
};

pub use nalgebra;
#[cfg(feature = "fem")]
pub use stickslip_fem as fem;
// From there, so that it is one name under the globs of this crate and of `fem`.
#[cfg(feature = "fem")]
pub use stickslip_fem::BlockMatrix;
pub use stickslip_friction as friction;
pub use stickslip_state as state;
pub use stickslip_time as time;
pub use stickslip_tnnmg as tnnmg;

pub use stickslip_time::{
    BackwardEuler, CentralDifferences, GeneralizedAlpha, Newmark, QuasiStatic, RateScheme, Sdirk2,
};
#[cfg(any(feature = "tnnmg", feature = "condensed"))]
pub use stickslip_tnnmg::Cholesky;
#[cfg(feature = "fem")]
pub use stickslip_tnnmg::{BlockGaussSeidel, Diagonal};
#[cfg(feature = "condensed")]
pub use stickslip_tnnmg::{Condensed, DenseNewton};
pub use stickslip_tnnmg::{ConjugateGradients, LinearSolver, NonsmoothSolver, Operator, Point};
#[cfg(feature = "tnnmg")]
pub use stickslip_tnnmg::{LinearStep, MultigridSolver, Tnnmg};
