//! The report of BP8: stations, profiles, files and checks.

use std::ops::ControlFlow;
use std::time::Instant;

use serde_json::{Value, json};
use stickslip::bie::PlaneFault;
use stickslip::record::SeasPoint;
use stickslip::{ContactView, RungeKutta};

use super::super::fluid::Source;
use super::super::off_fault::{Plan, Record, WHOLE_SPACE};
use super::super::seas::{Places, files};
use super::super::watch::{self, Watch};
use super::super::{Arguments, DAY, Failed, Station};
use super::pressure::{self, TIMES};
use super::{MEDIUM, NORMAL};
use crate::output::Output;
use crate::plot::{self, COLORS, Panel, Points};
use crate::progress::Progress;

/// The stations along strike and down dip \[m\]; pictures show the first ones.
const STATIONS: [[f64; 2]; 9] = [
    [0.0, 0.0],
    [-200.0, 0.0],
    [200.0, 0.0],
    [0.0, -200.0],
    [0.0, 200.0],
    [200.0, 200.0],
    [-200.0, -200.0],
    [-200.0, 200.0],
    [200.0, -200.0],
];
/// The slip rate of an event [m/s]: this problem has none.
const EVENT: f64 = 1e-3;

/// The results of a run.
#[derive(Default)]
struct Shown {
    /// The pressures at both places of the check \[MPa\].
    pressures: Vec<[f64; 2]>,
    /// Slip \[m\] and pore pressure \[MPa\] along strike.
    profiles: Vec<[Points; 2]>,
    /// The largest number of cells without enough normal stress.
    least: usize,
    /// The largest log10 V and pore pressure \[Pa\].
    peaks: [f64; 2],
}

/// Takes the steps, writes and prints the results, and checks the pressure.
pub(super) fn run<const C: usize>(
    arguments: &Arguments,
    fault: &PlaneFault<C>,
    mut motion: RungeKutta<C>,
) -> Result<(), Failed> {
    const FILES: [&str; 4] = [
        "stations.csv",
        "stations.png",
        "profiles.png",
        "summary.json",
    ];
    let output = arguments.files.create("earthquakes", &FILES)?;
    let mut files = files(arguments, places(fault), &motion.snapshot())?;
    let plan = Plan::of_injection(fault, WHOLE_SPACE, EVENT)?;
    let mut off_fault = Record::new(arguments, plan, output.folder(), &motion.snapshot())?;
    let mut watches = STATIONS.map(|[x, y]| {
        let station = Station::on_plane(fault.cells(), [x, y]);
        Watch::new(station, format!("({x}, {y}) m"), &TIMES)
    });
    let mut shown = Shown {
        peaks: [f64::NEG_INFINITY, 0.0],
        ..Shown::default()
    };
    let (clock, mut progress, end) = (Instant::now(), Progress::default(), arguments.end());
    let steps = arguments.steps().stopping_at(TIMES);
    let report = motion.run(&steps, |at| {
        progress.at(at.time, end, at.max_slip_rate());
        watches.iter_mut().for_each(|watch| watch.see(&at));
        shown.see(fault, at.time, &at.contact(0));
        shown.least = shown.least.max(at.report.at_least_normal_stress);
        off_fault.record(&at)?;
        (files.as_mut()).map_or(ControlFlow::Continue(()), |files| files.record(&at))
    })?;
    drop(progress);
    off_fault.finish(&motion.snapshot())?;
    if let Some(files) = files {
        files.finish()?;
    }
    let seconds = clock.elapsed().as_secs_f64();
    watch::write(&output, [FILES[0], FILES[1]], &watches)?;
    shown.draw(&output, FILES[2])?;
    let stations: Vec<Value> = watches.iter().map(Watch::summary).collect();
    let (steps, taken_back) = (report.accepted, report.rejected + report.failed);
    output.json(
        FILES[3],
        &json!({
            "problem": arguments.published(),
            "cell": arguments.cell(),
            "hydraulic_cells_per_cell": arguments.fluid.refinement(),
            "components": C,
            "tolerance": arguments.adaptive,
            "stations": stations,
            "pore_pressure_mpa": shown.pressures,
            "peak_log10_slip_rate": shown.peaks[0],
            "peak_pore_pressure": shown.peaks[1],
            "most_cells_at_least_normal_stress": shown.least,
            "steps": steps,
            "rejected": taken_back,
            "seconds": seconds,
        }),
    )?;
    watches[..2].iter().try_for_each(Watch::say)?;
    if shown.least > 0 {
        let without = if arguments.fluid.allow_opening {
            "open"
        } else {
            "at the least normal stress"
        };
        say!(
            "up to {} cells were {without}: the pore pressure reached {:.3} MPa, the normal stress is {} MPa",
            shown.least,
            1e-6 * shown.peaks[1],
            1e-6 * NORMAL
        )?;
    }
    say!(
        "{} cells, {steps} steps, {taken_back} taken back, {seconds:.1} s, {:.2} ms per step; {}",
        fault.cells().count(),
        1e3 * seconds / (steps + taken_back).max(1) as f64,
        output.told(&FILES)
    )?;
    let fine = arguments.cell() <= 10.0;
    if arguments.fluid.source() == Source::Gaussian && arguments.is_accurate() && fine {
        pressure::check(&shown.pressures)?;
    }
    Ok(())
}

