//! Pictures of curves and of fields in space and time: PNG and SVG, fit for print.

mod axis;
mod canvas;
mod contours;
mod curve;
mod key;
mod label;
mod legend;
mod map;
mod panel;
mod patch_sheet;
mod patches;
mod scatter;
mod sheet;
mod thinned;
mod ticks;

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

pub use contours::{contours, interval};
pub use map::Map;
pub use panel::Panel;
pub use patch_sheet::PatchSheet;
pub use patches::{Colors, Patches};
pub use plotters::style::RGBColor;
pub use scatter::Scatter;
pub use sheet::Sheet;

use crate::cli::Problem;
use canvas::SCALE;

/// The colour of an exact or an older curve.
pub const PALE: RGBColor = RGBColor(240, 150, 60);
/// The colour of the curve in question.
pub const DARK: RGBColor = RGBColor(25, 70, 140);
/// Colours that readers with any colour vision tell apart (M. Okabe, K. Ito, Color Universal Design, 2008).
pub const COLORS: [RGBColor; 7] = [
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(0, 0, 0),
];

/// Points of a curve in its order; those outside the axes are left out.
pub type Points = Vec<(f64, f64)>;

/// A picture.
pub trait Draw {
    /// Its width and height in pixels of a PNG file.
    fn size(&self) -> (u32, u32);

    /// Draws it; with `pixels` joints of lines have to be rounded one by one.
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB>;
}

/// The colour of a share of a range, in an order that readers with any colour vision see.
pub fn shade(share: f64) -> RGBColor {
    key::shade(share)
}

type Area<DB> = DrawingArea<DB, Shift>;
type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// Draws into the file `name.png`, and into `name.svg` beside it.
///
/// # Errors
/// A file cannot be written.
pub fn draw<D: Draw + ?Sized>(path: &Path, what: &D) -> Result<(), Problem> {
    canvas::png(path, what)?;
    canvas::svg(&path.with_extension("svg"), what)
}

/// Draws into the files `name.png` and `name.svg` of a folder.
pub fn print<D: Draw + ?Sized>(folder: &Path, name: &str, what: &D) -> Result<(), Problem> {
    canvas::png(&folder.join(format!("{name}.png")), what)?;
    canvas::svg(&folder.join(format!("{name}.svg")), what)
}

/// Panels, one above the other.
impl<const N: usize> Draw for [Panel<'_>; N] {
    fn size(&self) -> (u32, u32) {
        self.as_slice().size()
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        self.as_slice().draw(area, pixels)
    }
}

impl Draw for [Panel<'_>] {
    fn size(&self) -> (u32, u32) {
        (1600, self.iter().map(Panel::height).sum())
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        let mut rest = area.clone();
        self.iter().try_for_each(|panel| {
            let (own, below) = rest.split_vertically(panel.height() * SCALE);
            rest = below;
            panel.draw(&own, pixels)
        })
    }
}

/// Letters so many pixels high.
fn letters(size: u32) -> (&'static str, u32) {
    (canvas::FONT, size * SCALE)
}
