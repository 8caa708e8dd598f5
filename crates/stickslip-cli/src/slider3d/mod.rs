//! The slider in three dimensions: command line, record and report.

mod run;

pub use run::run;
use std::num::NonZeroUsize;

use clap::Parser;
use serde_json::json;
use stickslip::fem::{Elastic, P1, Trace};
use stickslip::integrate::RunReport;
use stickslip::problems::pipping_slider::END;
use stickslip::record::VtkSeries;
use stickslip::{Simulation, Snapshot, StepFailure, Steps};

use crate::cli::{Problem, count, finite, fraction};
use crate::output::{Files, Output, number};
use crate::plot::{self, DARK, Map, PALE, Panel, Sheet};
use crate::probes::Probes;
use crate::progress::Progress;
use crate::slider::RECORDING;

const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const FRONT: &str = "front.png";
const SUMMARY: &str = "summary.json";

/// The number of times in the picture of the front.
const SHOWN: usize = 6;
/// The number of distinct colours from vertex to vertex.
const BETWEEN: usize = 6;
/// The slip rate [m/s] anywhere above which an event is under way and its front is recorded.
const UNDER_WAY: f64 = 1e-3;

/// A body of 5 m x 1 m x 1 m, moved obliquely at its top, that slides on a velocity-weakening patch with a
/// strengthening rim
#[derive(Debug, Parser)]
pub struct Arguments {
    /// Uniform refinements of five unit cubes
    #[arg(long, value_name = "J", default_value_t = 2, value_parser = clap::value_parser!(u8).range(0..=5))]
    pub refinements: u8,
    /// The angle of the motion off the long side [degrees]
    #[arg(long, value_name = "ANGLE", default_value_t = 20.0, value_parser = finite)]
    pub degrees: f64,
    /// Time steps in the whole 15 s
    #[arg(long, value_name = "N", default_value = "10000", value_parser = count)]
    pub steps: NonZeroUsize,
    /// The share of the 15 s after which to stop
    #[arg(long, value_name = "FRACTION", default_value_t = 0.8, value_parser = fraction)]
    pub until: f64,
    /// Write every K-th step as VTU files, 0 for none
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub vtu_every: usize,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// The record of a run.
pub struct Watched {
    /// The middle of the bottom: time, slip and velocity along the long side and across, state, the largest slip rate
    /// anywhere, and that of the vertex.
    probes: Probes<3, 8>,
    front: Front,
}

/// The slip rates of the contact while the first event is under way, by time \[s\].
#[derive(Default)]
struct Front {
    rates: Vec<(f64, Vec<f64>)>,
    /// Whether the event is over.
    passed: bool,
}

/// Takes the steps, and records the middle of the bottom and the first event.
///
/// # Errors
/// Files that cannot be written; [`report`] returns the failure of the run.
pub fn take(
    arguments: &Arguments,
    simulation: &mut Simulation<3>,
    (space, bottom): (&P1<3>, &Trace<3>),
    elastic: Elastic,
) -> Result<(Watched, Result<RunReport, StepFailure>), Problem> {
    let start = simulation.snapshot();
    let from = |place: &[f64; 2], x: [f64; 3]| (x[0] - place[0]).hypot(x[1] - place[1]);
    let mut probes = Probes::new(&start, [[2.5, 0.5]], from, |at, k| {
        let contact = at.contact(0);
        let (u, v) = (contact.slip_vector(k), contact.slip_velocity(k));
        let (state, rates) = (contact.state(k), [at.max_slip_rate(), contact.slip_rate(k)]);
        [at.time, u[0], u[1], v[0], v[1], state, rates[0], rates[1]]
    });
    let mut front = Front::default();
    let plan = Steps::constant(END / arguments.steps.get() as f64);
    let end = arguments.until * END;
    let plan = plan.until(end);
    let mut progress = Progress::default();
    let bar = (&mut progress, end);
    if arguments.vtu_every > 0 {
        let folder = arguments.files.folder("slider3d");
        std::fs::create_dir_all(&folder)?;
        let mut series = VtkSeries::new(&start, space, folder.join("slider3d"))?
            .with_stress(move |_, _| elastic)
            .with_contact(&start, 0, bottom)?
            .every(arguments.vtu_every)?;
        let run = probes.run(simulation, &plan, bar, |at| {
            front.see(&at);
            series.record(&at)
        });
        series.finish()?;
        return Ok((Watched { probes, front }, run));
    }
    let run = probes.run(simulation, &plan, bar, |at| front.see(&at));
    Ok((Watched { probes, front }, run))
}

impl Front {
    fn see(&mut self, at: &Snapshot<'_, 3>) {
        let contact = at.contact(0);
        if at.max_slip_rate() > UNDER_WAY && !self.passed {
            let rates = (0..contact.len()).map(|k| contact.slip_rate(k));
            self.rates.push((at.time, rates.collect()));
        }
        // A front that goes to and fro is not over in between.
        let last = self.rates.last();
        self.passed |= last.is_some_and(|(time, _)| at.time > time + 0.02);
    }

