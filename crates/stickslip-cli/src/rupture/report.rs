//! A dynamic rupture in numbers and as a picture, beside the numbers of a spectral code.

use serde_json::{Map as Object, json};
use stickslip::fem::P1;

use super::{Arguments, Law};
use crate::cli::{Problem, expect};
use crate::output::number;
use crate::plot::{self, COLORS, Panel};
use crate::probes::Probes;

/// The slip rate at the arrival of the rupture [m/s].
const ARRIVED: (f64, f64) = (1e-3, 1e-3);
/// The results of the spectral code uguca with cells of 25 m: x \[m\], arrival \[s\], slip at 5 s and 10 s \[m\].
const REFERENCE: [[f64; 4]; 3] = [
    [0.0, 0.573, 8.833, 14.815],
    [3e3, 1.786, 6.871, 12.894],
    [6e3, 2.979, 5.352, 11.519],
];

/// Writes and prints the results, those of the aging law beside those of the spectral code.
///
/// # Errors
/// Files that cannot be written, and results that differ from the spectral code's where they should agree.
pub fn report(arguments: &Arguments, space: &P1<2>, probes: &Probes<2, 6>) -> Result<(), Problem> {
    const FILES: [&str; 3] = ["stations.csv", "rupture.png", "summary.json"];
    let output = arguments.files.create("rupture", &FILES)?;
    let stations = probes.each.iter().map(|station| {
        let x = space.mesh().vertices()[station.vertex][0];
        (x, station)
    });
    let heats = arguments.thermal_pressurization;
    let (names, count) = if heats {
        (
            "x,time,slip,slip_rate,shear_stress,pore_pressure,temperature",
            7,
        )
    } else {
        ("x,time,slip,slip_rate,shear_stress", 5)
    };
    let rows = stations.clone().flat_map(|(x, station)| {
        let rows = station.rows.iter().skip(1);
        rows.map(move |row| {
            [x].iter()
                .chain(row)
                .take(count)
                .map(|own| number(*own))
                .collect::<Vec<_>>()
        })
    });
    output.table(FILES[0], names, rows)?;
    let names: Vec<String> = (stations.clone())
        .map(|(x, _)| format!("x = {} km", x / 1e3))
        .collect();
    let panel = |name, column: usize, scale: f64| {
        let mut panel = Panel::new("time [s]", name);
        for ((station, label), color) in probes.each.iter().zip(&names).zip(COLORS) {
            panel = panel.with(label, color, 3, station.curve(column, scale));
        }
        panel
    };
    let mut panels = vec![
        panel("slip [m]", 1, 1.0),
        panel("slip rate [m/s]", 2, 1.0),
        panel("shear stress [MPa]", 3, 1e-6),
    ];
    if heats {
        panels.push(panel("pore pressure [MPa]", 4, 1e-6));
        panels.push(panel("temperature [K]", 5, 1.0));
    }
    plot::draw(&output.path(FILES[1]), &panels[..])?;
    let (mut summary, mut verdict) = (Vec::new(), Ok(()));
    let mut lines = vec![format!(
        "{:>6} {:>10} {:>10} {:>10} {:>12}",
        "x km", "arrival s", "slip 5 s", "slip 10 s", "stress MPa"
    )];
    for (x, station) in stations {
        let arrival = station.times(ARRIVED, |row| row[2]).first().copied();
        let peak = station.rows.iter().map(|row| row[3]).fold(0.0, f64::max);
        let at = |time: f64| {
            let found = station.rows.iter().find(|row| row[0] == time);
            found.map_or(f64::NAN, |row| row[1])
        };
        lines.push(format!(
            "{:>6.1} {:>10.3} {:>10.3} {:>10.3} {:>12.2}",
            x / 1e3,
            arrival.unwrap_or(f64::NAN),
            at(5.0),
            at(10.0),
            peak / 1e6
        ));
        let known = REFERENCE.iter().filter(|_| arguments.law == Law::Aging);
        if let Some(known) = known.into_iter().find(|known| known[0] == x) {
            let [_, time, five, ten] = known;
            lines.push(format!(
                "{:>6} {time:>10.3} {five:>10.3} {ten:>10.3}   by uguca, 25 m",
                ""
            ));
            // The spectral code's own cells of 50 m and 25 m agree to 0.01 s and 0.1 %.
            if arguments.resolves() {
                let arrived = expect("arrival", arrival.unwrap_or(f64::NAN), *time, 0.03);
                let first = expect("slip at 5 s", at(5.0), *five, 0.01 * five);
                let second = expect("slip at 10 s", at(10.0), *ten, 0.01 * ten);
                verdict = verdict.and(arrived).and(first).and(second);
            }
        }
        let slips: Object<String, serde_json::Value> = (arguments.stops())
            .map(|time| (time.to_string(), json!(at(time))))
            .collect();
        let mut own = json!({ "x": x, "arrival": arrival, "slip": slips, "peak_stress": peak });
        if heats {
            let largest = |column: usize| {
                let rows = station.rows.iter().map(|row| row[column]);
                rows.fold(0.0, f64::max)
            };
            own["peak_pore_pressure"] = largest(4).into();
            own["peak_temperature"] = largest(5).into();
        }
        summary.push(own);
    }
    let milliseconds = probes.milliseconds_per_step();
    output.json(
        FILES[2],
        &json!({
            "vertices": space.vertex_count(),
            "cell": arguments.cell,
            "steps": probes.cost.steps,
            "stations": summary,
            "milliseconds_per_step": milliseconds,
        }),
    )?;
    say!("{}", lines.join("\n"))?;
    say!(
        "{} vertices, {} steps, {milliseconds:.3} ms a step; {}",
        space.vertex_count(),
        probes.cost.steps,
        output.told(&FILES)
    )?;
    verdict
}
