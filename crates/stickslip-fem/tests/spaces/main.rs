//! What meshes, spaces and operators claim: one program, a module for each theme.
#![allow(clippy::unwrap_used)]

mod auxiliary;
mod common;
mod convergence;
mod cracks;
mod curves;
#[cfg(feature = "gmsh")]
mod gmsh;
mod grading;
mod groups;
mod materials;
mod mesh;
mod operators;
mod parts;
mod refinement;
mod samples;
#[cfg(feature = "csv")]
mod samples_csv;
mod stress;
#[cfg(feature = "rayon")]
mod threads;
mod waves;