    /// The times of the front in the picture, evenly spread, and its slip rates then.
    fn shown(&self) -> Vec<&(f64, Vec<f64>)> {
        let last = self.rates.len().saturating_sub(1);
        let chosen = (0..SHOWN.min(self.rates.len())).map(|n| last * n / (SHOWN - 1));
        chosen.map(|n| &self.rates[n]).collect()
    }
}

/// Writes and prints the results; fails if the run did.
///
/// # Errors
/// Files that cannot be written, and the failure of the run.
pub fn report(
    arguments: &Arguments,
    space: &P1<3>,
    bottom: &Trace<3>,
    (Watched { probes, front }, run): (Watched, Result<RunReport, StepFailure>),
) -> Result<(), Problem> {
    let output = arguments
        .files
        .create("slider3d", &[HISTORY, PICTURE, FRONT, SUMMARY])?;
    let (probe, cost) = (&probes.each[0], probes.cost);
    let rows = (probe.rows.iter()).map(|row| row[..7].iter().copied().map(number));
    let columns = "time,slip_x,slip_y,velocity_x,velocity_y,alpha,max_slip_rate";
    output.table(HISTORY, columns, rows)?;
    plot::draw(
        &output.path(PICTURE),
        &[
            Panel::new("time [s]", "slip [mm]")
                .with("along the long side", DARK, 3, probe.curve(1, 1e3))
                .with("across", PALE, 3, probe.curve(2, 1e3)),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 3, probe.curve(7, 1.0)),
        ],
    )?;
    let shown = front.shown();
    draw_front(&output, bottom, &shown)?;
    let origin = front.rates.first().and_then(|(_, rates)| {
        let fastest = (0..rates.len()).max_by(|&a, &b| rates[a].total_cmp(&rates[b]))?;
        Some(bottom.points()[fastest])
    });
    let (steps, milliseconds) = (cost.steps, probes.milliseconds_per_step());
    let slips = probe.times((RECORDING.slip, RECORDING.slip), |row| row[7]);
    let events = probe.times(RECORDING.event, |row| row[7]);
    let (first, [time, x, y, ..]) = (slips.first(), probe.last());
    output.json(
        SUMMARY,
        &json!({
            "vertices": space.vertex_count(),
            "cells": space.mesh().cell_count(),
            "contact_vertices": bottom.vertices().len(),
            "steps": steps,
            "time_end": time,
            "first_slip_time": first,
            "event_times": events,
            "slip_end": [x, y],
            "peak_slip_rate": cost.peak_slip_rate,
            "front_origin": origin.map(|x| [x[0], x[1]]),
            "front_times": shown.iter().map(|(time, _)| *time).collect::<Vec<_>>(),
            "milliseconds_per_step": milliseconds,
            "failure": run.as_ref().err().map(ToString::to_string),
        }),
    )?;
    say!(
        "{} vertices, {} on the bottom, {steps} steps to t = {:.5} s, {milliseconds:.3} ms a step",
        space.vertex_count(),
        bottom.vertices().len(),
        time
    )?;
    say!("first slip in the middle: {first:.6?} s; events at t = {events:.5?} s")?;
    if let Some(x) = origin {
        say!(
            "the first front begins at x = {:.3} m, y = {:.3} m",
            x[0],
            x[1]
        )?;
    }
    say!(
        "slip {:.4e} m along, {:.4e} m across; largest slip rate {:.3e} m/s",
        x,
        y,
        cost.peak_slip_rate
    )?;
    say!("{}", output.told(&[HISTORY, PICTURE, FRONT, SUMMARY]))?;
    run.map_err(Into::into).map(|_| ())
}

/// The slip rate on the bottom at the times shown.
fn draw_front(
    output: &Output,
    bottom: &Trace<3>,
    shown: &[&(f64, Vec<f64>)],
) -> Result<(), Problem> {
    let axis = |c: usize| {
        let mut places: Vec<f64> = bottom.points().iter().map(|x| x[c]).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    };
    let (coarse, y) = (axis(0), axis(1));
    // Between vertices along x the logarithm is linear, as the map has it along y.
    let x: Vec<f64> = (coarse.windows(2))
        .flat_map(|pair| {
            (0..BETWEEN).map(|n| pair[0] + (pair[1] - pair[0]) * n as f64 / BETWEEN as f64)
        })
        .chain(coarse.last().copied())
        .collect();
    let place = |of: &[f64], value: f64| of.partition_point(|&other| other < value);
    let fields: Vec<Vec<f64>> = (shown.iter())
        .map(|(_, rates)| {
            let mut logarithms = vec![0.0; coarse.len() * y.len()];
            for (point, rate) in bottom.points().iter().zip(rates) {
                let vertex = place(&coarse, point[0]) * y.len() + place(&y, point[1]);
                logarithms[vertex] = rate.max(f64::MIN_POSITIVE).ln();
            }
            let between = |i: usize, k: usize| {
                let (left, part) = (i / BETWEEN, (i % BETWEEN) as f64 / BETWEEN as f64);
                let right = (left + 1).min(coarse.len() - 1);
                let [from, to] = [left, right].map(|i| logarithms[i * y.len() + k]);
                (from + (to - from) * part).exp()
            };
            let places = (0..x.len()).flat_map(|i| (0..y.len()).map(move |k| (i, k)));
            places.map(|(i, k)| between(i, k)).collect()
        })
        .collect();
    let maps = shown.iter().zip(&fields).map(|((time, _), values)| {
        let map = Map {
            names: ["x [m]", "y [m]", "slip rate [m/s]"],
            x: &x,
            y: &y,
            values,
            range: (1e-6, 1e-2),
            downward: false,
        };
        (format!("t = {time:.5} s"), map)
    });
    let sheet = Sheet::new(maps.collect()).or_says(format!(
        "Nothing has slipped faster than {UNDER_WAY:e} m/s: there is no front up to the end of the run."
    ));
    plot::draw(&output.path(FRONT), &sheet)
}
