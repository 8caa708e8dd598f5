//! Condensation finds the minimiser that multigrid and sweeps find, never climbs, and factorises no
//! operator twice.
#![cfg(all(feature = "multigrid", feature = "condensed"))]

#[path = "../common/mod.rs"]
mod common;

mod errors;
mod factors;
mod minimiser;
