//! A rupture in space in numbers, in files of the benchmark, and as pictures.

use std::fmt::Write as _;
use std::io::Write as _;

use serde_json::json;
use stickslip::fem::Trace;

use super::Arguments;
use super::maps::{Field, Part};
use super::record::{Record, Station};
use super::rock::Rock;
use crate::cli::Problem;
use crate::onsets::Onsets;
use crate::output::number;
use crate::plot::{self, COLORS, Panel, Points};

/// The slip rate at the arrival of the rupture [m/s].
const ARRIVED: f64 = 1e-3;

/// The time of a vertex that does not rupture, in the files of the benchmarks \[s\].
const NEVER: f64 = 1e9;

/// The columns of the components of slip and of slip rate along strike and down dip.
const SLIP: [usize; 2] = [1, 4];
const RATE: [usize; 2] = [2, 5];

/// The results of a run.
pub(super) struct Outcome<'a> {
    /// What was recorded.
    pub record: Record,
    /// The fault.
    pub fault: &'a Trace<3>,
    /// The rock.
    pub rock: &'a Rock,
    /// The longest edge at what slips \[m\].
    pub edge: f64,
    /// The step \[s\].
    pub dt: f64,
}

/// Writes and prints the results.
///
/// # Errors
/// Files that cannot be written.
pub(super) fn report(arguments: &Arguments, outcome: &Outcome<'_>) -> Result<(), Problem> {
    const FILES: [&str; 8] = [
        "moment.csv",
        "cplot.dat",
        "fault.csv",
        "rupture3d.png",
        "front.png",
        "peak_rate.png",
        "slip.png",
        "summary.json",
    ];
    let (problem, record) = (arguments.problem, &outcome.record);
    let output = arguments.files.create("rupture3d", &FILES)?;
    let moment = record.moment.iter().map(|row| row.map(number));
    output.table(FILES[0], "time,moment,moment_rate", moment)?;
    let times = outcome.rupture_times();
    let mut contours = output.file(FILES[1])?;
    contours.write_all(outcome.contours(arguments, &times).as_bytes())?;
    contours.flush()?;
    let at = |k: usize| outcome.rock.place(outcome.fault.points()[k].as_slice());
    let slip = outcome.record.slip();
    let rows = (0..times.len()).map(|k| {
        let [x, depth] = at(k);
        [x, depth, times[k], record.peak[k], slip[k]].map(number)
    });
    output.table(FILES[2], "x,depth,rupture_time,peak_rate,slip", rows)?;
    let mut lines = vec![format!(
        "{:>8} {:>8} {:>10} {:>10} {:>10} {:>12}",
        "x km", "depth km", "arrival s", "peak m/s", "slip m", "stress MPa"
    )];
    let mut summary = Vec::new();
    for station in &record.stations {
        let [x, depth] = station.place;
        let mut file = output.file(&name(station.place))?;
        file.write_all(text(arguments, outcome.edge, station).as_bytes())?;
        file.flush()?;
        let mut onsets = Onsets::new(ARRIVED, ARRIVED);
        for row in &station.rows {
            onsets.record(row[0], Station::magnitude(row, RATE));
        }
        let arrival = onsets.times().first().copied();
        let rates = station.rows.iter().map(|row| Station::magnitude(row, RATE));
        let (peak, last) = (rates.fold(0.0, f64::max), station.last());
        let slip = Station::magnitude(&last, SLIP);
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
    let places = record
        .stations
        .iter()
        .map(|station| station.place.map(|x| x / 1e3));
    let labels: Vec<String> = places
        .map(|[x, depth]| format!("{x}, {depth} km"))
        .collect();
    plot::draw(&output.path(FILES[3]), &panels(record, &labels)[..])?;
    let part = Part::new(outcome.fault, outcome.rock);
    let reached: Vec<f64> = times
        .iter()
        .map(|time| if *time < NEVER { *time } else { f64::NAN })
        .collect();
    let front = Field {
        name: "rupture time [s]",
        values: &reached,
    };
    let peak = Field {
        name: "largest slip rate [m/s]",
        values: &record.peak,
    };
    part.draw(&output.path(FILES[4]), &front, None)?;
    part.draw(&output.path(FILES[5]), &peak, Some(&front))?;
    part.draw(
        &output.path(FILES[6]),
        &Field {
            name: "slip [m]",
            values: slip,
        },
        None,
    )?;
    let milliseconds = 1e3 * record.seconds / record.steps().max(1) as f64;
    let last = record.moment.last().copied().unwrap_or([0.0; 3]);
    let (vertices, on_fault) = (
        outcome.rock.space.vertex_count(),
        outcome.fault.vertices().len(),
    );
    output.json(
        FILES[7],
        &json!({
            "problem": problem.name(),
            "longest_edge": outcome.edge,
            "vertices": vertices,
            "fault_vertices": on_fault,
            "step": outcome.dt,
            "steps": record.steps(),
            "moment": last[1],
            "stations": summary,
            "milliseconds_per_step": milliseconds,
        }),
    )?;
    say!("{}", lines.join("\n"))?;
    say!(
        "{vertices} vertices, {on_fault} on the fault, {} steps of {:.4} s, {milliseconds:.1} ms a step, moment {:.3e} N m; {}",
        record.steps(),
        outcome.dt,
        last[1],
        output.told(&FILES)
    )
}

impl Outcome<'_> {
    /// The time at which each vertex ruptures \[s\].
    fn rupture_times(&self) -> Vec<f64> {
        let front = &self.record.front;
        let Some(rupture) = front.events().first().or(front.under_way()) else {
            return vec![NEVER; self.fault.vertices().len()];
        };
        let times = rupture.times.iter();
        times
            .map(|time| {
                if *time < NEVER {
                    rupture.onset + time
                } else {
                    NEVER
                }
            })
            .collect()
    }

    /// The contours of the front in the format of the benchmarks, of both halves along strike.
    fn contours(&self, arguments: &Arguments, times: &[f64]) -> String {
        let mut text = head(arguments, self.edge);
        text.push_str("# Column #1 = horizontal coordinate, distance along strike (m)\n# Column #2 = vertical coordinate, distance down-dip (m)\n# Column #3 = rupture time (s)\nj k t\n");
        for (point, time) in self.fault.points().iter().zip(times) {
            let [x, depth] = self.rock.place(point.as_slice());
            let mirrored = (self.rock.even && x > 0.0).then_some(-x);
            for x in [Some(x), mirrored].into_iter().flatten() {
                // Writing into a string does not fail.
                let _ = writeln!(text, "{x:.6e} {depth:.6e} {time:.6e}");
            }
        }
        text
    }
}

