//! The program `stickslip`, run as a user runs it.

mod crack;
mod faults;
mod fit;
mod fit_jointly;
mod injection;
mod killed;
mod off_fault;
mod pipes;
mod refusals;
mod rupture;
mod spring_slider;
mod tables;
mod wrong;

use std::error::Error;
use std::path::PathBuf;
use std::process::Command;

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// A command of the program.
fn program(name: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stickslip"));
    command.arg(name);
    command
}

/// An empty folder of this name.
fn folder(name: &str) -> Outcome<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}
