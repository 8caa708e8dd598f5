//! Pictures of one quantity over another, both logarithmic, with points on lines.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::register_font;

use super::axis::Axis;
use super::cli::Problem;
use super::plot::Curve;

const SIZE: (u32, u32) = (1600, 760);
/// The width of the legend, to the right of the axes.
const LEGEND: u32 = 560;
const LINE: i32 = 44;
const FONT: &str = "sans-serif";

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
    let logarithms: Vec<Vec<(f64, f64)>> = curves
        .iter()
        .map(|curve| {
            let points = curve.points.iter().map(|(x, y)| (x.log10(), y.log10()));
            points
                .filter(|(x, y)| x.is_finite() && y.is_finite())
                .collect()
        })
        .collect();
    let values = || logarithms.iter().flatten();
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .x_label_area_size(84)
        .y_label_area_size(140)
        .build_cartesian_2d(
            Axis::decades(values().map(|p| p.0)),
            Axis::decades(values().map(|p| p.1)),
        )?;
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(x)
        .y_desc(y)
        .axis_desc_style((FONT, 30))
        .label_style((FONT, 26))
        .y_label_offset(8)
        .draw()?;
    for (curve, points) in curves.iter().zip(logarithms) {
        let line = curve.color.stroke_width(curve.width);
        let segments = points
            .windows(2)
            .map(|ends| PathElement::new(ends.to_vec(), line));
        chart.draw_series(segments)?;
        let dots = points
            .iter()
            .map(|&point| Circle::new(point, 3 + curve.width, curve.color.filled()));
        chart.draw_series(dots)?;
    }
    Ok(())
}

fn draw_legend<DB: DrawingBackend>(area: &Area<DB>, curves: &[Curve<'_>]) -> DrawingResult<DB> {
    for (k, curve) in curves.iter().enumerate() {
        let y = 48 + LINE * k as i32;
        let line = curve.color.stroke_width(curve.width);
        area.draw(&PathElement::new([(8, y), (56, y)], line))?;
        area.draw(&Circle::new((32, y), 3 + curve.width, curve.color.filled()))?;
        let place = (72, y - 6);
        area.draw(&Text::new(curve.label.to_owned(), place, (FONT, 24)))?;
    }
    Ok(())
}
