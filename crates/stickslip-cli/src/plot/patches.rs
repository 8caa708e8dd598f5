//! Triangles in colours, in the plane of the picture, without axes or with axes of one scale.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::canvas::SCALE;
use super::{Area, Drawn, Points, key, letters};

/// The range of colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colors {
    /// The values at the ends; those beyond have the colour of the end.
    pub range: (f64, f64),
    /// Whether equal ratios have equal distances.
    pub logarithmic: bool,
}

/// Triangles of the plane, each with one value, with lines and texts over them. Units are equally long in both directions.
pub struct Patches<'a> {
    /// What it shows.
    pub title: String,
    /// The corners of each triangle, in the order in which they are drawn.
    pub triangles: &'a [[[f64; 2]; 3]],
    /// Their values.
    pub values: Vec<f64>,
    /// Lines behind the triangles, with their width.
    pub behind: Vec<(u32, Points)>,
    /// Lines over the triangles, with their width.
    pub above: Vec<(u32, Points)>,
    /// Texts about points.
    pub texts: Vec<((f64, f64), String)>,
    /// The names of the axes, if it has any; the second one is the negative of a depth.
    pub names: Option<[&'a str; 2]>,
}

/// The margin, and the widths of the labels of an axis.
const MARGIN: u32 = 24;
const LABELS: [u32; 2] = [100, 84];
/// The room for texts beside and below a picture without axes, as a share of its size.
const ROOM: [f64; 2] = [0.2, 0.12];
const BEHIND: RGBColor = RGBColor(190, 190, 190);

impl Colors {
    fn of(&self, value: f64) -> RGBColor {
        if self.logarithmic {
            let logarithm = value.max(f64::MIN_POSITIVE).log10();
            return key::color(key::level(logarithm, self.range));
        }
        let (low, high) = self.range;
        key::shade((value - low) / (high - low))
    }
}

impl Patches<'_> {
    /// The extent of all that is drawn: low and high, along both axes.
    fn extent(&self) -> [[f64; 2]; 2] {
        let lines = self.behind.iter().chain(&self.above);
        let of_lines = lines.flat_map(|(_, points)| points.iter().map(|&(x, y)| [x, y]));
        let points = self.triangles.iter().flatten().copied().chain(of_lines);
        let none = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let wider = |ends: [[f64; 2]; 2], point: [f64; 2]| {
            [0, 1].map(|c| [ends[c][0].min(point[c]), ends[c][1].max(point[c])])
        };
        points.fold(none, wider)
    }

    /// The height of the picture with its title for a width \[pixels\].
    pub(super) fn height(&self, width: u32) -> u32 {
        let [x, y] = self.extent().map(|[low, high]| high - low);
        let [beside, below] = self.names.map_or([0, 0], |_| LABELS);
        let field = f64::from(width - beside - 2 * MARGIN);
        let height = (field * y / x.max(1e-300)).clamp(140.0, 520.0);
        height.round() as u32 + below + 2 * MARGIN
    }

    pub(super) fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, colors: &Colors) -> Drawn<DB> {
        let [x, y] = self.extent();
        let has_axes = self.names.is_some();
        let axes = [(x, ROOM[0]), (y, ROOM[1])].map(|([low, high], share)| {
            let room = if has_axes { 0.0 } else { share * (high - low) };
            Axis::new([low - room, high + room].into_iter(), false, true)
        });
        let [x, y] = [axes[0].clone(), axes[1].clone().downward(true)];
        let labels = if has_axes { LABELS } else { [0, 0] };
        let (width, height) = area.dim_in_pixel();
        let field = [width, height].map(|size| f64::from(size / SCALE - 2 * MARGIN));
        let field = [0, 1].map(|c| (field[c] - f64::from(labels[c])).max(1.0));
        let spans = [&x, &y].map(|axis| axis.range.end - axis.range.start);
        let scale = (field[0] / spans[0]).min(field[1] / spans[1]);
        let [right, bottom] = [0, 1].map(|c| (field[c] - scale * spans[c]).max(0.0) as u32);
        // Without axes it is in the middle.
        let [left, right] = if has_axes { [0, right] } else { [right / 2; 2] };
        let mut chart = ChartBuilder::on(area)
            .margin(MARGIN * SCALE)
            .margin_left((MARGIN + left) * SCALE)
            .margin_right((MARGIN + right) * SCALE)
            .margin_bottom((MARGIN + bottom) * SCALE)
            .x_label_area_size(labels[1] * SCALE)
            .y_label_area_size(labels[0] * SCALE)
            .build_cartesian_2d(x.coordinates(), y.coordinates())?;
        let lines = |lines: &[(u32, Points)], color: RGBColor| {
            let line = |(width, points): &(u32, Points)| {
                PathElement::new(points.clone(), color.stroke_width(width * SCALE))
            };
            lines.iter().map(line).collect::<Vec<_>>()
        };
        chart.draw_series(lines(&self.behind, BEHIND))?;
        for (corners, value) in self.triangles.iter().zip(&self.values) {
            let color = colors.of(*value);
            let [a, b, c] = corners.map(|[x, y]| (x, y));
            // The rim closes the seams between neighbours.
            chart.draw_series([Polygon::new(vec![a, b, c], color.filled())])?;
            chart.draw_series([PathElement::new(vec![a, b, c, a], color.stroke_width(1))])?;
        }
        chart.draw_series(lines(&self.above, BLACK))?;
        let middle = Pos::new(HPos::Center, VPos::Center);
        let style = letters(22).into_text_style(area).pos(middle);
        let texts = self.texts.iter();
        chart.draw_series(
            texts.map(|(place, text)| Text::new(text.clone(), *place, style.clone())),
        )?;
        let Some(names) = self.names else {
            return Ok(());
        };
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(BLACK.stroke_width(SCALE))
            .set_all_tick_mark_size(6 * SCALE)
            .x_desc(names[0])
            .y_desc(names[1])
            .axis_desc_style(letters(26))
            .label_style(letters(24))
            .x_label_formatter(&|tick| x.label(*tick))
            .y_label_formatter(&|tick| y.label(*tick))
            .draw()
    }
}
