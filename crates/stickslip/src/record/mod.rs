//! Recorders for the observer of a run: histories, traces, events, energies, files.

mod body_work;
mod catalogue;
mod check;
mod event;
mod ledger;
mod npy;
mod points;
#[cfg(feature = "bie")]
mod receivers;
mod rupture_times;
mod seas;
mod table;
mod threshold;
mod trace_memory;
mod trace_writer;
mod tracing;
#[cfg(feature = "vtk")]
mod vtk;

pub use crate::file_error::FileError;
pub use catalogue::EventCatalogue;
pub use event::Event;
pub use ledger::{Balance, EnergyLedger};
pub use npy::NpyArray;
pub use points::PointHistories;
#[cfg(feature = "bie")]
pub use receivers::{ReceiverFiles, ReceiverFolder};
pub use rupture_times::{Rupture, RuptureTimes};
pub use seas::{
    SeasFiles, SeasFolder, SeasGlobal, SeasHeader, SeasPoint, SeasProfile, SeasStation, SeasTable,
};
pub use table::{Entry, Table};
pub use trace_memory::TraceMemory;
pub use trace_writer::TraceWriter;
pub use tracing::{Quantity, Tracing};
#[cfg(all(feature = "vtk", feature = "bie"))]
pub use vtk::VtkFaultSeries;
#[cfg(feature = "vtk")]
pub use vtk::{SurfaceGrid, VtkSeries};
