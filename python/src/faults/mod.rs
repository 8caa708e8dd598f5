//! Faults by boundary integrals.

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
mod rows;
mod samples;
mod scene;
mod seas;
mod seas_table;
mod segment_fault;
mod segments;
mod surface_fault;
mod system;
mod triangles;

pub(crate) use cycle::FaultSimulation;
pub(crate) use line::LineFault;
pub(crate) use per_cell::Layout;
pub(crate) use plane::PlaneFault;
pub(crate) use record::FaultRun;
pub(crate) use seas::SeasFiles;
pub(crate) use seas_table::SeasTable;
pub(crate) use segment_fault::SegmentFault;
pub(crate) use segments::Segments;
pub(crate) use surface_fault::SurfaceFault;
pub(crate) use system::FaultSystem;
pub(crate) use triangles::Triangles;
