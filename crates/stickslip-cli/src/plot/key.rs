//! Colours for positive values, and their key.

use plotters::prelude::*;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};

use super::axis::Axis;
use super::canvas::SCALE;
use super::{Area, Drawn, letters};

/// The width of the key.
pub(super) const WIDTH: u32 = 240;
/// The number of distinct colours.
const LEVELS: f64 = 200.0;

/// The number of the colour of a logarithm, for values with the first and the last one.
pub(super) fn level(logarithm: f64, range: (f64, f64)) -> i32 {
    let (low, high) = (range.0.log10(), range.1.log10());
    let share = ((logarithm - low) / (high - low)).clamp(0.0, 1.0);
    (LEVELS * share).round() as i32
}

/// The colour of a number.
pub(super) fn color(level: i32) -> RGBColor {
    ViridisRGB.get_color_normalized(f64::from(level), 0.0, LEVELS)
}

/// The colour of a share of the range.
pub(super) fn shade(share: f64) -> RGBColor {
    color((LEVELS * share.clamp(0.0, 1.0)).round() as i32)
}

/// Draws the colours beside an axis, logarithmic or linear.
pub(super) fn draw<DB: DrawingBackend>(
    area: &Area<DB>,
    name: &str,
    range: (f64, f64),
    logarithmic: bool,
) -> Drawn<DB> {
    let axis = Axis::new([range.0, range.1].into_iter(), logarithmic, true);
    let mut chart = ChartBuilder::on(area)
        .margin(24 * SCALE)
        .margin_bottom((24 + 84) * SCALE)
        .margin_right(36 * SCALE)
        .y_label_area_size(130 * SCALE)
        .build_cartesian_2d(0.0..1.0, axis.coordinates())?;
    let step = (axis.range.end - axis.range.start) / LEVELS;
    chart.draw_series((0..LEVELS as i32).map(|level| {
        let from = axis.range.start + step * f64::from(level);
        Rectangle::new([(0.0, from), (1.0, from + step)], color(level).filled())
    }))?;
    chart
        .configure_mesh()
        .disable_mesh()
        .disable_x_axis()
        .axis_style(BLACK.stroke_width(SCALE))
        .set_all_tick_mark_size(6 * SCALE)
        .y_desc(name)
        .axis_desc_style(letters(30))
        .label_style(letters(26))
        .y_label_formatter(&|tick| axis.label(*tick))
        .draw()?;
    Ok(())
}
