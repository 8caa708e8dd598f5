//! Condensation finds the minimiser that multigrid and sweeps find, never climbs, and factorises no
//! operator twice.

mod boundary;
mod errors;
mod factors;
mod minimiser;
