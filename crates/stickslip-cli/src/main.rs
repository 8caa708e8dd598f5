//! Stick-slip and earthquake cycles from the command line.

use std::process::ExitCode;

use stickslip_cli::{cli, commands};

fn main() -> ExitCode {
    cli::run(commands::run)
}
