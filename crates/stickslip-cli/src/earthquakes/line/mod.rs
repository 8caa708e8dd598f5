//! Earthquake cycles on a line of cells, the problems BP1, BP2 and BP3: record and report.

mod write;

use std::ops::ControlFlow;
use std::time::Instant;

use serde_json::{Value, json};
use stickslip::bie::Cells;
use stickslip::integrate::Stepper;
use stickslip::problems::bp1::MEDIUM;
use stickslip::record::{EventCatalogue, SeasPoint};
use stickslip::{Run, Snapshot};

use super::off_fault::{self, Plan};
use super::profiles::Profiles;
use super::seas::{Places, files};
use super::space_time::SpaceTime;
use super::{Arguments, Failed, Station, YEAR};
use crate::onsets::Onsets;
use crate::plot::Points;
use crate::progress::Progress;

/// The slip rate at which an event begins and ends at its station [m/s].
pub(super) const EVENT: f64 = 1e-2;
/// The stations, the surface and the one that detects events: distance from the surface \[m\].
const STATIONS: [f64; 2] = [0.0, 7.5e3];
/// The stations of the files of the benchmark \[km\].
const FILED: [f64; 12] = [
    0.0, 2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0, 25.0, 30.0, 35.0,
];
/// The intervals of slip contours between events and in events \[s\].
const INTERVALS: [f64; 2] = [5.0 * YEAR, 1.0];
/// The part of the fault in pictures \[km\].
const SHOWN: f64 = 24.0;

/// Slip \[m\] and normal stress \[Pa\] of each station.
type Values = [[f64; 2]; 2];

/// A run, and its record.
pub(super) struct Line<'a> {
    cells: &'a Cells,
    /// Times \[s\] at which the slip rate at the surface is reported.
    starts: &'a [f64],
    off_fault: Option<Plan<1>>,
    /// Whether normal stress follows slip.
    follows: bool,
    stations: [Station; 2],
    events: Onsets,
    /// At the quietest time of the middle before each event, and since the last one.
    before: Vec<Values>,
    quiet: Values,
    /// The smallest log10 V in the middle since the last event; the last value during an event.
    smallest: f64,
    /// The largest log10 V in the middle of each event.
    pub(super) peaks: Vec<f64>,
    /// log10 V at the surface at the times of the start.
    pub(super) start: Vec<f64>,
    /// The extremes of the normal stress of each station \[Pa\].
    extremes: [[f64; 2]; 2],
    /// Time \[years\], log10 of the largest slip rate.
    largest: Points,
    /// Time, slip, log10 V, shear and normal stress in the middle.
    rows: Vec<[f64; 5]>,
    profiles: Profiles,
    rates: SpaceTime,
    steps: usize,
}

impl<'a> Line<'a> {
    pub(super) fn new(arguments: &Arguments, cells: &'a Cells, starts: &'a [f64]) -> Self {
        // From below, depth upwards.
        let line = (0..cells.count())
            .rev()
            .map(|k| (k, -cells.center(k) / 1e3));
        let line: Vec<_> = line.filter(|(_, depth)| *depth >= -SHOWN).collect();
        Self {
            cells,
            starts,
            off_fault: None,
            follows: false,
            stations: STATIONS.map(|z| Station::on_line(cells, z)),
            events: Onsets::new(EVENT, 0.1 * EVENT),
            before: Vec::new(),
            quiet: [[0.0; 2]; 2],
            smallest: f64::INFINITY,
            peaks: Vec::new(),
            start: Vec::new(),
            extremes: [[f64::INFINITY, f64::NEG_INFINITY]; 2],
            largest: Vec::new(),
            rows: Vec::new(),
            rates: SpaceTime::new(&line, arguments.end()),
            profiles: Profiles::new(line, INTERVALS),
            steps: 0,
        }
    }

    /// Writes displacement off the fault, too.
    pub(super) fn with_off_fault(mut self, plan: Plan<1>) -> Self {
        self.off_fault = Some(plan);
        self
    }

    /// Reports the normal stress, too.
    pub(super) fn with_normal_stress(mut self) -> Self {
        self.follows = true;
        self
    }

    fn see(&mut self, at: &Snapshot<'_, 1>) {
        self.steps += 1;
        let contact = at.contact(0);
        let [surface, middle] = &self.stations;
        let (log_rate, largest) = (middle.log_rate(&contact), contact.max_slip_rate());
        let values = [surface, middle]
            .map(|station| [station.slip(&contact), station.normal_stress(&contact)]);
        self.events.record(at.time, 10_f64.powf(log_rate));
        if self.events.times().len() > self.before.len() {
            self.before.push(self.quiet);
            self.peaks.push(log_rate);
        }
        // An event that lasts is counted up to now.
        if log_rate <= self.smallest || log_rate >= EVENT.log10() {
            (self.smallest, self.quiet) = (log_rate, values);
        }
        if let Some(peak) = self.peaks.last_mut() {
            *peak = peak.max(log_rate);
        }
        if self.starts.contains(&at.time) {
            self.start.push(surface.log_rate(&contact));
        }
        for ([low, high], [_, stress]) in self.extremes.iter_mut().zip(values) {
            (*low, *high) = (low.min(stress), high.max(stress));
        }
        self.largest.push((at.time / YEAR, largest.log10()));
        let [slip, normal] = values[1];
        self.rows
            .push([at.time, slip, log_rate, middle.stress(&contact), normal]);
        self.profiles.record(at.time, largest >= EVENT, &contact);
        self.rates.record(at.time, &contact);
    }

