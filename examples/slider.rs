//! The main experiment of Pipping, Sander and Kornhuber: when does an elastic body that is pulled over a rigid surface
//! slip, how far, and how fast?
//!
//! This is the command `stickslip slider`, with its flags; `block_3d` and `fields` show the scene of a body.
//!
//! ```text
//! cargo run --release --example slider -- --refinements 4 --steps 10000 --law dieterich
//! ```

use std::process::ExitCode;

use stickslip_cli::{cli, slider};

fn main() -> ExitCode {
    cli::run(slider::run)
}
