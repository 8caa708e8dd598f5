//! Fits rate- and state-dependent friction to laboratory experiments: velocity steps, holds, slide-hold-slide.

#![cfg_attr(docsrs, feature(doc_cfg))]

mod curve;
mod error;
mod evolution;
mod fit;
mod fitted;
mod least_squares;
mod load;
mod model;
mod parameters;
mod record;
mod rosenbrock;
mod search;
mod setup;
mod start;
mod synthetic;
mod warning;

pub use curve::Work;
pub use error::LabError;
pub use evolution::{BoxedLaw, Evolution};
pub use fit::Fit;
pub use fitted::{Estimate, Fitted};
pub use load::LoadHistory;
pub use model::Trend;
pub use parameters::{Parameter, Parameters, StateParameters};
pub use record::Record;
pub use warning::Warning;