/// The places of the files of the benchmark.
fn places<const C: usize>(fault: &PlaneFault<C>) -> Places<'_> {
    let cells = fault.cells();
    let (along, down) = (cells.along_strike(), cells.down_dip());
    Places {
        stations: STATIONS.map(SeasPoint::Plane).to_vec(),
        lines: vec![
            along.map(|x| SeasPoint::Plane([x, 0.0])),
            down.map(|y| SeasPoint::Plane([0.0, y])),
        ],
        names: (1.0, 3),
        normal_stress: false,
        pore_fluid: true,
        event: (EVENT, [0.1 * DAY, 1.0]),
        shear_modulus: MEDIUM.shear_modulus,
        directions: fault.directions(),
    }
}

impl Shown {
    fn see<const C: usize>(
        &mut self,
        fault: &PlaneFault<C>,
        time: f64,
        contact: &ContactView<'_, C>,
    ) {
        let rate = contact.max_slip_rate().log10();
        let largest = (0..contact.len()).map(|k| contact.pore_pressure(k));
        let largest = largest.fold(0.0, f64::max);
        self.peaks = [self.peaks[0].max(rate), self.peaks[1].max(largest)];
        if !TIMES.contains(&time) {
            return;
        }
        let cells = fault.cells();
        self.pressures.push(pressure::at_places(cells, contact));
        let row = cells.down_dip().count() / 2;
        let along = cells.along_strike();
        let line = |value: &dyn Fn(usize) -> f64| -> Points {
            let columns = 0..along.count();
            columns
                .map(|column| (along.center(column), value(cells.index([column, row]))))
                .collect()
        };
        let (slip, pressure) = (|k| contact.slip(k), |k| 1e-6 * contact.pore_pressure(k));
        self.profiles.push([line(&slip), line(&pressure)]);
    }

    /// Draws slip and pore pressure along strike.
    fn draw(&self, output: &Output, name: &str) -> Result<(), Failed> {
        let names = TIMES.map(|time| format!("day {:.2}", time / DAY));
        let panel = |title, curve: usize| {
            let mut panel = Panel::new("along strike [m]", title);
            for ((profile, name), color) in self.profiles.iter().zip(&names).zip(COLORS) {
                panel = panel.with(name, color, 3, profile[curve].clone());
            }
            panel
        };
        let panels = [panel("slip [m]", 0), panel("pore pressure [MPa]", 1)];
        plot::draw(&output.path(name), &panels)
    }
}
