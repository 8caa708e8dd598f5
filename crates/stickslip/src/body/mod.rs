//! The body of a scene: its matrices in their own format, and the solver of its velocity problems.
//!
//! All that is written per format of a matrix lies here. Other rooms see [`Matrices`] and [`Body`], which are objects.

mod any_solver;
mod assembly;
mod formatted;
mod matrices;
mod operator_body;
mod split;
mod viscosity;

pub(crate) use any_solver::AnySolver;
pub(crate) use assembly::{Body, Boundary, Goal};
pub(crate) use matrices::Matrices;
pub(crate) use viscosity::first_coupled;
