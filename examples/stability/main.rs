//! What happens at extreme parameters, from the laws to the paper's slider?
//!
//! Every case ends in one of three ways: it is solved, and equations evaluated apart from the solvers
//! hold; it is refused before the first step; or a step fails with an error that says which, when and
//! why, and leaves the simulation fit for another try. Anything else is a defect, and the program fails.
//!
//! ```text
//! cargo run --release --example stability -- --only point
//! ```

#[path = "../common/mod.rs"]
mod common;

mod case;
mod check;
mod laws;
mod method;
mod point;
mod report;
mod setup;
mod slider;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::{Parser, ValueEnum};

use case::{Outcome, catch_panics};
use common::cli::{self, Problem};
use common::output::Output;
use common::progress::Progress;
use report::Summary;

const TABLE: &str = "stability.md";
const SUMMARY: &str = "summary.json";

/// Extreme parameters through laws, spring slider and slider. Writes stability.md and summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "stability")]
struct Arguments {
    /// Which part to run
    #[arg(long, default_value = "all")]
    only: Part,
    /// A slice of it that takes some seconds
    #[arg(long)]
    quick: bool,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/stability")]
    out: PathBuf,
    /// Another file for the table
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Prints each case that is no success
    #[arg(long)]
    verbose: bool,
}

/// A part of the cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Laws and local problems
    Laws,
    /// The spring slider
    Point,
    /// The paper's slider
    Slider,
    /// All of them
    All,
}

fn main() -> ExitCode {
    cli::run(try_all)
}

fn try_all(arguments: &Arguments) -> Result<(), Problem> {
    let output = Output::create(&arguments.out, &[TABLE, SUMMARY])?;
    let wanted = |part| arguments.only == Part::All || arguments.only == part;
    let mut cases = Vec::new();
    if wanted(Part::Laws) {
        cases.extend(laws::cases(arguments.quick));
    }
    if wanted(Part::Point) {
        cases.extend(point::cases(arguments.quick));
    }
    if wanted(Part::Slider) {
        cases.extend(slider::cases(arguments.quick));
    }
    catch_panics();
    let begin = Instant::now();
    let mut progress = Progress::new(cases.len());
    let mut results = Vec::with_capacity(cases.len());
    for (n, case) in cases.into_iter().enumerate() {
        let (label, verdict) = case.run();
        progress.show(n, || format!("{}, {}", label.extreme, label.method));
        let shown = arguments.verbose && verdict.outcome != Outcome::Solved;
        if shown || verdict.outcome == Outcome::Defect {
            println!(
                "{:?}: {}, {}, {} ({:.1} s): {}",
                verdict.outcome,
                label.extreme,
                label.method,
                label.member,
                verdict.seconds,
                verdict.text
            );
        }
        results.push((label, verdict));
    }
    drop(progress);
    let summary = Summary::of(&results, begin.elapsed().as_secs_f64());
    let text = format!(
        "# Stability at extreme parameters\n\n{} cases: {}.\n{}",
        summary.cases,
        summary.outcomes.line(),
        report::table(&results)
    );
    let mut file = output.file(TABLE)?;
    file.write_all(text.as_bytes())?;
    file.flush()?;
    output.json(SUMMARY, &summary)?;
    if let Some(path) = &arguments.report {
        std::fs::write(path, &text)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    println!("{text}");
    println!(
        "{} s, longest {:.1} s: {}",
        summary.seconds.round(),
        summary.slowest.1,
        summary.slowest.0
    );
    println!("{TABLE}, {SUMMARY} in {}", output.folder().display());
    match summary.outcomes.defects {
        0 => Ok(()),
        defects => Err(format!("{defects} of {} cases are defects", summary.cases).into()),
    }
}
