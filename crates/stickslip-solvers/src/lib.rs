//! Minimisation of convex energies with nonsmooth terms at single vertices,
//! `J(v) = v.Bv/2 - r.v + sum_p phi_p(v_p)`: the velocity problem of one implicit time step with
//! rate-dependent friction.
//!
//! ```
//! use nalgebra::Vector1;
//! use stickslip_fem::{Constraints, P1, antiplane};
//! use stickslip_friction::{Radial, Tresca};
//! use stickslip_solvers::{Condensed, Energy, NonsmoothSolver, Stopping};
//!
//! // A viscous layer of 1 m is moved at its top by 1 m/s; its base resists with 0.4 N/m^2.
//! let space = P1::grid([2.0, 1.0], [8, 4])?;
//! let (base, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
//! let operator = antiplane(&space, 1.0)?.into_matrix();
//! let mut fixed = Constraints::none(&space);
//! fixed.fix(&top, [true])?;
//! let load = vec![Vector1::new(0.0); space.vertex_count()];
//! let mut v = load.clone();
//! top.vertices().iter().for_each(|&p| v[p][0] = 1.0);
//! let law = Tresca { coefficient: 0.4 };
//! let friction: Vec<_> = base.weights().iter().map(|&force| Radial { law, force, state: () }).collect();
//! let (vertices, fixed) = (base.vertices(), fixed.as_slice());
//! let energy = Energy { operator: &operator, load: &load, potentials: &friction, vertices, fixed };
//! let stopping =
//!     Stopping { norm: &operator, tolerance: 1e-12, relative: 0.0, equivalence: 1.0, max_iterations: 100 };
//!
//! let mut solver = Condensed::new();
//! solver.prepare(&energy)?;
//! solver.minimize(&energy, &stopping, &mut v)?;
//! // v = 0.6 + 0.4 y
//! assert!(base.vertices().iter().all(|&p| (v[p][0] - 0.6).abs() < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | item | meaning |
//! | --- | --- |
//! | [`Energy`], [`Potentials`] | the functional, with components that are fixed; its nonsmooth part |
//! | [`NonsmoothSolver`] | minimiser: [`Tnnmg`], [`Condensed`], [`DenseNewton`], [`BlockGaussSeidel`], [`Diagonal`], [`Point`] |
//! | [`FrictionalSolver`] | minimiser of several problems that differ in friction alone: [`Condensed`] |
//! | [`Stopping`], [`SolveReport`], [`Counters`] | stopping criterion, cost |
//! | [`Transfers`] | the levels of a hierarchy for [`Tnnmg`] and [`MultigridSolver`] |
//! | [`LinearSolver`] | linear problems: [`ConjugateGradients`], [`MultigridSolver`], [`Cholesky`] |
//! | [`Matrix`], [`Operator`] | `B`: products alone, and sums; [`BlockMatrix`], [`Symmetric`] and other dense matrices, or one `nalgebra` block |
//! | [`StaticResponses`], [`Mode`] | Craig-Bampton reduction: static responses to the boundary, and vibrations of the interior |
//! | [`check_nonsmooth_solver`] | the contract of a solver, as a check |
//!
//! With default features off only [`Point`] remains, for scenes of one vertex, and neither sprs nor
//! faer is compiled. Feature `sparse` adds [`BlockMatrix`] and [`BlockGaussSeidel`], feature
//! `multigrid` (default) [`Tnnmg`], feature `condensed` (default) [`Condensed`] and [`DenseNewton`], feature `fem`
//! [matrices with the identity of their mesh](IntoOperator).
//!
//! With the feature `rayon` products, sweeps and cycles on bodies of some ten thousand vertices and more share the
//! threads of the pool of their caller: the global one, `RAYON_NUM_THREADS` wide, or that of `ThreadPool::install`. So
//! do the laws of a contact of more than 512 vertices. Results are the same bits on any number of threads. Without the
//! feature the order of the sweeps over vertices differs.
//!
//! With the feature `dissection` direct factors of large bodies in space are ordered by nested dissection (feral-metis).

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod basis;
#[cfg(feature = "sparse")]
mod basis_rows;
mod block;
#[cfg(feature = "sparse")]
mod block_matrix;
#[cfg(any(feature = "multigrid", feature = "condensed"))]
#[cfg_attr(
    not(feature = "condensed"),
    expect(dead_code, reason = "condensation asks for more than a linear problem")
)]
mod cholesky;
#[cfg(feature = "sparse")]
mod colouring;
#[cfg(feature = "condensed")]
mod condensed;
#[cfg(feature = "sparse")]
mod conformance;
mod conjugate_gradients;
#[cfg(feature = "condensed")]
mod dense;
mod dense_matrix;
#[cfg(feature = "sparse")]
mod diagonal;
#[cfg(feature = "fem")]
mod element_operator;
mod energy;
mod error;
mod field;
mod frames;
mod free_vertices;
mod frictional;
#[cfg(feature = "sparse")]
mod frictional_vertices;
#[cfg(feature = "sparse")]
mod gauss_seidel;
mod into_operator;
mod linear_solver;
#[cfg(feature = "multigrid")]
mod linear_step;
#[cfg(feature = "sparse")]
mod linked;
mod links;
#[cfg(feature = "sparse")]
mod mass_matrix;
mod matrix;
mod matrix_defect;
mod mesh_id;
mod mesh_mismatch;
#[cfg(feature = "multigrid")]
mod multigrid;
#[cfg(feature = "multigrid")]
mod multigrid_solver;
#[cfg(any(feature = "multigrid", feature = "condensed"))]
mod newton;
mod normal_stress_change;
mod operator;
#[cfg(feature = "condensed")]
mod packed_symmetric;
mod parts;
mod point;
mod potentials;
mod product_by_parts;
#[cfg(feature = "sparse")]
mod products;
#[cfg(any(feature = "sparse", feature = "multigrid", feature = "condensed"))]
mod progress;
mod ranks;
#[cfg(feature = "condensed")]
mod reduction;
#[cfg(feature = "condensed")]
mod several_vectors;
#[cfg(any(feature = "multigrid", feature = "condensed"))]
mod simd;
mod solver;
mod stopping;
#[cfg(feature = "sparse")]
mod sweep;
#[cfg(feature = "condensed")]
mod symmetric;
#[cfg(feature = "multigrid")]
mod tnnmg;
#[cfg(feature = "multigrid")]
mod transfers;
mod uncloned;
mod walls;

