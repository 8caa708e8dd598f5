//! BP1-QD: earthquake cycles on a fault in a half space.

use crate::onsets::Onsets;
use std::time::Instant;

use serde_json::json;
use stickslip::bie::Fault;
use stickslip::integrate::Stepper;
use stickslip::problems::bp1::{AGING, MEDIUM, NORMAL_STRESS, PLATE_RATE};
use stickslip::{Run, Snapshot};

use super::{Arguments, Failed, Station, YEAR};
use crate::cli::expect;
use crate::output::{Output, digits};
use crate::plot::{self, DARK, PALE, Panel, Points};

/// The slip rate at which an event begins and ends at its station [m/s].
const EVENT: f64 = 1e-2;
/// The depth at which events are detected \[m\].
const HYPOCENTRE: f64 = 7.5e3;
/// The time of the first event by boundary element codes in a half space \[years\].
const FIRST_EVENT: f64 = 196.1;
/// The prediction of `V theta^(b/a) = const` at the surface at constant stress: time \[s\], log10 V.
const START: [[f64; 2]; 2] = [[255.0, -9.020_421], [4095.0, -9.269_075]];

/// The recorded quantities of a run.
struct Watched {
    surface: Station,
    middle: Station,
    events: Onsets,
    /// Slip at the surface and in the middle at the quietest time of the middle before each event, and since the last
    /// one.
    slips: Vec<[f64; 2]>,
    quiet: [f64; 2],
    /// The smallest log10 V in the middle since the last event; the last value during an event.
    smallest: f64,
    /// The largest log10 V in the middle of each event.
    peaks: Vec<f64>,
    start: Vec<f64>,
    /// Time \[years\], log10 of the largest slip rate.
    largest: Points,
    /// Time, slip, log10 V and stress in the middle.
    rows: Vec<[f64; 4]>,
    profiles: Vec<Profile>,
    next_profile: f64,
    steps: usize,
}

/// Slip by depth.
struct Profile {
    seismic: bool,
    slip: Vec<f64>,
}

impl Watched {
    fn new(fault: &Fault) -> Self {
        Self {
            surface: Station::new(fault.cells(), 0.0),
            middle: Station::new(fault.cells(), HYPOCENTRE),
            events: Onsets::new(EVENT, 0.1 * EVENT),
            slips: Vec::new(),
            quiet: [0.0; 2],
            smallest: f64::INFINITY,
            peaks: Vec::new(),
            start: Vec::new(),
            largest: Vec::new(),
            rows: Vec::new(),
            profiles: Vec::new(),
            next_profile: 0.0,
            steps: 0,
        }
    }

    fn see(&mut self, at: &Snapshot<'_, 1>) {
        self.steps += 1;
        let contact = at.contact(0);
        let (log_rate, largest) = (self.middle.log_rate(&contact), contact.max_slip_rate());
        let slips = [self.surface.slip(&contact), self.middle.slip(&contact)];
        self.events.record(at.time, 10_f64.powf(log_rate));
        if self.events.times().len() > self.slips.len() {
            self.slips.push(self.quiet);
            self.peaks.push(log_rate);
        }
        // An event that lasts is counted up to now.
        if log_rate <= self.smallest || log_rate >= EVENT.log10() {
            (self.smallest, self.quiet) = (log_rate, slips);
        }
        if let Some(peak) = self.peaks.last_mut() {
            *peak = peak.max(log_rate);
        }
        if START.iter().any(|[time, _]| *time == at.time) {
            self.start.push(self.surface.log_rate(&contact));
        }
        self.largest.push((at.time / YEAR, largest.log10()));
        self.rows
            .push([at.time, slips[1], log_rate, self.middle.stress(&contact)]);
        let seismic = largest >= EVENT;
        let begins = seismic && self.profiles.last().is_some_and(|last| !last.seismic);
        if at.time >= self.next_profile || begins {
            self.next_profile = at.time + if seismic { 1.0 } else { 5.0 * YEAR };
            let slip = (0..contact.len()).map(|k| contact.slip(k)).collect();
            self.profiles.push(Profile { seismic, slip });
        }
    }

    /// The net slip in each event including creep before and after it: between the quietest times.
    fn slip_per_event(&self) -> [Vec<f64>; 2] {
        let next = self.slips.iter().skip(1).chain([&self.quiet]);
        let net: Vec<_> = (self.slips.iter().zip(next))
            .map(|(begin, end)| [end[0] - begin[0], end[1] - begin[1]])
            .collect();
        [0, 1].map(|n| net.iter().map(|slip| slip[n]).collect())
    }
}

