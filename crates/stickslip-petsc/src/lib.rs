//! Scenes of stickslip in several processes, by PETSc and MPI.
//!
//! A [`DistributedSpace`] is the part of a mesh that a process has, a [`DistributedMatrix`] the rows of its vertices,
//! and [`PetscTnnmg`] the truncated nonsmooth Newton method with PETSc's multigrid. Explicit steps take
//! [`DistributedElements`], a stiffness without a matrix, and [`DistributedDiagonal`]. `Scene`, laws,
//! schemes, couplings and runs are those of `stickslip`; [`run`] is the frame of a program.

mod basis;
mod checkpoint;
mod congruent;
mod copies;
mod diagonal;
mod elements;
mod equilibrium;
mod error;
#[allow(unsafe_code)]
mod ffi;
mod gradients;
mod hierarchy;
mod history;
mod layout;
mod matrix;
mod numbering;
mod partition;
mod solver;
mod space;
mod system;
mod unknowns;
mod world;

pub use checkpoint::SharedCheckpoint;
pub use diagonal::DistributedDiagonal;
pub use elements::DistributedElements;
pub use equilibrium::PetscGradients;
pub use error::Error;
pub use history::{Column, SharedHistory};
pub use matrix::DistributedMatrix;
pub use solver::PetscTnnmg;
pub use space::DistributedSpace;
pub use world::{World, peak_memory, run};
