//! A rupture in space in numbers, in files of the benchmark, and as a picture.

use std::fmt::Write as _;
use std::io::Write as _;

use serde_json::json;
use stickslip::record::{RuptureTimes, SeasHeader};

use super::Arguments;
use crate::cli::Problem;
use crate::output::number;
use crate::plot::{self, COLORS, Panel};
use crate::probes::{Probe, Probes};

/// The slip rate at the arrival of the rupture [m/s].
const ARRIVED: (f64, f64) = (1e-3, 1e-3);

/// The results of a run.
pub(super) struct Outcome {
    /// Time, and slip, slip rate and shear stress along strike and down dip, across the fault.
    pub stations: Probes<3, 7>,
    /// The times at which vertices rupture.
    pub front: RuptureTimes,
    /// Time, moment \[N m\] and its rate.
    pub moment: Vec<[f64; 3]>,
    /// The number of vertices.
    pub vertices: usize,
    /// The number of those on the fault.
    pub on_fault: usize,
    /// The step \[s\].
    pub dt: f64,
}

/// Writes and prints the results.
///
/// # Errors
/// Files that cannot be written.
pub(super) fn report(arguments: &Arguments, outcome: &Outcome) -> Result<(), Problem> {
    const FILES: [&str; 4] = ["moment.csv", "cplot.dat", "rupture3d.png", "summary.json"];
    let problem = arguments.problem;
    let output = arguments.files.create("rupture3d", &FILES)?;
    let moment = outcome.moment.iter().map(|row| row.map(number));
    output.table(FILES[0], "time,moment,moment_rate", moment)?;
    let header = SeasHeader::new(problem.name()).with("cell", &format!("{} m", arguments.cell));
    let ruptures = outcome.front.events().first().or(outcome.front.under_way());
    if let Some(rupture) = ruptures {
        outcome
            .front
            .write(rupture, &header, output.file(FILES[1])?)?;
    }
    let mut lines = vec![format!(
        "{:>8} {:>8} {:>10} {:>10} {:>10} {:>12}",
        "x km", "depth km", "arrival s", "peak m/s", "slip m", "stress MPa"
    )];
    let mut summary = Vec::new();
    for (station, [x, depth]) in outcome.stations.each.iter().zip(problem.stations()) {
        let name = format!("faultst{:03.0}dp{:03.0}.txt", x / 100.0, depth / 100.0);
        let mut file = output.file(&name)?;
        file.write_all(text(arguments, station).as_bytes())?;
        file.flush()?;
        let modulus = |a: f64, b: f64| a.hypot(b);
        let arrival = station
            .times(ARRIVED, |row| modulus(row[2], row[5]))
            .first()
            .copied();
        let rates = station.rows.iter().map(|row| modulus(row[2], row[5]));
        let (peak, last) = (rates.fold(0.0, f64::max), station.last());
        let slip = modulus(last[1], last[4]);
        lines.push(format!(
            "{:>8.1} {:>8.1} {:>10.3} {peak:>10.3} {slip:>10.3} {:>12.2}",
            x / 1e3,
            depth / 1e3,
            arrival.unwrap_or(f64::NAN),
            last[3] / 1e6
        ));
        summary.push(json!({
            "x": x, "depth": depth, "arrival": arrival, "peak_rate": peak, "slip": slip, "stress": last[3],
        }));
    }
    let places = problem.stations().into_iter();
    let labels: Vec<String> = places
        .map(|[x, depth]| format!("{}, {} km", x / 1e3, depth / 1e3))
        .collect();
    let panel = |name, column: usize, scale: f64| {
        let mut panel = Panel::new("time [s]", name);
        for ((station, label), color) in outcome.stations.each.iter().zip(&labels).zip(COLORS) {
            panel = panel.with(label, color, 2, station.curve(column, scale));
        }
        panel
    };
    let panels = [
        panel("slip at distances along strike and depths [m]", 1, 1.0),
        panel("slip rate along strike [m/s]", 2, 1.0),
        panel("shear stress along strike [MPa]", 3, 1e-6),
    ];
    plot::draw(&output.path(FILES[2]), &panels)?;
    let milliseconds = outcome.stations.milliseconds_per_step();
    let last = outcome.moment.last().copied().unwrap_or([0.0; 3]);
    output.json(
        FILES[3],
        &json!({
            "problem": problem.name(),
            "cell": arguments.cell,
            "vertices": outcome.vertices,
            "fault_vertices": outcome.on_fault,
            "step": outcome.dt,
            "steps": outcome.stations.cost.steps,
            "moment": last[1],
            "stations": summary,
            "milliseconds_per_step": milliseconds,
        }),
    )?;
    say!("{}", lines.join("\n"))?;
    say!(
        "{} vertices, {} on the fault, {} steps of {:.4} s, {milliseconds:.1} ms a step, moment {:.3e} N m; {}",
        outcome.vertices,
        outcome.on_fault,
        outcome.stations.cost.steps,
        outcome.dt,
        last[1],
        output.told(&FILES)
    )
}

/// A station in the format of the benchmarks: stresses in MPa, the vertical component positive downward.
fn text(arguments: &Arguments, station: &Probe<7>) -> String {
    let mut text = format!(
        "# problem={}\n# code=stickslip\n# element_size={} m\n# Column #1 = Time (s)\n# Columns #2-4 = horizontal slip (m), \
         slip rate (m/s), shear stress (MPa)\n# Columns #5-7 = vertical slip (m), slip rate (m/s), shear stress (MPa)\n\
         # Column #8 = normal stress (MPa)\nt h-slip h-slip-rate h-shear-stress v-slip v-slip-rate v-shear-stress n-stress\n",
        arguments.problem.name(),
        arguments.cell
    );
    for [time, h, h_rate, h_stress, v, v_rate, v_stress] in &station.rows {
        // Writing into a string does not fail.
        let _ = writeln!(
            text,
            "{time:.7e} {h:.7e} {h_rate:.7e} {:.7e} {v:.7e} {v_rate:.7e} {:.7e} {:.7e}",
            h_stress / 1e6,
            v_stress / 1e6,
            -arguments.problem.normal() / 1e6
        );
    }
    text
}
