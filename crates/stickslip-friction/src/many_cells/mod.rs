//! Rate- and state-dependent friction of many cells with radiation damping, several cells per instruction.

mod balance;
mod block;
#[cfg(test)]
mod double;
mod elementary;
mod error;
mod friction;
mod pass;

pub use error::ManyCellsError;
pub use friction::{CellState, EvolutionLaw, QuasiDynamicFriction};
