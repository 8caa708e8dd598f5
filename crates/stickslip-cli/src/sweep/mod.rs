//! The sweep: command line, sets of parameters, and results as a table and a picture.

mod run;
mod runs;
pub use run::run;
pub use runs::Runs;
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use clap::Parser;
use serde::{Deserialize, Serialize};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::FRICTION;

use crate::cli::{Problem, count, positive};
use crate::output::{Files, Output, number};
use crate::plot::{self, Scatter};
use crate::progress::Progress;

/// Parameter sweep: sets of (a, b, L) on the paper's slider, reduced once and shared by all threads. Writes sweep.csv,
/// sweep.png and sweep.svg.
#[derive(Debug, Clone, Parser)]
#[command(name = "sweep")]
pub struct Arguments {
    /// Uniform refinements of the mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=10))]
    pub refinements: u8,
    /// Time steps in the whole 15 s
    #[arg(long, value_name = "N", default_value = "10000", value_parser = count)]
    pub steps: NonZeroUsize,
    /// Give a set up at a failed step instead of splitting it into substeps
    #[arg(long)]
    pub no_bridging: bool,
    /// Sets of parameters
    #[arg(long, value_name = "N", default_value = "200", value_parser = count)]
    sets: NonZeroUsize,
    /// Number of runs at a time [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = count)]
    threads: Option<NonZeroUsize>,
    /// Keep the modes of the body up to this frequency [Hz]
    #[arg(long, value_name = "HZ", default_value_t = 120.0, value_parser = positive)]
    pub frequency: f64,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

const TABLE: &str = "sweep.csv";
const PICTURE: &str = "sweep.png";

/// The result of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// The onset times of the events at the middle \[s\].
    pub events: Vec<f64>,
    /// The largest slip rate at any vertex [m/s].
    pub peak_slip_rate: f64,
    /// The failure of an incomplete run.
    pub lost: Option<String>,
}

impl Seen {
    /// The mean time between events \[s\], if there are two.
    pub fn recurrence(&self) -> Option<f64> {
        match self.events[..] {
            [first, .., last] => Some((last - first) / (self.events.len() - 1) as f64),
            _ => None,
        }
    }

    fn status(&self) -> String {
        match (&self.lost, self.events.len()) {
            (Some(lost), _) => format!("lost: {lost}"),
            (None, 0) => "no event".into(),
            (None, 1) => "one event".into(),
            (None, _) => "events recur".into(),
        }
    }
}

/// Laws that fill the ranges of `a`, `b - a` and `L` evenly, the first that of the paper, with `b < 2 a` in each.
///
/// Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018): multiples of the powers of
/// `1/g`, with `g^4 = g + 1`.
fn laws(count: usize) -> Vec<DieterichRuina> {
    const G: f64 = 1.220_744_084_605_759_5;
    let share = |n: usize, k: i32| (0.5 + n as f64 * G.powi(-k)).fract();
    let between = |low: f64, high: f64, share: f64| low + (high - low) * share;
    let law = |n: usize| {
        let a = between(0.008, 0.014, share(n, 1));
        DieterichRuina {
            a,
            b: a + between(0.001, 0.0075, share(n, 2)),
            slip_distance: 10_f64.powf(between(-5.5, -4.5, share(n, 3))),
            ..FRICTION
        }
    };
    std::iter::once(FRICTION)
        .chain((1..).map(law))
        .take(count)
        .collect()
}

impl Arguments {
    /// The sets of parameters.
    pub fn laws(&self) -> Vec<DieterichRuina> {
        laws(self.sets.get())
    }

    /// The number of simultaneous runs; `default` if not given.
    pub fn threads(&self, default: usize) -> usize {
        self.threads.map_or(default, NonZeroUsize::get)
    }

    /// Opens the output files.
    pub fn output(&self) -> Result<Table, Problem> {
        let output = self.files.create("sweep", &[TABLE, PICTURE])?;
        Ok(Table { output })
    }
}

