//! Values at scattered points as colours.

use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::SCALE;
use super::{Area, Draw, Drawn, key, letters};

/// Positive values at points of a plane, with their logarithms as colours; a point without a value is a ring.
pub struct Scatter<'a> {
    /// Names of the coordinates and of the value, with their units.
    pub names: [&'a str; 3],
    /// The points, the second coordinate on a logarithmic axis.
    pub points: Vec<(f64, f64, Option<f64>)>,
}

impl Scatter<'_> {
    /// The least and the largest value; a single value is widened by a factor.
    fn range(&self) -> (f64, f64) {
        let values = self.points.iter().filter_map(|point| point.2);
        let ends = (f64::INFINITY, 0.0_f64);
        let (low, high) = values.fold(ends, |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            (0.1, 1.0)
        } else if low == high {
            (low / 2.0, high * 2.0)
        } else {
            (low, high)
        }
    }
}

impl Draw for Scatter<'_> {
    fn size(&self) -> (u32, u32) {
        (1600, 720)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, _pixels: bool) -> Drawn<DB> {
        let (field, beside) = area.split_horizontally((self.size().0 - key::WIDTH) * SCALE);
        let x = Axis::new(self.points.iter().map(|point| point.0), false, false);
        let y = Axis::new(self.points.iter().map(|point| point.1), true, false);
        let mut chart = ChartBuilder::on(&field)
            .margin(24 * SCALE)
            .x_label_area_size(84 * SCALE)
            .y_label_area_size(130 * SCALE)
            .build_cartesian_2d(x.coordinates(), y.coordinates())?;
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
            .draw()?;
        let range = self.range();
        chart.draw_series(self.points.iter().filter_map(|&(at, beside, value)| {
            let place = (x.place(at)?, y.place(beside)?);
            let style = match value {
                Some(value) => key::color(key::level(value.log10(), range)).filled(),
                None => BLACK.stroke_width(2 * SCALE),
            };
            Some(Circle::new(place, 9 * SCALE, style))
        }))?;
        key::draw(&beside, self.names[2], range, true)
    }
}

impl Draw for [Scatter<'_>] {
    fn size(&self) -> (u32, u32) {
        let heights = self.iter().map(|scatter| scatter.size().1);
        (1600, heights.sum())
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        let areas = area.split_evenly((self.len(), 1));
        (areas.iter().zip(self)).try_for_each(|(area, scatter)| scatter.draw(area, pixels))
    }
}
