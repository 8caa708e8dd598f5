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
#[path = "../custom_state_law/comparison.rs"]
mod comparison;
mod law;
#[path = "../custom_state_law/runs.rs"]
mod runs;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use stickslip::Monolithic;
use stickslip::friction::check_friction_law;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;

use common::cli::{self, Problem};
use common::output::Output;
use comparison::Comparison;
use law::SoftCutoff;
use runs::{slide, steady_coefficient, velocity_step};

const SUMMARY: &str = "summary.json";

/// A friction law of one's own in a spring slider and in the 2D slider. Writes summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "custom_friction_law")]
struct Arguments {
    /// Uniform refinements of the 2D slider's mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=8))]
    refinements: u8,
    /// Time steps in the 2D slider's whole 15 s, of which it runs through 10.5 s
    #[arg(long, value_name = "N", default_value = "10000")]
    steps: NonZeroUsize,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/custom_friction_law")]
    out: PathBuf,
}

fn main() -> ExitCode {
    cli::run(compare)
}

fn compare(arguments: &Arguments) -> Result<(), Problem> {
    let (refinements, steps) = (arguments.refinements.into(), arguments.steps.get());
    let output = Output::create(&arguments.out, &[SUMMARY])?;
    let law = SoftCutoff(FRICTION);
    check_friction_law(&law, &[-300.0, -50.0, -10.0, 2.0, 30.0].map(LogTheta))?;

    let alpha = LogTheta(INITIAL_LOG_THETA);
    let summary = Comparison {
        laws: ["SoftCutoff", "DieterichRuina"],
        conformance: "passed",
        steady_exact: steady_coefficient(&FRICTION),
        velocity_step: [
            velocity_step(law, AGING, 1e-8)?,
            velocity_step(FRICTION, AGING, 1e-8)?,
        ],
        slider: [
            slide(
                refinements,
                steps,
                (law, AGING, alpha),
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
