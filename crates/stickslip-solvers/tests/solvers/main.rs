//! The solvers: what they find, what it costs, what they refuse.
#![cfg(all(feature = "multigrid", feature = "condensed"))]

mod agreement;
mod allocation;
mod auxiliary;
mod common;
mod condensed;
mod conformance;
mod convergence;
mod definite;
mod dense;
mod descent;
mod elements;
mod errors;
mod graded;
mod linear;
mod links;
mod masses;
mod operators;
mod point;
mod preparation;
mod reduction;
mod single_precision;
#[cfg(feature = "rayon")]
mod threads;
