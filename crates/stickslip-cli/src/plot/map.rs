//! A field in time and space as colours.

use std::ops::Range;

use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::SCALE;
use super::{Area, Draw, Drawn, key, letters};

/// A positive field over two coordinates; its logarithm as colours that readers with any colour vision can order.
pub struct Map<'a> {
    /// Names of the coordinates and of the field, with their units.
    pub names: [&'a str; 3],
    /// The first coordinate, increasing.
    pub x: &'a [f64],
    /// The second coordinate, increasing.
    pub y: &'a [f64],
    /// The field at `(x[i], y[k])` as entry `i * y.len() + k`.
    pub values: &'a [f64],
    /// The field at the ends of the colours; values beyond have the last one.
    pub range: (f64, f64),
    /// Whether the second coordinate is the negative of a depth, which is shown.
    pub downward: bool,
}

/// The part of the picture by which neighbours overlap.
const SEAM: f64 = 2000.0;
/// The number of stripes, and of those between two neighbours in `y` at most, with a linear logarithm.
const STRIPES: usize = 240;
const BETWEEN: usize = 6;

impl Map<'_> {
    /// A stripe of one level at a time: from, to, level.
    fn runs(&self, k: usize, part: f64) -> Vec<(f64, f64, i32)> {
        let (width, mut runs) = (self.y.len(), Vec::<(f64, f64, i32)>::new());
        for (i, &x) in self.x.iter().enumerate() {
            let [low, high] =
                [k, k + 1].map(|k| self.values[i * width + k].max(f64::MIN_POSITIVE).log10());
            let level = key::level(low + (high - low) * part, self.range);
            let next = self.x.get(i + 1).copied().unwrap_or(x);
            match runs.last_mut() {
                Some(last) if last.2 == level => last.1 = next,
                _ => runs.push((x, next, level)),
            }
        }
        runs
    }
}

impl Draw for Map<'_> {
    fn size(&self) -> (u32, u32) {
        (1600, 900)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, _pixels: bool) -> Drawn<DB> {
        let (field, beside) = area.split_horizontally(area.dim_in_pixel().0 - key::WIDTH * SCALE);
        self.draw_field(&field)?;
        key::draw(&beside, self.names[2], self.range, true)
    }
}

impl Map<'_> {
    /// Draws the field without the key of its colours.
    pub(super) fn draw_field<DB: DrawingBackend>(&self, field: &Area<DB>) -> Drawn<DB> {
        let [x, y] = [self.x, self.y].map(|values| Axis::new(values.iter().copied(), false, true));
        let y = y.downward(self.downward);
        let mut chart = ChartBuilder::on(field)
            .margin(24 * SCALE)
            .x_label_area_size(84 * SCALE)
            .y_label_area_size(110 * SCALE)
            .build_cartesian_2d(x.coordinates(), y.coordinates())?;
        // A little over the neighbours that follow: no seams.
        let over = |place: f64, axis: &Axis| {
            let Range { start, end } = axis.range;
            (place + (end - start) / SEAM).min(end)
        };
        let rows = self.y.len().saturating_sub(1);
        let stripes = (STRIPES / rows.max(1)).clamp(1, BETWEEN);
        for k in 0..rows {
            for stripe in 0..stripes {
                let [from, middle, to] =
                    [0.0, 0.5, 1.0].map(|part| (stripe as f64 + part) / stripes as f64);
                // The outermost values last to the ends of the axes.
                let place = |part: f64| match part {
                    0.0 if k == 0 => y.range.start,
                    1.0 if k + 2 == self.y.len() => y.range.end,
                    _ => self.y[k] + (self.y[k + 1] - self.y[k]) * part,
                };
                let (first, last) = (self.x.first().copied(), self.x.last().copied());
                let runs = self.runs(k, middle).into_iter();
                chart.draw_series(runs.map(|(start, end, level)| {
                    let start = if Some(start) == first {
                        x.range.start
                    } else {
                        start
                    };
                    let end = if Some(end) == last { x.range.end } else { end };
                    let corners = [(start, place(from)), (over(end, &x), over(place(to), &y))];
                    Rectangle::new(corners, key::color(level).filled())
                }))?;
            }
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(BLACK.stroke_width(SCALE))
            .set_all_tick_mark_size(6 * SCALE)
            .x_desc(self.names[0])
            .y_desc(self.names[1])
            .axis_desc_style(letters(30))
            .label_style(letters(26))
            .x_label_formatter(&|tick| x.label(*tick))
            .y_label_formatter(&|tick| y.label(*tick))
            .draw()
    }
}
