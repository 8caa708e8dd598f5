//! What is kept of a run.

mod body_work;
mod catalogue;
mod check;
mod event;
mod events;
mod history;
mod ledger;
mod points;
mod statistics;
mod table;
mod threshold;
mod trace_memory;
mod trace_writer;
mod tracing;
#[cfg(feature = "vtk")]
mod vtk;
#[cfg(feature = "vtk")]
mod vtk_grid;
mod work_precision;

pub use catalogue::EventCatalogue;
pub use event::Event;
pub use events::Events;
pub use history::{History, Sample};
pub use ledger::{Balance, EnergyLedger};
pub use points::PointHistories;
pub use statistics::{Statistics, Total};
pub use table::{Entry, Table};
pub use trace_memory::TraceMemory;
pub use trace_writer::TraceWriter;
pub use tracing::{Quantity, Tracing};
#[cfg(feature = "vtk")]
pub use vtk::VtkSeries;
pub use work_precision::{Measurement, WorkPrecision, observed_order, seconds_to};
