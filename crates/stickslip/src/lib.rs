//! Rate- and state-dependent friction in time: contacts, scenes, the coupling of rate and state, the time
//! loop, recorders.
//!
//! ```
//! use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
//! use stickslip::{Newmark, Point, Simulation, Steps};
//!
//! // A block on a spring, pulled from 1 um/s on: steady until its load point moves ten times faster, at 10 s.
//! let load = LoadPath::steady(1e-6).then(10.0, 1e-5);
//! let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 1e3, damping: 0.0, load };
//! let scene = slider.steady(FRICTION, AGING, 1e-6)?;
//! let mut block = Simulation::new(scene, Newmark::default(), Point)?;
//! let mut largest = 0.0_f64;
//! block.run(&Steps::adaptive(1e-4).stopping_at([10.0]).until(100.0), |at| {
//!     largest = largest.max(at.contact(0).coefficient(0));
//! })?;
//! // A peak first, by the direct effect; then the steady coefficient of the new rate.
//! let [before, after] = [1e-6, 1e-5].map(|rate| FRICTION.steady_coefficient(rate));
//! assert!(largest > before + 0.005 && after < before);
//! assert!((block.snapshot().contact(0).coefficient(0) - after).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `docs/scenes.md` builds a body with a mesh step by step, `docs/theory.md` says what is solved. The crates below and
//! nalgebra are re-exported.
//!
//! | noun | what it is |
//! | --- | --- |
//! | [`Contact`] | a part of the boundary on which the body slides: laws, state, normal stress |
//! | [`Scene`] | operators, contacts, boundary data, loads, a start |
//! | [`Simulation`] | a scene with a [`RateScheme`], a [`NonsmoothSolver`] and a [`Coupling`] |
//! | [`Steps`] | constant or adaptive steps, to an end, with stops |
//! | [`Snapshot`], [`AtContact`] | what is seen of a step |
//! | [`StepState`] | all that the next step depends on, to be kept and restored |
//! | [`Convexity`] | whether a step has a single solution, before it is taken |
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
//! | `kernel` | no | faults in half and whole spaces by their kernel, without a mesh (`stickslip::kernel`), and with it realfft |
//! | `vtk` | no | files of the body and its contacts for ParaView, and with it vtkio |
//! | `gmsh` | no | meshes of Gmsh with the names of their groups |
//! | `csv` | no | samples of parameters from tables, and with it csv |
//! | `serde` | no | states and recorders by serde, checkpoint files (`Checkpoint`), and with it postcard |
//!
//! With all off a spring slider remains: a scene of one vertex, solved by [`Point`].

// Programs in the documents are compiled here; `examples/tests/documents.rs` sees to it that none is forgotten.
#[cfg(all(doctest, feature = "fem", feature = "tnnmg", feature = "condensed"))]
mod documents {
    #[doc = include_str!("../../../README.md")]
    struct Readme;

    #[doc = include_str!("../../../CONTRIBUTING.md")]
    struct Contributing;

    #[doc = include_str!("../../../docs/choosing.md")]
    struct Choosing;

    #[doc = include_str!("../../../docs/custom-laws.md")]
    struct CustomLaws;

    #[doc = include_str!("../../../docs/extend.md")]
    struct Extend;

    #[doc = include_str!("../../../docs/leave-out.md")]
    struct LeaveOut;

    #[doc = include_str!("../../../docs/recipes.md")]
    struct Recipes;

    #[doc = include_str!("../../../docs/theory.md")]
    struct Theory;
}

#[cfg(feature = "serde")]
mod checkpoint;
mod contact;
#[cfg(feature = "serde")]
mod file;
mod file_error;
pub mod problems;
mod record;
#[cfg(feature = "condensed")]
mod reduced;
mod run;
mod scene;
mod step;

#[cfg(feature = "serde")]
pub use checkpoint::Checkpoint;
pub use contact::{Contact, StateUpdate};
pub use file_error::FileError;
#[cfg(feature = "vtk")]
pub use record::VtkSeries;
pub use record::{
    Balance, EnergyLedger, Entry, Event, EventCatalogue, Events, History, Measurement,
    PointHistories, Quantity, Sample, Statistics, Table, Total, TraceMemory, TraceWriter, Tracing,
    WorkPrecision, observed_order, seconds_to,
};
#[cfg(feature = "condensed")]
pub use reduced::{Reduced, ReducedBody};
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
#[cfg(feature = "kernel")]
pub use stickslip_kernel as kernel;
pub use stickslip_state as state;
pub use stickslip_time as time;
pub use stickslip_tnnmg as tnnmg;

pub use stickslip_time::{
    BackwardEuler, CentralDifferences, GeneralizedAlpha, Newmark, QuasiStatic, RateScheme, Sdirk2,
};
#[cfg(any(feature = "tnnmg", feature = "condensed"))]
pub use stickslip_tnnmg::Cholesky;
#[cfg(feature = "fem")]
pub use stickslip_tnnmg::{BlockGaussSeidel, Diagonal, MassMatrix};
#[cfg(feature = "condensed")]
pub use stickslip_tnnmg::{Condensed, DenseNewton, Symmetric};
pub use stickslip_tnnmg::{
    ConjugateGradients, IntoOperator, LinearSolver, MeshMismatch, NonsmoothSolver, Operator, Point,
};
#[cfg(feature = "tnnmg")]
pub use stickslip_tnnmg::{LinearStep, MultigridSolver, Tnnmg, Transfers};
