//! Contours of rupture time on a plane: the front of an event at even times.

use std::collections::BTreeMap;
use std::path::Path;

use stickslip::bie::Rectangles;
use stickslip::record::{Rupture, RuptureTimes};

use super::{Failed, YEAR};
use crate::plot::{self, Panel, Points, RGBColor, shade};

/// Draws the fronts of the first event, and of that of the later ones which ruptures most cells.
pub(super) fn draw(
    path: &Path,
    cells: &Rectangles,
    ruptures: &RuptureTimes,
    (unit, metres): (&str, f64),
) -> Result<(), Failed> {
    let size = |event: &Rupture| event.times.iter().filter(|time| is_reached(**time)).count();
    let mut events = ruptures.events().iter().chain(ruptures.under_way());
    let first = events.next();
    // The first one of several that are equally large.
    let largest = events.rev().max_by_key(|event| size(event));
    let drawn: Vec<_> = (first.into_iter().chain(largest))
        .map(|event| (event, fronts(cells, event, metres)))
        .collect();
    let axes = ["along strike", "down dip"].map(|name| format!("{name} [{unit}]"));
    let names: Vec<String> = (drawn.iter())
        .map(|(event, _)| {
            let years = event.onset / YEAR;
            format!("rupture fronts of the event at {years:.2} years")
        })
        .collect();
    let mut panels: Vec<Panel<'_>> = Vec::new();
    for ((_, fronts), name) in drawn.iter().zip(&names) {
        let points = || {
            fronts
                .iter()
                .flat_map(|front| front.curves.iter().flatten())
        };
        let [width, height] = [extent(points().map(|p| p.0)), extent(points().map(|p| p.1))];
        let mut panel = Panel::new(&axes[0], &axes[1]).titled(name).downward();
        if width > 0.0 && height > 0.0 {
            panel = panel.in_ratio(height / width);
        }
        for Front {
            label,
            color,
            curves,
        } in fronts
        {
            for (n, curve) in curves.iter().enumerate() {
                let label = if n == 0 { label.as_str() } else { "" };
                panel = panel.with(label, *color, 3, curve.clone());
            }
        }
        panels.push(panel);
    }
    if panels.is_empty() {
        panels.push(Panel::new(&axes[0], &axes[1]).titled("no cell has ruptured"));
    }
    plot::draw(path, panels.as_slice())
}

/// The front at a time.
struct Front {
    label: String,
    color: RGBColor,
    curves: Vec<Points>,
}

/// The distance of the smallest and the largest value.
fn extent(values: impl Iterator<Item = f64>) -> f64 {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(ends, |(low, high), x| (low.min(x), high.max(x)));
    high - low
}

fn is_reached(time: f64) -> bool {
    // Cells that do not rupture have 1e9 s.
    time < 1e8
}

/// The fronts of an event at multiples of 1, 2 or 5 times a power of ten, at most so many.
fn fronts(cells: &Rectangles, event: &Rupture, metres: f64) -> Vec<Front> {
    let times = event.times.iter().copied().filter(|time| is_reached(*time));
    let end = times.fold(0.0, f64::max);
    let step = plot::interval(end);
    let count = (end / step) as usize;
    let numbers = (1..=count).filter(|_| step > 0.0);
    numbers
        .map(|n| Front {
            label: format!("{} s", (n as f64 * step * 1e6).round() / 1e6),
            color: shade((n - 1) as f64 / count as f64),
            curves: contour(cells, &event.times, n as f64 * step, metres),
        })
        .collect()
}

/// The contour of a time between the centres of cells that rupture, in metres of so many.
fn contour(cells: &Rectangles, times: &[f64], level: f64, metres: f64) -> Vec<Points> {
    let (along, down) = (cells.along_strike(), cells.down_dip());
    let at = |corner: [usize; 2]| times[cells.index(corner)];
    // The crossing of an edge from a corner to the next one along strike (0) or down dip (1).
    let mut points = BTreeMap::new();
    let mut links = BTreeMap::<_, Vec<_>>::new();
    for column in 0..along.count() - 1 {
        for row in 0..down.count() - 1 {
            let corners = [
                [column, row],
                [column + 1, row],
                [column + 1, row + 1],
                [column, row + 1],
            ];
            if !corners.iter().all(|corner| is_reached(at(*corner))) {
                continue;
            }
            let mut crossed = Vec::new();
            for side in 0..4 {
                let ends = [corners[side], corners[(side + 1) % 4]];
                let [from, to] = ends.map(at);
                if (from < level) == (to < level) {
                    continue;
                }
                let part = (level - from) / (to - from);
                let [begin, end] = ends.map(|[i, k]| (along.center(i), -down.center(k)));
                let between = |a: f64, b: f64| (a + part * (b - a)) / metres;
                let edge = (ends[0].min(ends[1]), side % 2);
                points.insert(edge, (between(begin.0, end.0), between(begin.1, end.1)));
                crossed.push(edge);
            }
            for pair in crossed.chunks_exact(2) {
                links.entry(pair[0]).or_default().push(pair[1]);
                links.entry(pair[1]).or_default().push(pair[0]);
            }
        }
    }
    let mut curves = Vec::new();
    // Open curves from their ends, then closed ones.
    let ends = links.iter().filter(|(_, to)| to.len() == 1);
    let starts: Vec<_> = ends.chain(&links).map(|(edge, _)| *edge).collect();
    for start in starts {
        let mut curve = Points::from([points[&start]]);
        let mut edge = start;
        while let Some(next) = links.get_mut(&edge).and_then(Vec::pop) {
            if let Some(back) = links.get_mut(&next)
                && let Some(place) = back.iter().position(|other| *other == edge)
            {
                back.swap_remove(place);
            }
            curve.push(points[&next]);
            edge = next;
        }
        if curve.len() > 1 {
            curves.push(curve);
        }
    }
    curves
}

#[cfg(test)]
mod tests {
    use stickslip::bie::Cells;

    use super::*;

    /// Contours of a distance are circles: one closed curve each, or arcs where the plane ends.
    #[test]
    fn contours_of_a_distance_are_circles() -> Result<(), Failed> {
        let cells = Rectangles::new(
            Cells::new([-10.0, 10.0], 100)?,
            Cells::new([0.0, 12.0], 60)?,
        );
        let times = cells.map(|[x, y]| x.hypot(y - 6.0));
        for radius in [1.3, 4.0, 7.7] {
            let curves = contour(&cells, &times, radius, 1.0);
            let is_whole = radius < 5.8;
            assert_eq!(curves.len(), if is_whole { 1 } else { 2 }, "{radius}");
            for curve in &curves {
                let close = |(x, y): &(f64, f64)| (x.hypot(y + 6.0) / radius - 1.0).abs() < 0.01;
                assert!(curve.iter().all(close), "{radius}");
                assert_eq!(curve.first() == curve.last(), is_whole, "{radius}");
            }
        }
        // None next to cells that do not rupture.
        let times = cells.map(|[x, _]| if x < 0.0 { x.abs() } else { 1e9 });
        let curves = contour(&cells, &times, 4.0, 1.0);
        assert_eq!(curves.len(), 1);
        assert!(curves[0].iter().all(|(x, _)| (x + 4.0).abs() < 1e-12));
        Ok(())
    }
}