    /// The onsets of the events \[years\].
    pub(super) fn times(&self) -> Vec<f64> {
        self.events.times().iter().map(|time| time / YEAR).collect()
    }

    /// The net slip in each event at a station, including creep before and after it: between the quietest times.
    pub(super) fn slip_per_event(&self, station: usize) -> Vec<f64> {
        let next = self.before.iter().skip(1).chain([&self.quiet]);
        let pairs = self.before.iter().zip(next);
        pairs
            .map(|(begin, end)| end[station][0] - begin[station][0])
            .collect()
    }

    fn stations(&self) -> Value {
        let each = self.stations.iter().enumerate().map(|(n, station)| {
            let before: Vec<f64> = self.before.iter().map(|values| values[n][1]).collect();
            json!({
                "depth_km": station.position[1] / 1e3,
                "slip_per_event": self.slip_per_event(n),
                "sigma_before": before,
                "sigma_range": self.extremes[n],
            })
        });
        each.collect()
    }

    /// The places of the files of the benchmark.
    fn places(&self) -> Places<'static> {
        Places {
            stations: FILED.map(|z| SeasPoint::Line(1e3 * z)).to_vec(),
            lines: vec![self.cells.map(SeasPoint::Line)],
            names: (100.0, 3),
            normal_stress: self.follows,
            pore_fluid: false,
            shear_modulus: MEDIUM.shear_modulus,
            event: (EVENT, INTERVALS),
            directions: &[[1.0, 0.0]],
        }
    }

    /// Takes the steps, and writes and prints the results. `settings` are added to the summary.
    pub(super) fn run(
        &mut self,
        arguments: &Arguments,
        settings: Value,
        motion: &mut dyn Stepper<1>,
    ) -> Result<(), Failed> {
        const FILES: [&str; 6] = [
            "events.csv",
            "history.csv",
            "slip.png",
            "slip_rate.png",
            "slip_rate_map.png",
            "summary.json",
        ];
        let output = arguments.files.create("earthquakes", &FILES)?;
        let mut files = files(arguments, self.places(), &motion.snapshot())?;
        let plan = self.off_fault.take();
        let plan = plan.map(|plan| {
            off_fault::Record::new(arguments, plan, output.folder(), &motion.snapshot())
        });
        let mut off_fault = plan.transpose()?;
        let (clock, mut progress) = (Instant::now(), Progress::default());
        let rates = [EVENT, 0.1 * EVENT];
        let mut catalogue =
            EventCatalogue::new(&motion.snapshot(), 0, rates, MEDIUM.shear_modulus, 100)?;
        let steps = arguments.steps().stopping_at(self.starts.iter().copied());
        let end = arguments.end();
        let report = motion.run(&steps, |at| {
            self.see(&at);
            catalogue.record(&at);
            progress.show(at.time / end, || {
                let (years, rate) = (at.time / YEAR, at.max_slip_rate());
                format!("{years:.2} years, step {}, {rate:.1e} m/s", at.step)
            });
            if let Some(off_fault) = &mut off_fault {
                off_fault.record(&at)?;
            }
            (files.as_mut()).map_or(ControlFlow::Continue(()), |files| files.record(&at))
        })?;
        drop(progress);
        if let Some(off_fault) = off_fault {
            off_fault.finish(&motion.snapshot())?;
        }
        if let Some(files) = files {
            files.finish()?;
        }
        let seconds = clock.elapsed().as_secs_f64();
        let [events, others @ ..] = FILES;
        // One under way at the end has no arrest.
        let under_way = catalogue.under_way(&motion.snapshot());
        output.events(events, catalogue.events().iter().chain(&under_way))?;
        self.write(&output, others)?;
        let [surface, middle] = [0, 1].map(|n| self.slip_per_event(n));
        let times = self.times();
        let mut summary = json!({
            "problem": arguments.problem.name(),
            "cell": self.cells.length(),
            "method": format!("{:?}", arguments.method),
            "tolerance": arguments.adaptive,
            "event_times_years": times,
            "slip_per_event": { "0": surface, "7.5": middle },
            "peak_log10_slip_rate": self.peaks,
            "start_log10_slip_rate": self.start,
            "steps": self.steps,
            "rejected": report.rejected + report.failed,
            "seconds": seconds,
        });
        if self.follows {
            summary["stations"] = self.stations();
        }
        if let (Some(summary), Value::Object(settings)) = (summary.as_object_mut(), settings) {
            summary.extend(settings);
        }
        output.json(FILES[5], &summary)?;
        say!(
            "{:>12} {:>14} {:>14} {:>12}",
            "event years",
            "slip 0 km [m]",
            "7.5 km [m]",
            "log10 V"
        )?;
        for (n, time) in times.iter().enumerate() {
            say!(
                "{time:>12.3} {:>14.4} {:>14.4} {:>12.3}",
                surface[n],
                middle[n],
                self.peaks[n]
            )?;
        }
        say!(
            "{} events anywhere, {} cells, {} steps, {} taken back, {seconds:.1} s; {}",
            catalogue.events().len() + usize::from(under_way.is_some()),
            self.cells.count(),
            self.steps,
            report.rejected + report.failed,
            output.told(&FILES)
        )?;
        Ok(())
    }
}
