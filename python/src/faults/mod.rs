//! Planar faults by boundary integrals.

mod cycle;
mod events;
mod friction;
mod function;
mod geometry;
mod laws;
mod line;
mod plane;
mod record;
mod seas;
mod seas_table;

pub(crate) use cycle::FaultSimulation;
pub(crate) use line::LineFault;
pub(crate) use plane::PlaneFault;
pub(crate) use record::FaultRun;
pub(crate) use seas::SeasFiles;
pub(crate) use seas_table::SeasTable;