/// The curves of the stations.
fn panels<'a>(record: &Record, labels: &'a [String]) -> [Panel<'a>; 3] {
    let panel = |name, column: usize, scale: f64| {
        let mut panel = Panel::new("time [s]", name);
        for ((station, label), color) in record.stations.iter().zip(labels).zip(COLORS) {
            let steps = station.rows.iter().skip(1);
            let curve: Points = steps.map(|row| (row[0], scale * row[column])).collect();
            panel = panel.with(label, color, 2, curve);
        }
        panel
    };
    [
        panel("slip at distances along strike and depths [m]", 1, 1.0),
        panel("slip rate along strike [m/s]", 2, 1.0),
        panel("shear stress along strike [MPa]", 3, 1e-6),
    ]
}

/// The file of a station, by hundreds of metres along strike and of depth.
fn name([x, depth]: [f64; 2]) -> String {
    let hundreds = |length: f64| {
        let sign = if length < 0.0 { "-" } else { "" };
        format!("{sign}{:03.0}", (length / 100.0).abs())
    };
    format!("faultst{}dp{}.txt", hundreds(x), hundreds(depth))
}

/// The lines before the columns.
fn head(arguments: &Arguments, edge: f64) -> String {
    format!(
        "# problem={}\n# code=stickslip\n# element_size={edge} m\n",
        arguments.problem.name()
    )
}

/// A station in the format of the benchmarks: stresses in MPa, the vertical component positive downward, normal stress
/// positive in tension.
fn text(arguments: &Arguments, edge: f64, station: &Station) -> String {
    let mut text = head(arguments, edge);
    let heated = arguments.problem.is_heated();
    text.push_str(
        "# Column #1 = Time (s)\n# Columns #2-4 = horizontal slip (m), slip rate (m/s), shear stress (MPa)\n\
         # Columns #5-7 = vertical slip (m), slip rate (m/s), shear stress (MPa)\n# Column #8 = effective normal stress (MPa)\n",
    );
    let names = "t h-slip h-slip-rate h-shear-stress v-slip v-slip-rate v-shear-stress n-stress";
    if heated {
        text.push_str("# Column #9 = Temperature (K)\n# Column #10 = Pore pressure (MPa)\n");
        let _ = writeln!(text, "{names} temperature pressure");
    } else {
        let _ = writeln!(text, "{names}");
    }
    for row in &station.rows {
        let [
            time,
            h,
            h_rate,
            h_stress,
            v,
            v_rate,
            v_stress,
            normal,
            pressure,
            temperature,
        ] = *row;
        // Writing into a string does not fail.
        let _ = write!(
            text,
            "{time:.7e} {h:.7e} {h_rate:.7e} {:.7e} {v:.7e} {v_rate:.7e} {:.7e} {:.7e}",
            h_stress / 1e6,
            v_stress / 1e6,
            -normal / 1e6
        );
        let _ = if heated {
            writeln!(text, " {temperature:.7e} {:.7e}", pressure / 1e6)
        } else {
            writeln!(text)
        };
    }
    text
}
