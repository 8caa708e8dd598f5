//! Pictures of slip rates in colours: lines in time, and planes at chosen times.

use std::path::Path;

use stickslip::ContactView;
use stickslip::bie::Rectangles;

use super::space_time::{Field, SpaceTime};
use super::{Failed, YEAR};
use crate::plot::{self, Map, Sheet};

/// The slip rates at the ends of the colours [m/s].
const COLOURS: (f64, f64) = (1e-12, 1.0);
const RATE: &str = "slip rate [m/s]";
/// The least number of columns of a map.
const COLUMNS: usize = 400;

/// The picture of slip rates along lines, over time and over the number of the step.
pub(super) fn lines(path: &Path, lines: &[(&str, &SpaceTime)]) -> Result<(), Failed> {
    let fields: Vec<(&str, [Field; 2])> = lines
        .iter()
        .map(|(name, line)| (*name, [line.over_time(YEAR), line.over_steps()]))
        .collect();
    let maps = fields.iter().flat_map(|(name, fields)| {
        let names = ["time [years]", "step"];
        let titles = [
            "The largest slip rate over time",
            "over the number of the step",
        ];
        let pairs = names.into_iter().zip(titles).zip(fields);
        pairs.map(|((x, title), field)| (title.to_owned(), map([x, name, RATE], field)))
    });
    plot::draw(path, &Sheet::new(maps.collect()))
}

fn map<'a>(names: [&'a str; 3], field: &'a Field) -> Map<'a> {
    Map {
        names,
        x: &field.x,
        y: &field.y,
        values: &field.values,
        range: COLOURS,
        downward: true,
    }
}

/// Slip rates of a plane at chosen times after it is first as fast as a rupture: those of the last event that has all of
/// them, or else of the last one.
pub(super) struct Shots {
    /// The slip rate of a rupture [m/s].
    rupture: f64,
    /// The times \[s\].
    after: &'static [f64],
    /// The time of the last event at which it was as fast \[s\].
    since: Option<f64>,
    armed: bool,
    shots: [Vec<Shot>; 2],
}

/// A title and the slip rate of each cell.
type Shot = (String, Vec<f64>);

impl Shots {
    pub(super) fn new(rupture: f64, after: &'static [f64]) -> Self {
        Self {
            rupture,
            after,
            since: None,
            armed: true,
            shots: Default::default(),
        }
    }

    /// Records a step.
    pub(super) fn record<const C: usize>(&mut self, time: f64, contact: &ContactView<'_, C>) {
        let largest = contact.max_slip_rate();
        let [taken, kept] = &mut self.shots;
        if self.armed && largest >= self.rupture {
            if taken.len() >= kept.len() {
                *kept = std::mem::take(taken);
            }
            taken.clear();
            (self.since, self.armed) = (Some(time), false);
        }
        self.armed |= largest < 0.1 * self.rupture;
        let Some(since) = self.since else {
            return;
        };
        let due = self.after.get(taken.len());
        if due.is_some_and(|after| time >= since + after) {
            let (years, after) = (since / YEAR, time - since);
            let title = format!("{years:.2} years, {after:.2} s after {} m/s", self.rupture);
            let rates = (0..contact.len()).map(|k| contact.slip_rate(k));
            taken.push((title, rates.collect()));
        }
    }

    /// Draws the maps, with lengths in units of so many metres; or one of the present slip rates if there was no event.
    pub(super) fn draw<const C: usize>(
        &self,
        path: &Path,
        (cells, contact): (&Rectangles, &ContactView<'_, C>),
        (unit, metres): (&str, f64),
    ) -> Result<(), Failed> {
        let [taken, kept] = &self.shots;
        let shots = if taken.len() >= kept.len() {
            taken
        } else {
            kept
        };
        let present: Vec<Shot> = if shots.is_empty() {
            let rates = (0..contact.len()).map(|k| contact.slip_rate(k));
            vec![("at the end".to_owned(), rates.collect())]
        } else {
            Vec::new()
        };
        let names = ["along strike", "down dip"].map(|name| format!("{name} [{unit}]"));
        let shots: Vec<&Shot> = shots.iter().chain(&present).collect();
        let fields: Vec<Field> = (shots.iter())
            .map(|(_, rates)| smooth(cells, rates, metres))
            .collect();
        let names = [&names[0], &names[1], RATE];
        let maps = shots.iter().zip(&fields);
        let maps = maps.map(|((title, _), field)| (title.clone(), map(names, field)));
        let [width, height] = [cells.along_strike(), cells.down_dip()].map(|cells| {
            let [begin, end] = cells.ends();
            end - begin
        });
        plot::draw(path, &Sheet::new(maps.collect()).in_pairs(height / width))
    }
}

/// The field of a plane over strike and distance up dip, with columns between the centres of cells: ln V is linear there.
fn smooth(cells: &Rectangles, rates: &[f64], metres: f64) -> Field {
    let (along, down) = (cells.along_strike(), cells.down_dip());
    let between = COLUMNS.div_ceil(along.count());
    let count = along.count() - 1;
    let rows: Vec<usize> = (0..down.count()).rev().collect();
    let (mut x, mut values) = (Vec::new(), Vec::new());
    for n in 0..=count * between {
        let (left, part) = (n / between, (n % between) as f64 / between as f64);
        let right = (left + 1).min(count);
        let [from, to] = [left, right].map(|column| along.center(column));
        x.push((from + part * (to - from)) / metres);
        values.extend(rows.iter().map(|&row| {
            let [from, to] = [left, right].map(|column| {
                rates[cells.index([column, row])]
                    .max(f64::MIN_POSITIVE)
                    .ln()
            });
            (from + part * (to - from)).exp()
        }));
    }
    let y = rows.iter().map(|&row| -down.center(row) / metres).collect();
    Field { x, y, values }
}
