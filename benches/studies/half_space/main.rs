//! When do earthquakes come on a fault in a finite body, and how large must it be to stand for a half space?
//!
//! The fault of BP1-QD in quarter planes of finite elements, graded towards the fault, moved at their far sides; and in
//! the half space by its kernel.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin half_space -- --report docs/reports/half-space.md
//! ```

mod fault;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;
use stickslip_cli::onsets::Onsets;

use clap::Parser;
use stickslip::{Run, Steps};
use stickslip_cli::cli::{self, Problem};
use stickslip_cli::earthquakes::YEAR;
use stickslip_studies::{Report, Table};

use fault::{Fault, SIDES, elements, kernel};

/// The name of the report's table.
const RECURRENCE: &str = "recurrence";
/// The slip rate across the fault at which an event begins, and below which it has ended [m/s].
const EVENT: [f64; 2] = [1e-2, 1e-3];

/// Recurrence on a fault in finite bodies and in a half space
#[derive(Debug, Parser)]
#[command(name = "half_space")]
struct Arguments {
    /// The length of a cell on the fault, 8 km over a power of two [m]
    #[arg(long, value_name = "METRES", default_value_t = 62.5, value_parser = cli::positive)]
    cell: f64,
    /// The end of the runs [years]
    #[arg(long, value_name = "YEARS", default_value_t = 600.0, value_parser = cli::positive)]
    years: f64,
    /// The error of ln V and ln theta that a step may have
    #[arg(long, value_name = "TOLERANCE", default_value_t = 1e-4, value_parser = cli::positive)]
    adaptive: f64,
    /// Length and depth of the bodies [km], multiples of 8 km beyond the fault's 40
    #[arg(long, value_name = "KM", value_delimiter = ',', default_values_t = [80, 160, 320, 640])]
    sizes: Vec<usize>,
    /// The report whose table is filled; printed, unless given
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let report = arguments.report.as_ref();
        let report = report
            .map(|file| Report::open(file, [RECURRENCE]))
            .transpose()?;
        let mut text = String::from(
            "| body | vertices | first event [years] | recurrence [years] | slip of an event at 7.5 km [m] | setup [s] | run [s] |\n\
             | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        );
        for &size in &arguments.sizes {
            let name = format!("{size} km by {size} km");
            text.push_str(&row(&name, arguments, || elements(size, arguments.cell))?);
        }
        text.push_str(&row("half space", arguments, || kernel(arguments.cell))?);
        match report {
            Some(report) => report.fill(&[Table {
                name: RECURRENCE.into(),
                text,
            }]),
            None => {
                println!("{text}");
                Ok(())
            }
        }
    })
}

/// The events of a fault.
fn row(
    name: &str,
    arguments: &Arguments,
    fault: impl FnOnce() -> Result<Fault, Problem>,
) -> Result<String, Problem> {
    let clock = Instant::now();
    let Fault {
        mut motion,
        vertices,
        station,
    } = fault()?;
    let setup = clock.elapsed().as_secs_f64();
    let mut events = Onsets::new(EVENT[0], EVENT[1]);
    let (mut slips, mut slip) = (Vec::new(), 0.0);
    let steps = Steps::adaptive(arguments.adaptive)
        .with_max_steps(usize::MAX)
        .until(arguments.years * YEAR);
    let clock = Instant::now();
    motion.run(&steps, |at| {
        let contact = at.contact(0);
        events.record(at.time, SIDES * contact.slip_rate(station));
        if events.times().len() > slips.len() {
            slips.push(slip);
        }
        slip = SIDES * contact.slip(station);
    })?;
    let run = clock.elapsed().as_secs_f64();
    let years: Vec<_> = events.times().iter().map(|time| time / YEAR).collect();
    let first = years
        .first()
        .map_or("-".into(), |year| format!("{year:.2}"));
    // Between the last two events the cycle has settled.
    let [interval, slip] = match (&years[..], &slips[..]) {
        ([.., before, last], [.., from, to]) => {
            [last - before, to - from].map(|x| format!("{x:.3}"))
        }
        _ => ["-".into(), "-".into()],
    };
    let vertices = vertices.map_or("-".into(), |count| count.to_string());
    let row = format!(
        "| {name} | {vertices} | {first} | {interval} | {slip} | {setup:.1} | {run:.1} |\n"
    );
    eprint!("{row}");
    Ok(row)
}
