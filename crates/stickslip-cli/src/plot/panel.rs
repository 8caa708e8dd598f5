//! Curves over one pair of axes.

use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::SCALE;
use super::curve::{Curve, Look, covering};
use super::legend::{self, Entry};
use super::thinned::thinned;
use super::{Area, Drawn, Points, letters};

/// Curves over one pair of axes.
pub struct Panel<'a> {
    names: [&'a str; 2],
    logarithmic: [bool; 2],
    curves: Vec<Curve<'a>>,
    /// The width and height of the axes in pixels, if they have a shape.
    shape: Option<(u32, u32)>,
    title: &'a str,
    /// Whether the vertical axis shows a depth, whose negatives it has.
    downward: bool,
}

/// The columns of a picture, for curves with more points than it can resolve.
const COLUMNS: f64 = 1500.0;
/// The margins of the axes, the labels beside them, and the width that is left for them.
const MARGIN: u32 = 24;
const RIGHT: u32 = 48;
const TITLE: u32 = 40;
const X_LABELS: u32 = 84;
const Y_LABELS: u32 = 140;
const WIDTH: u32 = 1600 - MARGIN - Y_LABELS - RIGHT;
/// The radius of a point, and the lengths of dashes and gaps.
const DOT: u32 = 2;
pub(super) const DASHES: (u32, u32) = (14, 10);
/// The largest height of axes with a shape.
const TALLEST: f64 = 700.0;

impl<'a> Panel<'a> {
    /// Axes with names and units, without curves.
    pub fn new(x: &'a str, y: &'a str) -> Self {
        Self {
            names: [x, y],
            logarithmic: [false; 2],
            curves: Vec::new(),
            shape: None,
            title: "",
            downward: false,
        }
    }

    /// Makes a unit of length equally long on both axes, whose ranges have this ratio of height to width.
    #[must_use]
    pub fn in_ratio(mut self, ratio: f64) -> Self {
        let height = (ratio * f64::from(WIDTH)).clamp(200.0, TALLEST);
        let width = (height / ratio).min(f64::from(WIDTH));
        self.shape = Some((width.round() as u32, height.round() as u32));
        self
    }

