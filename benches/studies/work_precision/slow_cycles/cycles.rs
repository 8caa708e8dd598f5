//! The events of a run, and how those of all runs compare.

use std::fmt::{Error, Write};

use stickslip_cli::cli::Problem;
use stickslip_cli::output::{Output, digits};
use stickslip_studies::Table;

/// The name of the table.
pub(crate) const NAME: &str = "slow-cycles";

/// So many events of the beginning are no part of the statistics: the body forgets its start.
const SETTLING: usize = 20;

/// One run.
#[derive(Debug, Clone)]
pub(crate) struct Cycles {
    pub(super) body: &'static str,
    pub(super) scheme: String,
    /// The weight of the error of the motion.
    pub(super) motion: f64,
    pub(super) tolerance: f64,
    /// The times at which events begin at `x0` \[s\].
    pub(super) events: Vec<f64>,
    pub(super) steps: usize,
    /// The end of the run \[s\].
    pub(super) reached: f64,
    pub(super) seconds: f64,
    pub(super) failure: Option<String>,
}

impl Cycles {
    /// The mean time between events, and its standard deviation \[s\].
    fn recurrence(&self) -> [f64; 2] {
        let settled = self.events.get(SETTLING..).unwrap_or(&[]);
        let gaps = || settled.windows(2).map(|pair| pair[1] - pair[0]);
        let count = gaps().count() as f64;
        let mean = gaps().sum::<f64>() / count;
        let variance = gaps().map(|gap| (gap - mean).powi(2)).sum::<f64>() / count;
        [mean, variance.sqrt()]
    }

    /// The time of event number `number`, counted from 1 \[s\].
    fn event(&self, number: usize) -> f64 {
        let time = number.checked_sub(1).and_then(|k| self.events.get(k));
        time.copied().unwrap_or(f64::NAN)
    }

    pub(super) fn print(&self) {
        let [mean, spread] = self.recurrence();
        println!(
            "  {:<8} {:<22} motion {:<4} {:>6.0e}: {} events to {:.3e} s, the first at {:.1} s, the last \
             at {:.1} s, every {mean:.1} +- {spread:.1} s; {} steps, {:.1} s {}",
            self.body,
            self.scheme,
            self.motion,
            self.tolerance,
            self.events.len(),
            self.reached,
            self.event(1),
            self.event(self.events.len()),
            self.steps,
            self.seconds,
            self.failure.as_deref().unwrap_or("")
        );
    }
}

/// One table of the runs, and one of all events.
pub(crate) fn write(all: &[Cycles], output: &Output) -> Result<(), Problem> {
    let columns = "body,scheme,motion,tolerance,events,first,last,recurrence,spread,steps,reached,seconds,failure";
    let rows = all.iter().map(|run| {
        let [mean, spread] = run.recurrence();
        [
            run.body.into(),
            run.scheme.clone(),
            digits(run.motion),
            digits(run.tolerance),
            run.events.len().to_string(),
            digits(run.event(1)),
            digits(run.event(run.events.len())),
            digits(mean),
            digits(spread),
            run.steps.to_string(),
            digits(run.reached),
            digits(run.seconds),
            run.failure.clone().unwrap_or_default(),
        ]
    });
    output.table("slow-cycles.csv", columns, rows)?;
    let rows = all.iter().flat_map(|run| {
        run.events.iter().enumerate().map(|(number, &time)| {
            [
                run.body.into(),
                run.scheme.clone(),
                digits(run.motion),
                digits(run.tolerance),
                (number + 1).to_string(),
                digits(time),
            ]
        })
    });
    output.table(
        "slow-cycles-events.csv",
        "body,scheme,motion,tolerance,event,time",
        rows,
    )
}

/// The table of the report: the first run of a body has times, the others have errors against it.
pub(crate) fn table(all: &[Cycles]) -> Result<Table, Error> {
    let mut text = String::from(
        "| body | scheme | motion | tolerance | events | first \\[s\\] | tenth \\[s\\] | last of both \\[s\\] \
         | recurrence \\[s\\] | spread \\[s\\] | steps | time \\[s\\] |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    let mut reference: Option<&Cycles> = None;
    for run in all {
        let known = reference.filter(|known| known.body == run.body);
        if known.is_none() {
            reference = Some(run);
        }
        let scheme = if known.is_some() { "" } else { ", reference" };
        write!(
            text,
            "| {} | {}{scheme} | {} | {:.0e} | {} |",
            run.body,
            run.scheme,
            run.motion,
            run.tolerance,
            run.events.len()
        )?;
        let last = known.map_or(usize::MAX, |known| known.events.len());
        for number in [1, 10, last.min(run.events.len())] {
            let cell = match known {
                Some(known) => error(run.event(number) - known.event(number)),
                None => value(run.event(number)),
            };
            write!(text, " {cell} |")?;
        }
        let [mean, spread] = run.recurrence();
        let mean = match known {
            Some(known) => error(mean - known.recurrence()[0]),
            None => value(mean),
        };
        write!(text, " {mean} | {} | {}", value(spread), run.steps)?;
        if run.failure.is_some() {
            write!(text, ", gave up at {:.1e} s", run.reached)?;
        }
        writeln!(text, " | {:.0} |", run.seconds)?;
    }
    let name = NAME.into();
    Ok(Table { name, text })
}

fn value(seconds: f64) -> String {
    if seconds.is_nan() {
        "-".into()
    } else {
        format!("{seconds:.0}")
    }
}

fn error(seconds: f64) -> String {
    if seconds.is_nan() {
        "-".into()
    } else {
        format!("{:.1e}", seconds.abs())
    }
}
