//! How does a body slide by a friction law of one's own?
//!
//! Friction with a soft cut-off, `mu = a ln(1 + V/Vm)`, next to Dieterich's and Ruina's law with a
//! hard one: in a velocity step of a spring slider and in the paper's 2D slider through its first
//! slip. Far above `Vm`, where both slide, they cannot be told apart.
//!
//! ```text
//! cargo run --release --example custom_friction_law -- --refinements 3 --steps 10000
//! ```

#[path = "../common/mod.rs"]
mod common;
mod law;
#[path = "../common/own_law/mod.rs"]
mod own_law;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::friction::check_friction_law;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;

use common::cli::{self, Problem};
use common::output::Output;
use law::SoftCutoff;
use own_law::{Comparison, Resolution, SUMMARY, Trial};

/// A friction law of one's own in a spring slider and in the 2D slider. Writes summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "custom_friction_law")]
struct Arguments {
    #[command(flatten)]
    resolution: Resolution,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/custom_friction_law")]
    out: PathBuf,
}

fn main() -> ExitCode {
    cli::run(compare)
}

fn compare(arguments: &Arguments) -> Result<(), Problem> {
    let output = Output::create(&arguments.out, &[SUMMARY])?;
    let law = SoftCutoff(FRICTION);
    check_friction_law(&law, &[-300.0, -50.0, -10.0, 2.0, 30.0].map(LogTheta))?;

    let alpha = LogTheta(INITIAL_LOG_THETA);
    let resolution = &arguments.resolution;
    let own = Trial::run("SoftCutoff", (law, AGING, alpha), resolution)?;
    let known = Trial::run("DieterichRuina", (FRICTION, AGING, alpha), resolution)?;
    Comparison::new(own, known).report(&output)
}
