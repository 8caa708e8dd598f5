//! The claims of friction laws and their potentials: one program, a module for each theme.

mod capped;
mod common;
mod conformance;
mod extremes;
mod falling;
mod laws;
mod many_nodes;
mod radial;
mod regularized;
mod sliding;
mod strong_rate_weakening;
mod unilateral;
mod violations;
mod weakening;
