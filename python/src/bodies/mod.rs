//! Bodies by finite elements: meshes, boundary conditions, contacts, runs.

mod body;
mod condition;
mod friction;
mod mesh;
mod part;
mod predicate;
mod reduced;
mod simulation;
mod start;
mod state;

pub(crate) use body::Body;
pub(crate) use friction::PerVertex;
pub(crate) use mesh::Mesh;
pub(crate) use part::Part;
pub(crate) use simulation::{BodyRun, BodySimulation};
pub(crate) use state::{BodyState, ContactState};
