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
mod comparison;
mod law;
mod runs;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::Monolithic;
use stickslip::friction::DieterichRuina;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::{LogTheta, Theta, check_state_law};

use common::cli::{self, Problem};
use common::output::Output;
use comparison::Comparison;
use law::PerrinRiceZheng;
use runs::{slide, steady_coefficient, velocity_step};

const SUMMARY: &str = "summary.json";

/// A state law of one's own in a spring slider and in the 2D slider. Writes summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "custom_state_law")]
struct Arguments {
    /// Uniform refinements of the 2D slider's mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=8))]
    refinements: u8,
    /// Time steps in the 2D slider's whole 15 s, of which it runs through 10.5 s
    #[arg(long, value_name = "N", default_value = "10000")]
    steps: NonZeroUsize,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/custom_state_law")]
    out: PathBuf,
}

fn main() -> ExitCode {
    cli::run(compare)
}

fn compare(arguments: &Arguments) -> Result<(), Problem> {
    let (refinements, steps) = (arguments.refinements.into(), arguments.steps.get());
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

    let summary = Comparison {
        laws: ["PerrinRiceZheng", "Dieterich"],
        conformance: "passed",
        steady_exact: steady_coefficient(&FRICTION),
        velocity_step: [
            velocity_step(friction, law, 1e-8)?,
            velocity_step(FRICTION, AGING, 1e-8)?,
        ],
        slider: [
            slide(
                refinements,
                steps,
                (friction, law, theta),
                Monolithic::default(),
            )?,
            slide(
                refinements,
                steps,
                (FRICTION, AGING, alpha),
                Monolithic::default(),
            )?,
        ],
    };
    output.json(SUMMARY, &summary)?;
    summary.print();
    println!("{SUMMARY} in {}", output.folder().display());
    Ok(())
}
