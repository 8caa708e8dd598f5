//! What the examples share and what is not physics: the command line, the output folder, the
//! progress bar, the record of a run, pictures.

#![allow(dead_code, reason = "each example uses a part of this")]

pub(crate) mod axis;
pub(crate) mod cli;
pub(crate) mod log_log;
pub(crate) mod output;
pub(crate) mod plot;
pub(crate) mod progress;
pub(crate) mod record;
pub(crate) mod state_law;
