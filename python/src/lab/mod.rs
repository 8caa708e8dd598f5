//! Laboratory experiments: fits, synthetic records, healing.

mod fit_result;
mod fitting;
mod history;
mod holds;
mod synthetic;

pub(crate) use fit_result::FitResult;
pub(crate) use fitting::fit;
pub(crate) use holds::{Healing, healing};
pub(crate) use synthetic::{slide_hold_slide, velocity_step};