    /// Makes the vertical axis logarithmic: values count by their modulus.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic[1] = true;
        self
    }

    /// Makes both axes logarithmic.
    #[must_use]
    pub fn both_logarithmic(mut self) -> Self {
        self.logarithmic = [true; 2];
        self
    }

    /// Adds a curve, with a name for the legend or an empty one.
    #[must_use]
    pub fn with(mut self, label: &'a str, color: RGBColor, width: u32, points: Points) -> Self {
        self.curves.push(Curve {
            label,
            color,
            width,
            look: Look::Line,
            points,
        });
        self
    }

    /// Adds a curve whose points are dots.
    #[must_use]
    pub fn with_dots(mut self, label: &'a str, color: RGBColor, points: Points) -> Self {
        self = self.with(label, color, 3, points);
        if let Some(curve) = self.curves.last_mut() {
            curve.look = Look::Dotted;
        }
        self
    }

    /// Adds data: points without a line.
    #[must_use]
    pub fn with_points(mut self, label: &'a str, color: RGBColor, points: Points) -> Self {
        self = self.with(label, color, 1, points);
        if let Some(curve) = self.curves.last_mut() {
            curve.look = Look::Points;
        }
        self
    }

    /// Adds a title above the axes.
    #[must_use]
    pub fn titled(mut self, title: &'a str) -> Self {
        self.title = title;
        self
    }

    /// Shows depths, whose negatives the vertical axis has: positive and downwards.
    #[must_use]
    pub fn downward(mut self) -> Self {
        self.downward = true;
        self
    }

    /// Whether there are dots: few points that a legend must not cover.
    fn has_dots(&self) -> bool {
        self.curves.iter().any(|curve| curve.look == Look::Dotted)
    }

    /// The names of the named curves.
    fn entries(&self) -> Vec<Entry<'_>> {
        let covering = covering(&self.curves, self.logarithmic[1]);
        let all = self.curves.iter().enumerate();
        let named = all.filter(|(_, curve)| !curve.label.is_empty());
        let entries = named.map(|(k, curve)| Entry {
            label: curve.label,
            color: curve.color,
            width: curve.width,
            look: curve.look,
            dashed: covering[k],
        });
        entries.collect()
    }

    /// In pixels: that of the axes, or of the names beside them.
    pub(super) fn height(&self) -> u32 {
        const AXES: u32 = 620;
        let title = if self.title.is_empty() { 0 } else { TITLE };
        let axes = if let Some((_, height)) = self.shape {
            height + 2 * MARGIN + X_LABELS + legend::HEIGHT
        } else if self.has_dots() {
            AXES.max(legend::height(self.entries().len()))
        } else {
            AXES
        };
        title + axes
    }

    fn is_used(value: f64, logarithmic: bool) -> bool {
        value.is_finite() && (!logarithmic || value != 0.0)
    }

    pub(super) fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let [xs, ys] = self.logarithmic;
        let shown = points().filter(|p| Self::is_used(p.0, xs) && Self::is_used(p.1, ys));
        let tight = !self.has_dots();
        let x = Axis::new(shown.clone().map(|p| p.0.abs_if(xs)), xs, tight);
        let y = Axis::new(shown.map(|p| p.1.abs_if(ys)), ys, false).downward(self.downward);
        let curves: Vec<Points> = (self.curves.iter())
            .map(|curve| {
                let places = curve
                    .points
                    .iter()
                    .filter_map(|p| Some((x.place(p.0.abs_if(xs))?, y.place(p.1.abs_if(ys))?)));
                let places: Points = places.collect();
                if curve.look == Look::Dotted {
                    places
                } else {
                    thinned(&places, COLUMNS)
                }
            })
            .collect();

        let covering = covering(&self.curves, self.logarithmic[1]);
        let (width, entries) = (area.dim_in_pixel().0, self.entries());
        let area = &if self.title.is_empty() {
            area.clone()
        } else {
            let (above, axes) = area.split_vertically(TITLE * SCALE);
            let left = ((MARGIN + Y_LABELS) as i32 * SCALE as i32, 10 * SCALE as i32);
            area.draw_text(self.title, &letters(28).into_text_style(&above), left)?;
            axes
        };
        let area = if entries.is_empty() {
            area.clone()
        } else if self.has_dots() {
            let (axes, beside) = area.split_horizontally(width - legend::WIDTH * SCALE);
            legend::beside(&beside, &entries)?;
            axes
        } else {
            let (above, axes) = area.split_vertically(legend::HEIGHT * SCALE);
            legend::above(&above, &entries)?;
            axes
        };
        let mut chart = ChartBuilder::on(&area)
            .margin(MARGIN * SCALE)
            .margin_right((RIGHT + self.shape.map_or(0, |(width, _)| WIDTH - width)) * SCALE)
            .x_label_area_size(X_LABELS * SCALE)
            .y_label_area_size(Y_LABELS * SCALE)
            .build_cartesian_2d(x.coordinates(), y.coordinates())?;
        chart
            .configure_mesh()
            .max_light_lines(0)
            .bold_line_style(BLACK.mix(0.12).stroke_width(SCALE))
            .axis_style(BLACK.stroke_width(SCALE))
            .set_all_tick_mark_size(6 * SCALE)
            .x_desc(self.names[0])
            .y_desc(self.names[1])
            .axis_desc_style(letters(30))
            .label_style(letters(26))
            .x_label_formatter(&|tick| x.label(*tick))
            .y_label_formatter(&|tick| y.label(*tick))
            .draw()?;
        for (k, (curve, points)) in self.curves.iter().zip(&curves).enumerate() {
            if curve.look == Look::Points {
                let dot = |&p: &(f64, f64)| Circle::new(p, DOT * SCALE, curve.color.filled());
                chart.draw_series(points.iter().map(dot))?;
                continue;
            }
            let style = curve.color.stroke_width(curve.width * SCALE);
            if covering[k] {
                let (dash, gap) = (DASHES.0 * SCALE, DASHES.1 * SCALE);
                let dashes = DashedPathElement::new(points.iter().copied(), dash, gap, style);
                chart.draw_series([dashes])?;
                continue;
            }
            if pixels {
                // Mitred joints become spikes at sharp turns.
                let joint =
                    |&p: &(f64, f64)| Circle::new(p, style.stroke_width / 2, curve.color.filled());
                chart.draw_series(points.iter().map(joint))?;
            }
            let pieces = pieces(points, pixels).into_iter();
            let path = |piece: &[(f64, f64)]| PathElement::new(piece.to_vec(), style);
            chart.draw_series(pieces.map(path))?;
            if curve.look == Look::Dotted {
                let size = (3 + curve.width) * SCALE;
                let dots = points
                    .iter()
                    .map(|&p| Circle::new(p, size, curve.color.filled()));
                chart.draw_series(dots)?;
            }
        }
        Ok(())
    }
}

/// The modulus of a value on a logarithmic axis.
trait AbsIf {
    fn abs_if(self, logarithmic: bool) -> f64;
}

impl AbsIf for f64 {
    fn abs_if(self, logarithmic: bool) -> f64 {
        if logarithmic { self.abs() } else { self }
    }
}

/// The pieces of a curve that are drawn one by one.
fn pieces(points: &[(f64, f64)], pixels: bool) -> Vec<&[(f64, f64)]> {
    if pixels {
        points.windows(2).collect()
    } else {
        vec![points]
    }
}
