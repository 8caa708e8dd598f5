//! Views of an accepted step.

mod contact_view;
mod global_fields;
mod normal_stress;
mod of_simulation;
mod readings;
mod residuals;
mod snapshot;
mod step_view;

pub use contact_view::ContactView;
pub(crate) use global_fields::GlobalFields;
pub use residuals::Residuals;
pub(crate) use residuals::residuals;
pub use snapshot::Snapshot;
pub(crate) use step_view::StepView;
