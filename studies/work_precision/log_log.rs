//! Pictures of one quantity over another, both logarithmic, with points on lines.

use std::ops::Range;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::register_font;
use support::cli::Problem;

const SIZE: (u32, u32) = (1600, 760);
/// The width of the legend, to the right of the axes.
const LEGEND: u32 = 560;
const LINE: i32 = 44;
/// The width of a curve.
const WIDTH: u32 = 3;
const FONT: &str = "sans-serif";
/// Decades below the largest value that an axis shows.
const DECADES: f64 = 16.0;
/// The length of a tick below the axes: its number is clear of the lowest one beside them.
const TICK: i32 = 18;
/// At most so many ticks.
const TICKS: usize = 9;

/// A curve with its name in the legend.
pub(crate) struct Curve<'a> {
    pub(crate) label: &'a str,
    pub(crate) color: RGBColor,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Draws the curves into a PNG file, over axes with these names.
///
/// Points whose logarithms do not exist are left out.
pub(crate) fn draw(path: &Path, names: [&str; 2], curves: &[Curve<'_>]) -> Result<(), Problem> {
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the built-in font cannot be read")?;
    let root = BitMapBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(SIZE.0 - LEGEND);
    let problem = |error| format!("{}: {error}", path.display());
    draw_curves(&left, names, curves).map_err(problem)?;
    draw_legend(&right, curves).map_err(problem)?;
    root.present()
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(())
}

type Area<DB> = DrawingArea<DB, plotters::coord::Shift>;
type DrawingResult<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

fn draw_curves<DB: DrawingBackend>(
    area: &Area<DB>,
    [x, y]: [&str; 2],
    curves: &[Curve<'_>],
) -> DrawingResult<DB> {
    let logarithms: Vec<Vec<(f64, f64)>> = curves.iter().map(on_paper).collect();
    let values = || logarithms.iter().flatten();
    let horizontal = decades(values().map(|point| point.0));
    let vertical = decades(values().map(|point| point.1));
    let ticks =
        [&horizontal, &vertical].map(|axis| ((axis.end - axis.start) as usize + 1).min(TICKS));
    let name = |decade: &f64| format!("1e{decade:.0}");
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .x_label_area_size(108)
        .y_label_area_size(140)
        .build_cartesian_2d(horizontal, vertical)?;
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(x)
        .y_desc(y)
        .x_labels(ticks[0])
        .y_labels(ticks[1])
        .x_label_formatter(&name)
        .y_label_formatter(&name)
        .axis_desc_style((FONT, 30))
        .label_style((FONT, 26))
        .y_label_offset(8)
        .set_tick_mark_size(LabelAreaPosition::Bottom, TICK)
        .draw()?;
    for (curve, points) in curves.iter().zip(logarithms) {
        let line = curve.color.stroke_width(WIDTH);
        let segments = points
            .windows(2)
            .map(|ends| PathElement::new(ends.to_vec(), line));
        chart.draw_series(segments)?;
        let dots = points
            .iter()
            .map(|&point| Circle::new(point, 3 + WIDTH, curve.color.filled()));
        chart.draw_series(dots)?;
    }
    Ok(())
}

/// The decimal logarithms of the points of a curve.
fn on_paper(curve: &Curve<'_>) -> Vec<(f64, f64)> {
    let points = curve.points.iter().map(|(x, y)| (x.log10(), y.log10()));
    points
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

/// Whole decades around the logarithms.
fn decades(logarithms: impl Iterator<Item = f64>) -> Range<f64> {
    let extent = logarithms.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    if extent.0 > extent.1 {
        return -1.0..0.0;
    }
    let high = extent.1.ceil().max(extent.0.floor() + 1.0);
    extent.0.floor().max(high - DECADES)..high
}

fn draw_legend<DB: DrawingBackend>(area: &Area<DB>, curves: &[Curve<'_>]) -> DrawingResult<DB> {
    for (k, curve) in curves.iter().enumerate() {
        let y = 48 + LINE * k as i32;
        let line = curve.color.stroke_width(WIDTH);
        area.draw(&PathElement::new([(8, y), (56, y)], line))?;
        area.draw(&Circle::new((32, y), 3 + WIDTH, curve.color.filled()))?;
        let place = (72, y - 6);
        area.draw(&Text::new(curve.label.to_owned(), place, (FONT, 24)))?;
    }
    Ok(())
}
