//! Simulates stick-slip of elastic bodies under rate-and-state friction: scenes, contacts, implicit time stepping with
//! adaptive steps, and recorders.
//!
//! ```
//! use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
//! use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
//!
//! // A block on a spring, pulled from 1 um/s on: steady until its load point moves ten times faster, at 10 s.
//! let load = LoadPath::steady(1e-6).then(10.0, 1e-5);
//! let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 1e3, damping: 0.0, load };
//! let scene = slider.steady(FRICTION, AGING, 1e-6)?;
//! let mut block = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
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
//! `docs/scenes.md` builds a body with a mesh step by step, `docs/theory.md` has the equations, `docs/choosing.md`
//! compares the methods. The crates below and nalgebra are re-exported.
//!
//! | item | |
//! | --- | --- |
//! | [`Contact`] | a part of the boundary on which the body slides: laws, state, normal stress |
//! | [`Scene`] | operators, contacts, boundary data, loads, initial conditions |
//! | [`Simulation`] | a scene with a [`RateScheme`], a [`NonsmoothSolver`] and a [`Coupling`] |
//! | [`Steps`], [`ErrorControl`] | constant steps, split where they fail, or adaptive ones, to an end, with stops |
//! | [`GeneralizedAlpha`], [`FirstOrderAlpha`] | the default scheme, with and without inertia |
//! | [`Snapshot`], [`ContactView`] | views of a step and of a contact |
//! | [`StepState`] | everything that the next step depends on, to be stored and restored |
//! | [`StepError`] | the cause of a failed step; [`NotUnique`](StepError::NotUnique): no certified unique solution |
//! | [`Convexity`] | a sufficient condition for the uniqueness of a step, before it is taken |
//! | [`integrate::Stepper`], [`RungeKutta`] | time steppers; an explicit Runge-Kutta method for rate and state |
//! | [`record`] | recorders, fed from the run's observer: histories of nodes, traces of contacts, event catalogues, energy balance |
//! | [`integrate`] | time steppers, reports and states of steps |
//! | [`lab`] | fits of laboratory experiments: velocity steps, holds, slide-hold-slide |
//! | [`work_precision`] | error against run time of several methods on one scene |
//!
//! | feature | default | content |
//! | --- | --- | --- |
//! | `fem` | yes | meshes, P1 spaces and their operators, and with it sprs |
//! | `tnnmg` | yes | the multigrid solver, and with it faer |
//! | `condensed` | yes | the direct solver on the frictional boundary, and with it faer |
//! | `bie` | no | faults by boundary integrals, in half and whole spaces: lines of any dip, polylines, and planes in 3D (`stickslip::bie`), and with it realfft |
//! | `gmsh` | no | meshes of Gmsh with the names of their groups |
//! | `csv` | no | parameter samples from tables, and with it csv |
//! | `vtk` | no | files of the body and its contacts, and of faults by boundary integrals, for ParaView |
//! | `serde` | no | states and recorders by serde |
//! | `checkpoint` | no | checkpoint files (`Checkpoint`) and files of reduced bodies, and with it `serde`, postcard and xxhash-rust |
//! | `rayon` | no | assembly, solvers and contacts of large bodies, products and friction of large planes of cells, on rayon's thread pool |
//! | `dissection` | no | factors of large bodies in space by nested dissection, up to half as large, and with it feral-metis |
//!
//! With all features off a spring slider remains: a scene of one vertex, solved by [`Point`].

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(all(doctest, feature = "fem", feature = "condensed"))]
#[doc = include_str!("../README.md")]
struct Readme;

mod body;
#[cfg(feature = "checkpoint")]
mod checkpoint;
mod checks;
mod clock;
mod contact;
mod error;
pub mod fields;
#[cfg(feature = "checkpoint")]
mod file;
mod file_error;
pub mod integrate;
mod laws;
#[cfg(feature = "checkpoint")]
mod marks;
mod numerics;
mod placement;
pub mod problems;
pub mod record;
#[cfg(feature = "condensed")]
pub mod reduced;
mod scene;
mod settings;
mod simulation;
mod step;
mod step_state;
mod sums;
mod view;
pub mod work_precision;

#[cfg(feature = "checkpoint")]
pub use checkpoint::Checkpoint;
pub use error::{
    BoundaryCondition, OpenWalls, Place, SceneError, ShearAlongNormal, StepError, StepFailure,
};
pub use integrate::{ErrorControl, Run, RungeKutta, Steps};
pub use laws::StateUpdate;
pub use scene::{BoundaryPart, Components, Contact, NormalStress, OppositeSide, Scene};
pub use simulation::Simulation;
pub use step::{Convexity, Coupling, FixedPoint, Monolithic, Staggered};
pub use step_state::StepState;
pub use stickslip_solvers::{
    LinearSolver, Matrix, MeshId, MeshMismatch, NonsmoothSolver, NormalStressChange, Operator,
    Point,
};
pub use stickslip_time::{
    BackwardEuler, CentralDifferences, FirstOrderAlpha, GeneralizedAlpha, Newmark, QuasiStatic,
    RateScheme, Sdirk2,
};
pub use view::{ContactView, Residuals, Snapshot};

pub(crate) use clock::Clock;
pub(crate) use error::{Limit, LocalError};
pub(crate) use file_error::FileError;
pub(crate) use integrate::{IntoControlFlow, RunReport, Stepper};
pub(crate) use record::Event;
pub(crate) use step::{CouplingReport, StepMaps};
pub(crate) use step_state::{ContactState, ControlState, StepReport};

pub use nalgebra;
#[cfg(feature = "fem")]
pub use stickslip_fem as fem;
#[cfg(feature = "fem")]
pub use stickslip_fem::sprs;
// From there, so that it is one name under the globs of this crate and of `fem`.
#[cfg(feature = "bie")]
pub use stickslip_bie as bie;
#[cfg(feature = "fem")]
pub use stickslip_fem::BlockMatrix;
pub use stickslip_friction as friction;
pub use stickslip_lab as lab;
pub use stickslip_solvers as solvers;
pub use stickslip_state as state;
pub use stickslip_time as time;

#[cfg(any(feature = "tnnmg", feature = "condensed"))]
pub use stickslip_solvers::Cholesky;
#[cfg(feature = "fem")]
pub use stickslip_solvers::{BlockGaussSeidel, Diagonal, ElementOperator};
#[cfg(feature = "condensed")]
pub use stickslip_solvers::{Condensed, DenseNewton, Symmetric};
#[cfg(feature = "tnnmg")]
pub use stickslip_solvers::{MultigridSolver, Tnnmg};