pub use nalgebra;
#[cfg(feature = "sparse")]
pub use sprs;
pub use stickslip_core::MOST_LEVELS;

pub use basis::Basis;
#[cfg(feature = "sparse")]
pub use basis_rows::BasisRows;
pub use block::decouple;
#[cfg(feature = "sparse")]
pub use block_matrix::{BlockMatrix, Prolongation};
#[cfg(any(feature = "multigrid", feature = "condensed"))]
pub use cholesky::Cholesky;
#[cfg(feature = "condensed")]
pub use condensed::Condensed;
#[cfg(feature = "sparse")]
pub use conformance::{SampleFriction, SolverViolation, check_nonsmooth_solver};
pub use conjugate_gradients::ConjugateGradients;
#[cfg(feature = "condensed")]
pub use dense::DenseNewton;
#[cfg(feature = "sparse")]
pub use diagonal::Diagonal;
#[cfg(feature = "fem")]
pub use element_operator::ElementOperator;
pub use energy::Energy;
pub use error::SolveError;
pub use frames::Frames;
pub use free_vertices::FreeVertices;
pub use frictional::FrictionalSolver;
#[cfg(feature = "sparse")]
pub use gauss_seidel::BlockGaussSeidel;
pub use into_operator::IntoOperator;
pub use linear_solver::LinearSolver;
#[cfg(feature = "multigrid")]
pub use linear_step::LinearStep;
pub use links::{Link, Links};
#[cfg(feature = "sparse")]
pub use mass_matrix::MassMatrix;
pub use matrix::Matrix;
pub use matrix_defect::MatrixDefect;
pub use mesh_id::MeshId;
pub use mesh_mismatch::MeshMismatch;
#[cfg(feature = "multigrid")]
pub use multigrid_solver::MultigridSolver;
pub use normal_stress_change::NormalStressChange;
pub use operator::Operator;
#[doc(hidden)]
pub use parts::{Divide, for_contact, for_parts, gather_contact, sum_parts};
pub use point::Point;
pub use potentials::Potentials;
pub use product_by_parts::{BeginPart, EndPart, ProductByParts};
pub use ranks::{Collective, Ranks};
#[cfg(feature = "condensed")]
pub use reduction::{Between, Mode, Modes, StaticResponses};
pub use solver::{Counters, NonsmoothSolver};
pub use stopping::{SolveReport, Stopping};
#[cfg(feature = "condensed")]
pub use symmetric::Symmetric;
#[cfg(feature = "multigrid")]
pub use tnnmg::Tnnmg;
#[cfg(feature = "multigrid")]
pub use transfers::Transfers;
pub use walls::Walls;