/// Takes all runs in threads; returns their results in order.
pub fn in_threads(
    threads: usize,
    laws: &[DieterichRuina],
    take: impl Fn(DieterichRuina) -> Seen + Sync,
) -> Result<Vec<Seen>, Problem> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(vec![None; laws.len()]));
    let progress = Mutex::new((0, Progress::default()));
    thread::scope(|scope| {
        for _ in 0..threads.min(laws.len()) {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    let Some(law) = laws.get(k) else { return };
                    let seen = take(*law);
                    if let Ok(mut done) = done.lock() {
                        done[k] = Some(seen);
                    }
                    if let Ok(mut progress) = progress.lock() {
                        let (count, bar) = &mut *progress;
                        *count += 1;
                        let (taken, all) = (*count, laws.len());
                        bar.show(taken as f64 / all as f64, || {
                            format!("{taken} of {all} sets")
                        });
                    }
                }
            });
        }
    });
    let done = done.into_inner().map_err(|_| "a run has panicked")?;
    let done: Option<Vec<Seen>> = done.into_iter().collect();
    Ok(done.ok_or("a run is missing")?)
}

/// The table and the pictures of a sweep.
pub struct Table {
    output: Output,
}

impl Table {
    /// Writes the results of runs. A failed point has its row and does not fail the others. Only if all points fail,
    /// the sweep fails.
    pub fn write(&self, rows: Vec<(DieterichRuina, Seen)>) -> Result<(), Problem> {
        write(&self.output, &rows)?;
        let lost = rows.iter().filter_map(|(_, seen)| seen.lost.as_ref());
        match (lost.clone().count(), lost.clone().next()) {
            (count, Some(first)) if count == rows.len() => Err(first.clone().into()),
            _ => Ok(()),
        }
    }
}

fn write(output: &Output, rows: &[(DieterichRuina, Seen)]) -> Result<(), Problem> {
    output.table(
        TABLE,
        "a,b,slip_distance,recurrence,peak_slip_rate,status",
        rows.iter().map(|(law, seen)| {
            let recurrence = seen.recurrence().unwrap_or(f64::NAN);
            let numbers = [
                law.a,
                law.b,
                law.slip_distance,
                recurrence,
                seen.peak_slip_rate,
            ];
            numbers
                .map(number)
                .into_iter()
                .chain([seen.status().into()])
        }),
    )?;
    let scatter = |name, value: fn(&Seen) -> Option<f64>| Scatter {
        names: ["b − a", "slip distance L [m]", name],
        points: (rows.iter())
            .map(|(law, seen)| {
                let shown = value(seen).filter(|_| seen.lost.is_none());
                (law.b - law.a, law.slip_distance, shown)
            })
            .collect(),
    };
    let peak = |seen: &Seen| Some(seen.peak_slip_rate).filter(|&rate| rate > 0.0);
    let picture = [
        scatter("recurrence [s], ring: none", Seen::recurrence),
        scatter("peak slip rate [m/s]", peak),
    ];
    plot::draw(&output.path(PICTURE), &picture[..])?;
    let count = |begin: &str| {
        let rows = rows.iter();
        rows.filter(|(_, seen)| seen.status().starts_with(begin))
            .count()
    };
    say!(
        "{} sets: events recur in {}, {} with one event, {} without, {} lost",
        rows.len(),
        count("events"),
        count("one"),
        count("no"),
        count("lost")
    )?;
    say!("{}", output.told(&[TABLE, PICTURE]))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_are_valid_and_none_twice() {
        let laws = laws(300);
        assert_eq!(laws[0], FRICTION);
        for (k, law) in laws.iter().enumerate() {
            assert!(law.a < law.b && law.b < 2.0 * law.a, "{law:?}");
            assert!(!laws[..k].contains(law));
        }
    }

    #[test]
    fn recurrence_is_the_mean_time_between_events() {
        let seen = |events: &[f64]| Seen {
            events: events.to_vec(),
            peak_slip_rate: 1.0,
            lost: None,
        };
        assert_eq!(seen(&[1.0, 2.0, 5.0]).recurrence(), Some(2.0));
        assert_eq!(seen(&[1.0]).recurrence(), None);
        assert_eq!(seen(&[]).status(), "no event");
    }
}
