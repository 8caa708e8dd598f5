//! Legends with the names of curves, above the axes or beside them.

use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::IntoTextStyle;

use super::canvas::SCALE;
use super::curve::Look;
use super::panel::DASHES;
use super::{Area, Drawn, letters};

/// A name and the look of its curve.
pub(super) struct Entry<'a> {
    pub(super) label: &'a str,
    pub(super) color: RGBColor,
    pub(super) width: u32,
    pub(super) look: Look,
    pub(super) dashed: bool,
}

/// The height of a legend above the axes, and the width of one beside them.
pub(super) const HEIGHT: u32 = 60;
pub(super) const WIDTH: u32 = 560;

/// The start of the axes, the first line of names, and the distance of lines.
const LEFT: u32 = 164;
const TOP: u32 = 48;
const LINE: u32 = 44;
/// The length of a line, and the spaces between it and its name, and after the name.
const DASH: u32 = 44;
const ROOM: u32 = 16;

/// The height of so many names below each other.
pub(super) fn height(names: usize) -> u32 {
    TOP + LINE * names as u32
}

/// Draws the names in one line.
pub(super) fn above<DB: DrawingBackend>(area: &Area<DB>, entries: &[Entry<'_>]) -> Drawn<DB> {
    let mut left = LEFT * SCALE;
    for entry in entries {
        let width = draw(area, entry, (left, (HEIGHT / 2 + 8) * SCALE))?;
        left += width + 3 * ROOM * SCALE;
    }
    Ok(())
}

/// Draws the names below each other.
pub(super) fn beside<DB: DrawingBackend>(area: &Area<DB>, entries: &[Entry<'_>]) -> Drawn<DB> {
    for (k, entry) in entries.iter().enumerate() {
        draw(area, entry, (0, (TOP + LINE * k as u32) * SCALE))?;
    }
    Ok(())
}

/// Draws a line and its name from a point on; returns the width that both take.
fn draw<DB: DrawingBackend>(
    area: &Area<DB>,
    entry: &Entry<'_>,
    (left, y): (u32, u32),
) -> Result<u32, DrawingAreaErrorKind<DB::ErrorType>> {
    let place = |x: u32| ((left + x * SCALE) as i32, y as i32);
    let line = entry.color.stroke_width(entry.width * SCALE);
    let ends = [place(0), place(DASH)];
    if entry.look == Look::Points {
        let dots =
            [0, DASH / 2, DASH].map(|x| Circle::new(place(x), 3 * SCALE, entry.color.filled()));
        dots.iter().try_for_each(|dot| area.draw(dot))?;
    } else if entry.dashed {
        let (dash, gap) = (DASHES.0 * SCALE, DASHES.1 * SCALE);
        area.draw(&DashedPathElement::new(ends, dash, gap, line))?;
    } else {
        area.draw(&PathElement::new(ends, line))?;
    }
    if entry.look == Look::Dotted {
        let size = (3 + entry.width) * SCALE;
        area.draw(&Circle::new(place(DASH / 2), size, entry.color.filled()))?;
    }
    let style = letters(24).into_text_style(area);
    let (width, height) = area.estimate_text_size(entry.label, &style)?;
    let (x, y) = place(DASH + ROOM);
    let corner = (x, y - height as i32 / 2);
    area.draw(&Text::new(entry.label, corner, style))?;
    Ok((DASH + ROOM) * SCALE + width)
}
