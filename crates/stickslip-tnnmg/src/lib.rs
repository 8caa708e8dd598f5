//! Minimisation of convex energies with nonsmooth terms at single vertices,
//! `J(v) = v.Bv/2 - r.v + sum_p phi_p(v_p)`: the velocity problem of one implicit time step with
//! rate-dependent friction.
//!
//! | item | what it is |
//! | --- | --- |
//! | [`Energy`] | the functional, with components that are fixed |
//! | [`NonsmoothSolver`] | what minimises it: [`Tnnmg`], [`Condensed`], [`BlockGaussSeidel`], [`Point`] |
//! | [`Stopping`], [`SolveReport`] | when to stop, and what it cost |
//! | [`Operator`] | `B`: [`BlockMatrix`], or one `nalgebra` block |
//! | [`check_nonsmooth_solver`] | the contract of a solver, as a function |
//!
//! With default features off only [`Point`] remains, for scenes of one vertex, and neither sprs nor
//! faer is compiled. Feature `sparse` adds [`BlockMatrix`] and [`BlockGaussSeidel`], feature
//! `multigrid` (default) [`Tnnmg`], feature `condensed` (default) [`Condensed`].

mod block;
#[cfg(feature = "sparse")]
mod block_matrix;
#[cfg(feature = "condensed")]
mod condensed;
#[cfg(feature = "sparse")]
mod conformance;
#[cfg(feature = "sparse")]
mod diagonal;
mod energy;
mod error;
#[cfg(feature = "sparse")]
mod field;
#[cfg(feature = "sparse")]
mod gauss_seidel;
#[cfg(any(feature = "multigrid", feature = "condensed"))]
mod line_search;
#[cfg(feature = "multigrid")]
mod linear_step;
#[cfg(feature = "multigrid")]
mod multigrid;
mod operator;
mod point;
#[cfg(any(feature = "multigrid", feature = "condensed"))]
mod progress;
mod solver;
#[cfg(feature = "sparse")]
mod sweep;
#[cfg(feature = "multigrid")]
mod tnnmg;

#[cfg(feature = "sparse")]
pub use block_matrix::{BlockMatrix, Prolongation};
#[cfg(feature = "condensed")]
pub use condensed::Condensed;
#[cfg(feature = "sparse")]
pub use conformance::{SampleFriction, SamplePotential, SolverViolation, check_nonsmooth_solver};
#[cfg(feature = "sparse")]
pub use diagonal::Diagonal;
pub use energy::Energy;
pub use error::SolveError;
#[cfg(feature = "sparse")]
pub use gauss_seidel::BlockGaussSeidel;
#[cfg(feature = "multigrid")]
pub use linear_step::LinearStep;
pub use operator::Operator;
pub use point::Point;
pub use solver::{NonsmoothSolver, SolveReport, Stopping};
#[cfg(feature = "multigrid")]
pub use tnnmg::Tnnmg;
