//! Pictures of an injection: fronts against the root of time, pore pressure and slip in space and time.

use super::Failed;
use super::record::Record;
use crate::earthquakes::space_time::{Field, SpaceTime};
use crate::output::Output;
use crate::plot::{self, COLORS, DARK, Map, Panel, Points};

/// An hour \[s\].
const HOUR: f64 = 3600.0;
/// The share of the largest value at which the colours of a map begin.
const LEAST: f64 = 1e-3;
/// The least slip rate in a picture [m/s].
const SLOWEST: f64 = 1e-20;

/// Draws both fronts and the largest slip rate against the root of time.
pub(super) fn fronts(output: &Output, name: &str, record: &Record<'_>) -> Result<(), Failed> {
    let curve = |value: &dyn Fn(usize) -> f64| -> Points {
        let fronts = record.fronts.iter().enumerate();
        fronts
            .map(|(n, fronts)| ((fronts.time / HOUR).sqrt(), value(n)))
            .collect()
    };
    let radius = |which: usize| curve(&|n| record.fronts[n].radii[which]);
    let rates = curve(&|n| record.fronts[n].largest[2].max(SLOWEST).log10());
    let time = "square root of time [h^(1/2)]";
    let panels = [
        Panel::new(time, "front [m]")
            .with("pore pressure", COLORS[1], 3, radius(0))
            .with("slip", COLORS[3], 3, radius(1)),
        Panel::new(time, "log10 of the largest slip rate [m/s]").with("", DARK, 3, rates),
    ];
    plot::draw(&output.path(name), &panels)
}

/// Draws pore pressure and slip along strike in time.
pub(super) fn maps(output: &Output, names: [&str; 2], record: &Record<'_>) -> Result<(), Failed> {
    let quantities = ["pore pressure [Pa]", "slip [m]"];
    for ((name, quantity), map) in names.into_iter().zip(quantities).zip(&record.maps) {
        draw(output, name, quantity, map)?;
    }
    Ok(())
}

fn draw(output: &Output, name: &str, quantity: &str, map: &SpaceTime) -> Result<(), Failed> {
    let Field { x, y, values } = map.over_time(HOUR);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let largest = if largest > 0.0 { largest } else { 1.0 };
    let map = Map {
        names: ["time [h]", "along strike [m]", quantity],
        x: &x,
        y: &y,
        values: &values,
        range: (LEAST * largest, largest),
        downward: false,
    };
    plot::draw(&output.path(name), &map)
}
