//! The report of BP6: stations, files and checks.

use std::ops::ControlFlow;
use std::time::Instant;

use serde_json::{Value, json};
use stickslip::bie::{Cells, Fault};
use stickslip::integrate::Stepper;
use stickslip::record::SeasPoint;
use stickslip::{Run, Snapshot};

use super::super::fluid::Pressure;
use super::super::off_fault::{OWN, Plan, Record};
use super::super::seas::{Places, files};
use super::super::watch::{self, Watch};
use super::super::{Arguments, DAY, Failed, Problem, Station};
use super::{MEDIUM, SHUT, pressure};
use crate::cli::expect;
use crate::progress::Progress;

/// The stations \[m\], and the times \[s\].
const STATIONS: [f64; 4] = [0.0, 9.766, 488.28, 1000.0];
const TIMES: [f64; 6] = [
    10.0 * DAY,
    50.0 * DAY,
    75.0 * DAY,
    100.0 * DAY,
    200.0 * DAY,
    400.0 * DAY,
];
/// The results of the code CYCLAPS at 9.766 m: slip \[m\], log10 V. On the last day of the injection V has a kink,
/// which its samples do not resolve.
const REFERENCE: [[f64; 2]; 6] = [
    [1.135e-5, -10.482],
    [2.461e-3, -8.636],
    [1.5148e-2, -7.890],
    [0.174_94, f64::NAN],
    [0.203_57, -9.343],
    [0.207_18, -9.958],
];

/// The stations of the files of the benchmark \[km\].
const FILED: [f64; 11] = [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.5, 3.5, 5.0, 7.5];
/// The largest pressure of the problem, that at the well at the end of the injection \[Pa\].
const PEAK: f64 = 6.555e6;
/// The slip rate that no cell reaches [m/s].
const EVENT: f64 = 1e-3;

pub(super) fn run(
    arguments: &Arguments,
    fault: &Fault,
    motion: &mut dyn Stepper<1>,
) -> Result<(), Failed> {
    const FILES: [&str; 3] = ["stations.csv", "stations.png", "summary.json"];
    let (output, cells) = (
        arguments.files.create("earthquakes", &FILES)?,
        fault.cells(),
    );
    let mut files = files(arguments, places(cells), &motion.snapshot())?;
    let plan = Plan::of_injection(fault, OWN, EVENT)?;
    let mut off_fault = Record::new(arguments, plan, output.folder(), &motion.snapshot())?;
    let mut watches =
        STATIONS.map(|z| Watch::new(Station::on_line(cells, z), format!("{z} m"), &TIMES));
    let mut error: f64 = 0.0;
    let clock = Instant::now();
    // The injection ends at one of the times.
    let steps = arguments.steps().stopping_at(TIMES);
    let (end, mut progress) = (arguments.end(), Progress::default());
    let report = motion.run(&steps, |at| {
        progress.at(at.time, end, at.max_slip_rate());
        watches.iter_mut().for_each(|watch| watch.see(&at));
        // Cells do not resolve the first day of the injection and of the rest.
        if at.time >= DAY && !(SHUT..SHUT + DAY).contains(&at.time) {
            error = error.max(departure(cells, &at));
        }
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
    let stations: Vec<Value> = watches.iter().map(Watch::summary).collect();
    output.json(
        FILES[2],
        &json!({
            "problem": arguments.problem.name(),
            "pressure": arguments.fluid.pressure().name(),
            "largest_pressure_error": error,
            "cell": cells.length(),
            "method": format!("{:?}", arguments.method),
            "tolerance": arguments.adaptive,
            "stations": stations,
            "steps": report.accepted,
            "rejected": report.rejected + report.failed,
            "seconds": seconds,
        }),
    )?;
    watches.iter().try_for_each(Watch::say)?;
    if arguments.fluid.pressure() == Pressure::Solver {
        say!("pore pressure from day 1 on within {error:.1} Pa of the closed form")?;
    }
    say!(
        "{} cells, {} steps, {} taken back, {seconds:.1} s; {}",
        cells.count(),
        report.accepted,
        report.rejected + report.failed,
        output.told(&FILES)
    )?;
    if arguments.is_accurate() && arguments.cell() <= 10.0 {
        let what = "largest error of the pore pressure from day 1 on [Pa]";
        expect(what, error, 0.0, 1e-4 * PEAK)?;
    }
    if arguments.is_accurate() && arguments.cell() <= 20.0 && arguments.problem == Problem::Bp6 {
        for ((time, known), [slip, rate]) in TIMES.iter().zip(&watches[1].known).zip(REFERENCE) {
            let day = time / DAY;
            expect(&format!("slip on day {day}"), known.slip, slip, 0.01 * slip)?;
            if rate.is_finite() {
                expect(&format!("log10 V on day {day}"), known.log_rate, rate, 0.02)?;
            }
        }
    }
    Ok(())
}

/// The largest difference of the pore pressure from the closed form \[Pa\].
fn departure(cells: &Cells, at: &Snapshot<'_, 1>) -> f64 {
    let contact = at.contact(0);
    let each = (0..cells.count())
        .map(|cell| (contact.pore_pressure(cell) - pressure(cells.center(cell), at.time)).abs());
    each.fold(0.0, f64::max)
}

/// The places of the files of the benchmark.
fn places(cells: &Cells) -> Places<'static> {
    Places {
        stations: FILED.map(|z| SeasPoint::Line(1e3 * z)).to_vec(),
        lines: vec![cells.map(SeasPoint::Line)],
        names: (100.0, 3),
        normal_stress: false,
        pore_fluid: true,
        event: (EVENT, [DAY, 1.0]),
        shear_modulus: MEDIUM.shear_modulus,
        directions: &[[1.0, 0.0]],
    }
}
