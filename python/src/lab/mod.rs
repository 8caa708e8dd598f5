//! Laboratory experiments: fits, synthetic records, healing.

mod fit_result;
mod fitting;
mod given;
mod holds;
mod joint_result;
mod names;
mod options;
mod synthetic;
mod watch;

pub(crate) use fit_result::FitResult;
pub(crate) use fitting::{fit, joint_fit};
pub(crate) use holds::{Healing, healing};
pub(crate) use joint_result::JointFitResult;
pub(crate) use synthetic::{slide_hold_slide, velocity_step};
