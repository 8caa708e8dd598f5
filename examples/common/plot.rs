//! Pictures of curves, one panel above the other.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::register_font;

use super::axis::Axis;
use super::cli::Problem;

/// The colours of exact or older curves and of new ones.
pub(crate) const PALE: RGBColor = RGBColor(240, 150, 60);
/// The colour of the curve in question.
pub(crate) const DARK: RGBColor = RGBColor(25, 70, 140);

/// A curve in a panel.
pub(crate) struct Curve<'a> {
    /// Its name in the legend; empty for none.
    pub(crate) label: &'a str,
    /// Its colour.
    pub(crate) color: RGBColor,
    /// Its width in pixels.
    pub(crate) width: u32,
    /// Its points, x increasing.
    pub(crate) points: Vec<(f64, f64)>,
}

/// Curves over one pair of axes.
pub(crate) struct Panel<'a> {
    /// The name of the horizontal axis, with its unit.
    pub(crate) x: &'a str,
    /// The name of the vertical axis, with its unit.
    pub(crate) y: &'a str,
    /// Whether the vertical axis is logarithmic; values then count by their modulus.
    pub(crate) logarithmic: bool,
    /// The curves.
    pub(crate) curves: Vec<Curve<'a>>,
}

const SIZE: (u32, u32) = (1600, 620);
const FONT: &str = "sans-serif";

/// Draws the panels into a PNG file.
pub(crate) fn draw(path: &Path, panels: &[Panel<'_>]) -> Result<(), Problem> {
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the built-in font cannot be read")?;
    let root = BitMapBackend::new(path, (SIZE.0, SIZE.1 * panels.len() as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    for (area, panel) in root.split_evenly((panels.len(), 1)).iter().zip(panels) {
        draw_panel(area, panel).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    root.present()
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(())
}

fn draw_panel<DB: DrawingBackend>(
    area: &DrawingArea<DB, plotters::coord::Shift>,
    panel: &Panel<'_>,
) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
    let curves: Vec<Vec<(f64, f64)>> = panel
        .curves
        .iter()
        .map(|curve| thinned(&on_axis(panel, &curve.points)))
        .collect();
    let x = Axis::linear(curves.iter().flatten().map(|p| p.0), 0.0);
    let heights = curves.iter().flatten().map(|p| p.1);
    let y = if panel.logarithmic {
        Axis::decades(heights)
    } else {
        Axis::linear(heights, 0.05)
    };
    let bottom = y.low();
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .margin_right(48)
        .x_label_area_size(84)
        .y_label_area_size(140)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(panel.x)
        .y_desc(panel.y)
        .axis_desc_style((FONT, 30))
        .label_style((FONT, 26))
        .y_label_offset(8)
        .draw()?;
    for (curve, points) in panel.curves.iter().zip(curves) {
        let style = curve.color.stroke_width(curve.width);
        let visible: Vec<_> = points
            .into_iter()
            .map(|(x, y)| (x, y.max(bottom)))
            .collect();
        // Segment by segment: mitred joints of a polyline become spikes at sharp turns.
        let segments = visible
            .windows(2)
            .map(|ends| PathElement::new(ends.to_vec(), style));
        let series = chart.draw_series(segments)?;
        if !curve.label.is_empty() {
            series
                .label(curve.label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 40, y)], style));
        }
    }
    if panel.curves.iter().any(|curve| !curve.label.is_empty()) {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .legend_area_size(56)
            .margin(16)
            .background_style(WHITE)
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 26))
            .draw()?;
    }
    Ok(())
}

/// The points in the coordinates of the paper; what has no place there is left out.
fn on_axis(panel: &Panel<'_>, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let height = |y: f64| {
        if panel.logarithmic {
            y.abs().log10()
        } else {
            y
        }
    };
    let on_paper = points.iter().map(|&(x, y)| (x, height(y)));
    on_paper
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect()
}

/// The highest and lowest points of every two columns of pixels.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let chunk = points.len().div_ceil(SIZE.0 as usize / 2).max(1);
    if chunk <= 2 {
        return points.to_vec();
    }
    let mut kept = Vec::new();
    for points in points.chunks(chunk) {
        let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let mut pair: Vec<_> = points
            .iter()
            .min_by(by_height)
            .into_iter()
            .chain(points.iter().max_by(by_height))
            .collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept.extend(pair);
    }
    kept
}
