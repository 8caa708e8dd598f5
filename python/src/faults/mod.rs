//! Planar faults by boundary integrals.

mod advance;
mod callback;
mod cycle;
mod events;
mod friction;
mod function;
mod geometry;
mod laws;
mod line;
mod loading;
mod per_cell;
mod plane;
mod record;
mod samples;
mod scene;
mod seas;
mod seas_table;
mod system;

pub(crate) use cycle::FaultSimulation;
pub(crate) use line::LineFault;
pub(crate) use per_cell::Layout;
pub(crate) use plane::PlaneFault;
pub(crate) use record::FaultRun;
pub(crate) use seas::SeasFiles;
pub(crate) use seas_table::SeasTable;
pub(crate) use system::FaultSystem;
