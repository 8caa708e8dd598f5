//! Robustness at extreme parameters, from the laws to the paper's slider and to a block in three dimensions.
//!
//! Every case ends in one of three ways: it is solved, and equations evaluated apart from the
//! solvers hold; it is refused before the first step; or a step fails with an error that says
//! which, when and why, and leaves the simulation fit for another try. Anything else is a defect,
//! and the program fails.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin stability -- --only point
//! ```

mod accuracy;
mod case;
mod check;
mod laws;
mod march;
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
use indicatif::ProgressBar;
use stickslip_cli::cli::{self, Problem};
use stickslip_cli::output::Output;
use stickslip_studies::{Report, Table};

use case::{Case, IntoControlFlow, Label, Outcome, catch_panics};
use report::Summary;

const TABLE: &str = "stability.md";
const SUMMARY: &str = "summary.json";

/// Extreme parameters through laws, spring slider, slider and block. Writes stability.md and summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "stability")]
struct Arguments {
    /// Which part to run
    #[arg(long, default_value = "all")]
    only: BoundaryPart,
    /// A slice of it that takes some seconds
    #[arg(long)]
    quick: bool,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/stability")]
    out: PathBuf,
    /// A report whose tables are replaced, that of all outcomes with all parts only
    #[arg(long, value_name = "FILE", conflicts_with = "quick")]
    report: Option<PathBuf>,
    /// Prints each case that is no success
    #[arg(long)]
    verbose: bool,
}

/// A part of the cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BoundaryPart {
    /// Laws and local problems
    Laws,
    /// The spring slider
    Point,
    /// The paper's slider
    Slider,
    /// A block in three dimensions
    Block,
    /// All of them
    All,
}

/// A function that makes the cases of a part, quick or not.
type Cases = fn(bool) -> Vec<Case>;

/// The parts, with their names in the report.
const PARTS: [(BoundaryPart, &str, Cases); 4] = [
    (BoundaryPart::Laws, laws::SECTION, laws::cases),
    (BoundaryPart::Point, point::SECTION, point::cases),
    (BoundaryPart::Slider, slider::SECTION, slider::cases),
    (BoundaryPart::Block, slider::BLOCK, slider::blocks),
];

fn main() -> ExitCode {
    cli::run(try_all)
}

fn try_all(arguments: &Arguments) -> Result<(), Problem> {
    let parts: Vec<_> = PARTS
        .into_iter()
        .filter(|(part, ..)| arguments.only == BoundaryPart::All || arguments.only == *part)
        .collect();
    let sections: Vec<&str> = parts.iter().map(|&(_, section, _)| section).collect();
    let all = arguments.only == BoundaryPart::All;
    let names = names(&sections, all);
    let report = match &arguments.report {
        Some(file) => Some(Report::open(file, names.iter().map(String::as_str))?),
        None => None,
    };
    let output = Output::create(&arguments.out, &[TABLE, SUMMARY])?;
    let cases = parts
        .iter()
        .flat_map(|(_, _, cases)| cases(arguments.quick));
    let begin = Instant::now();
    let results = run(cases.collect(), arguments.verbose);
    let summary = Summary::of(&results, begin.elapsed().as_secs_f64());
    let tables = tables(&results, &sections, all);
    write_tables(&output, &tables)?;
    output.json(SUMMARY, &summary)?;
    if let Some(report) = report {
        report.fill(&tables)?;
    }
    println!("{} cases: {}", summary.cases, summary.outcomes.line());
    println!(
        "{:.0} s, longest {:.1} s: {}",
        summary.seconds, summary.slowest.1, summary.slowest.0
    );
    println!("{TABLE}, {SUMMARY} in {}", output.folder().display());
    match summary.outcomes.defects {
        0 => Ok(()),
        defects => Err(format!("{defects} of {} cases are defects", summary.cases).into()),
    }
}

/// The names of the tables.
fn names(sections: &[&str], all: bool) -> Vec<String> {
    let outcomes = all.then(|| report::OUTCOMES.into()).into_iter();
    let of_sections = sections.iter().flat_map(|section| report::names(section));
    outcomes.chain(of_sections).collect()
}

/// The tables; that of all outcomes needs all parts.
fn tables(results: &[(Label, IntoControlFlow)], sections: &[&str], all: bool) -> Vec<Table> {
    let outcomes = all.then(|| report::outcomes(results)).into_iter();
    let of_sections = sections
        .iter()
        .flat_map(|section| report::section_tables(results, section));
    outcomes.chain(of_sections).collect()
}

/// Runs the cases one after the other and prints defects; with `verbose`, all that is no success.
fn run(cases: Vec<Case>, verbose: bool) -> Vec<(Label, IntoControlFlow)> {
    catch_panics();
    let bar = ProgressBar::new(cases.len() as u64);
    let mut results = Vec::with_capacity(cases.len());
    for case in cases {
        let (label, verdict) = case.run();
        bar.inc(1);
        let shown = verbose && verdict.outcome != Outcome::Solved;
        if shown || verdict.outcome == Outcome::Defect {
            bar.suspend(|| print(&label, &verdict));
        }
        results.push((label, verdict));
    }
    bar.finish_and_clear();
    results
}

fn print(label: &Label, verdict: &IntoControlFlow) {
    println!(
        "{:?}: {}, {}, {} ({:.1} s): {}",
        verdict.outcome, label.extreme, label.method, label.member, verdict.seconds, verdict.text
    );
}

fn write_tables(output: &Output, tables: &[Table]) -> Result<(), Problem> {
    let mut file = output.file(TABLE)?;
    for Table { name, text } in tables {
        writeln!(file, "## {name}\n\n{text}")?;
    }
    file.flush()?;
    Ok(())
}
