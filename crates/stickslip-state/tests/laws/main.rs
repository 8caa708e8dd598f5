//! The claims of state laws: one program, a module for each theme.

mod common;
mod conformance;
mod fitted;
mod laws;
mod reference;
mod sato;
mod slopes;
mod strong_weakening;
mod weakening;
