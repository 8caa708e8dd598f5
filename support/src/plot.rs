//! Pictures of curves, one panel above the other.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;
use plotters::style::register_font;

use crate::cli::Problem;

/// The colour of an exact or an older curve.
pub const PALE: RGBColor = RGBColor(240, 150, 60);
/// The colour of the curve in question.
pub const DARK: RGBColor = RGBColor(25, 70, 140);

const SIZE: (u32, u32) = (1600, 620);
const FONT: &str = "sans-serif";
/// What a logarithmic axis shows at most, as a ratio of its ends.
const RATIO: f64 = 1e-16;

/// Points of a curve, x increasing; what has no place on the axes is left out.
pub type Points = Vec<(f64, f64)>;

/// Curves over one pair of axes.
pub struct Panel<'a> {
    names: [&'a str; 2],
    logarithmic: bool,
    curves: Vec<(&'a str, ShapeStyle, Points)>,
}

impl<'a> Panel<'a> {
    /// Axes with names that tell the units, and no curve yet.
    pub fn new(x: &'a str, y: &'a str) -> Self {
        let (names, logarithmic, curves) = ([x, y], false, Vec::new());
        Self {
            names,
            logarithmic,
            curves,
        }
    }

    /// Makes the vertical axis logarithmic: values count by their modulus.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// Adds a curve, with a name for the legend or an empty one.
    #[must_use]
    pub fn with(mut self, label: &'a str, color: RGBColor, width: u32, points: Points) -> Self {
        let height = |y: f64| if self.logarithmic { y.abs() } else { y };
        let points = points.into_iter().map(|(x, y)| (x, height(y)));
        let points = points.filter(|&(x, y)| x.is_finite() && y.is_finite());
        let style = color.stroke_width(width);
        self.curves.push((label, style, points.collect()));
        self
    }
}

/// Draws the panels into a PNG file.
pub fn draw(path: &Path, panels: &[Panel<'_>]) -> Result<(), Problem> {
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the built-in font cannot be read")?;
    let failed =
        |error: &dyn std::error::Error| format!("cannot write {}: {error}", path.display());
    let root = BitMapBackend::new(path, (SIZE.0, SIZE.1 * panels.len() as u32)).into_drawing_area();
    root.fill(&WHITE).map_err(|error| failed(&error))?;
    for (area, panel) in root.split_evenly((panels.len(), 1)).iter().zip(panels) {
        draw_panel(area, panel).map_err(|error| failed(&error))?;
    }
    root.present().map_err(|error| failed(&error))?;
    Ok(())
}

type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

fn draw_panel<DB: DrawingBackend>(area: &DrawingArea<DB, Shift>, panel: &Panel<'_>) -> Drawn<DB> {
    let points = || panel.curves.iter().flat_map(|(.., points)| points);
    let x = extent(points().map(|p| p.0), 0.0);
    if panel.logarithmic {
        let y = extent(points().map(|p| p.1).filter(|&y| y > 0.0), 0.0);
        let low = y.start.max(RATIO * y.end);
        let scale = (low..y.end).log_scale();
        draw_curves(area, panel, x, scale, low, Some(&|y| format!("{y:e}")))
    } else {
        let y = extent(points().map(|p| p.1), 0.05);
        draw_curves(area, panel, x, y.clone(), y.start, None)
    }
}

/// The range of the values, with a margin as a share of its length.
fn extent(values: impl Iterator<Item = f64>, margin: f64) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    if low > high {
        return 0.1..1.0;
    }
    let least = (1e-6 * low.abs().max(high.abs())).max(f64::MIN_POSITIVE);
    let room = margin * (high - low).max(least);
    low - room..high.max(low + least) + room
}

fn draw_curves<DB: DrawingBackend, Y>(
    area: &DrawingArea<DB, Shift>,
    panel: &Panel<'_>,
    x: Range<f64>,
    y: Y,
    bottom: f64,
    label: Option<&dyn Fn(&f64) -> String>,
) -> Drawn<DB>
where
    Y: AsRangedCoord<Value = f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    let mut chart = ChartBuilder::on(area)
        .margin(24)
        .margin_right(48)
        .x_label_area_size(84)
        .y_label_area_size(140)
        .build_cartesian_2d(x, y)?;
    let mut mesh = chart.configure_mesh();
    mesh.max_light_lines(0)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc(panel.names[0])
        .y_desc(panel.names[1])
        .axis_desc_style((FONT, 30))
        .label_style((FONT, 26));
    if let Some(label) = label {
        mesh.y_label_formatter(label);
    }
    mesh.draw()?;
    for (label, style, points) in &panel.curves {
        let style = *style;
        // Segment by segment: mitred joints of a polyline become spikes at sharp turns.
        let segments = points.windows(2).map(|ends| {
            PathElement::new([0, 1].map(|k| (ends[k].0, ends[k].1.max(bottom))), style)
        });
        let series = chart.draw_series(segments)?;
        if !label.is_empty() {
            series
                .label(*label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 40, y)], style));
        }
    }
    if panel.curves.iter().any(|(label, ..)| !label.is_empty()) {
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
