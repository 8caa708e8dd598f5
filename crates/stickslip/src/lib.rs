//! Rate- and state-dependent friction in time: scenes, the coupling of rate and state, the time
//! loop, recorders. Re-exports the crates it stands on.
//!
//! | noun | what it is |
//! | --- | --- |
//! | [`Scene`] | operators, friction on a boundary part, state, boundary data, loads |
//! | [`Simulation`] | a scene with a [`RateScheme`], a [`NonsmoothSolver`] and a [`Coupling`] |
//! | [`Stepper`], [`Snapshot`] | a simulation without its types, and what it shows |
//! | [`Adaptive`], [`RungeKutta`] | steps by their local error; rate and state as a differential equation |
//! | [`WorkPrecision`] | error against run time of any methods on a scene |
//! | [`History`], [`Events`] | recorders: values that are fed from the loop's closure |
//!
//! | feature | default | what it adds |
//! | --- | --- | --- |
//! | `fem` | yes | meshes, P1 spaces and their operators |
//! | `tnnmg` | yes | the multigrid solver, and with it faer |
//! | `condensed` | yes | the direct solver on the frictional boundary, and with it faer |
//!
//! With all off a spring slider remains: a scene of one vertex, solved by [`Point`].

#[cfg(all(doctest, feature = "fem", feature = "tnnmg"))]
#[doc = include_str!("../../../README.md")]
struct Readme;

#[cfg(all(doctest, feature = "fem", feature = "tnnmg"))]
#[doc = include_str!("../../../docs/custom-laws.md")]
struct CustomLaws;

mod accepted;
mod adaptive;
mod build;
mod checks;
mod clock;
mod coupling;
mod error;
mod fixed_point;
mod highest_frequency;
mod interface;
mod local_error;
mod maps;
mod monolithic;
mod patch;
mod prediction;
pub mod problems;
mod recorder;
mod runge_kutta;
mod scene;
mod simulation;
mod staggered;
mod state_update;
mod stepper;
mod work_precision;

pub use adaptive::{Adaptive, AdaptiveReport};
pub use coupling::{Coupling, CouplingReport, StepMaps};
pub use error::{Failure, SceneError, StepError};
pub use fixed_point::FixedPoint;
pub use interface::{InterfaceLaw, InterfacePotential};
pub use local_error::ErrorControl;
pub use monolithic::Monolithic;
pub use patch::Patch;
pub use recorder::{Events, History, Sample};
pub use runge_kutta::RungeKutta;
pub use scene::Scene;
pub use simulation::Simulation;
pub use staggered::Staggered;
pub use state_update::StateUpdate;
pub use stepper::{Snapshot, StateField, StepReport, Stepper};
pub use work_precision::{Measurement, WorkPrecision, seconds_to};

#[cfg(feature = "fem")]
pub use stickslip_fem as fem;
pub use stickslip_friction as friction;
pub use stickslip_state as state;
pub use stickslip_time as time;
pub use stickslip_tnnmg as tnnmg;

pub use stickslip_time::{
    BackwardEuler, CentralDifferences, GeneralizedAlpha, Newmark, QuasiStatic, RateScheme, Sdirk2,
};
#[cfg(feature = "condensed")]
pub use stickslip_tnnmg::Condensed;
#[cfg(feature = "fem")]
pub use stickslip_tnnmg::{BlockGaussSeidel, BlockMatrix, Diagonal};
#[cfg(feature = "tnnmg")]
pub use stickslip_tnnmg::{LinearStep, Tnnmg};
pub use stickslip_tnnmg::{NonsmoothSolver, Operator, Point};
