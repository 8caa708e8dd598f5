//! How does a body slide by a state law of one's own?
//!
//! The law of Perrin, Rice and Zheng, which the library does not have, next to Dieterich's: in a
//! velocity step of a spring slider, where both reach the same steady friction on different ways, and
//! in the paper's 2D slider through its first slip.
//!
//! ```text
//! cargo run --release --example custom_state_law -- --refinements 3 --steps 10000
//! ```

#[path = "../common/mod.rs"]
mod common;
mod law;
#[path = "../common/own_law/mod.rs"]
mod own_law;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::friction::DieterichRuina;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::{LogTheta, Theta, check_state_law};

use common::cli::{self, Problem};
use common::output::Output;
use law::PerrinRiceZheng;
use own_law::{Comparison, Resolution, SUMMARY, Trial};

/// A state law of one's own in a spring slider and in the 2D slider. Writes summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "custom_state_law")]
struct Arguments {
    #[command(flatten)]
    resolution: Resolution,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/custom_state_law")]
    out: PathBuf,
}

fn main() -> ExitCode {
    cli::run(compare)
}

fn compare(arguments: &Arguments) -> Result<(), Problem> {
    let output = Output::create(&arguments.out, &[SUMMARY])?;
    let law = PerrinRiceZheng {
        slip_distance: AGING.slip_distance,
    };
    check_state_law(&law, &[1e-5, 1.0, 1e3].map(Theta))?;

    // Steady contacts are twice as old as by Dieterich's law; friction compares them with 2L/V0.
    let friction = DieterichRuina {
        slip_distance: 2.0 * law.slip_distance,
        ..FRICTION
    };
    let alpha = LogTheta(INITIAL_LOG_THETA);
    let theta = Theta(2.0 * Theta::from(alpha).0);

    let resolution = &arguments.resolution;
    let own = Trial::run("PerrinRiceZheng", (friction, law, theta), resolution)?;
    let known = Trial::run("Dieterich", (FRICTION, AGING, alpha), resolution)?;
    Comparison::new(own, known).report(&output)
}