/// Takes the steps, and writes and prints the results.
pub(super) fn run(
    arguments: &Arguments,
    fault: &Fault,
    motion: &mut dyn Stepper<1>,
) -> Result<(), Failed> {
    const FILES: [&str; 4] = ["history.csv", "slip.png", "slip_rate.png", "summary.json"];
    let output = Output::create(&arguments.out, &FILES)?;
    let mut watched = Watched::new(fault);
    let clock = Instant::now();
    let steps = arguments.steps().stopping_at(START.map(|[time, _]| time));
    let report = motion.run(&steps, |at| watched.see(&at))?;
    let seconds = clock.elapsed().as_secs_f64();
    let [surface, middle] = watched.slip_per_event();
    let times: Vec<f64> = watched
        .events
        .times()
        .iter()
        .map(|time| time / YEAR)
        .collect();
    output.table(
        FILES[0],
        "time,slip,log10_slip_rate,shear_stress",
        watched.rows.iter().map(|row| row.map(digits)),
    )?;
    draw(&output, [FILES[1], FILES[2]], fault, &watched)?;
    println!(
        "{:>12} {:>14} {:>14} {:>12}",
        "event years", "slip 0 km [m]", "7.5 km [m]", "log10 V"
    );
    for (n, time) in times.iter().enumerate() {
        println!(
            "{time:>12.3} {:>14.4} {:>14.4} {:>12.3}",
            surface[n], middle[n], watched.peaks[n]
        );
    }
    output.json(
        FILES[3],
        &json!({
            "problem": "bp1",
            "cell": fault.cells().length(),
            "method": format!("{:?}", arguments.method),
            "tolerance": arguments.adaptive,
            "event_times_years": times,
            "slip_per_event": { "0": surface, "7.5": middle },
            "peak_log10_slip_rate": watched.peaks,
            "start_log10_slip_rate": watched.start,
            "steps": watched.steps,
            "rejected": report.rejected + report.failed,
            "seconds": seconds,
        }),
    )?;
    println!(
        "{} cells, {} steps, {} taken back, {seconds:.1} s; {} in {}",
        fault.cells().count(),
        watched.steps,
        report.rejected + report.failed,
        FILES.join(", "),
        output.folder().display()
    );
    check(arguments, &watched, &times, &middle)
}

/// Checks the initial state for any cells, the first event for cells that resolve it, and cycles, which repeat from the
/// third event on.
fn check(
    arguments: &Arguments,
    watched: &Watched,
    times: &[f64],
    middle: &[f64],
) -> Result<(), Failed> {
    if !arguments.is_accurate() {
        return Ok(());
    }
    for ([time, exact], found) in START.iter().zip(&watched.start) {
        expect(&format!("log10 V after {time} s"), *found, *exact, 1e-5)?;
    }
    if fine(arguments) && arguments.end() >= 200.0 * YEAR {
        let first = times.first().copied().unwrap_or(f64::NAN);
        expect("years to the first event", first, FIRST_EVENT, 0.7)?;
    }
    for (n, pair) in times.windows(2).enumerate().skip(2) {
        let plate = PLATE_RATE * (pair[1] - pair[0]) * YEAR;
        expect("slip of an event", middle[n], plate, 0.005 * plate)?;
    }
    Ok(())
}

/// Whether cells are at most a third of the cohesive zone length `mu L/(b sigma)`.
fn fine(arguments: &Arguments) -> bool {
    3.0 * arguments.cell() <= MEDIUM.shear_modulus * AGING.slip_distance / (0.015 * NORMAL_STRESS)
}

/// Draws slip against depth every 5 years, and every second in events, and the largest slip rate in time.
fn draw(
    output: &Output,
    [slip, rate]: [&str; 2],
    fault: &Fault,
    watched: &Watched,
) -> Result<(), Failed> {
    let depths = fault.cells().map(|z| -z / 1e3);
    let mut panel = Panel::new("slip [m]", "depth [km]");
    for (seismic, label, color) in [
        (false, "every 5 years", DARK),
        (true, "every second of events", PALE),
    ] {
        let profiles = watched
            .profiles
            .iter()
            .filter(|profile| profile.seismic == seismic);
        for (n, profile) in profiles.enumerate() {
            let curve = profile.slip.iter().copied().zip(depths.iter().copied());
            let curve = curve.filter(|(_, depth)| *depth >= -24.0).collect();
            panel = panel.with(if n == 0 { label } else { "" }, color, 2, curve);
        }
    }
    plot::draw(&output.path(slip), &[panel])?;
    let panel = Panel::new("time [years]", "log10 of the largest slip rate [m/s]");
    let panel = panel.with("", DARK, 3, watched.largest.clone());
    plot::draw(&output.path(rate), &[panel])
}
