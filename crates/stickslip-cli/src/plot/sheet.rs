//! Maps below one another or in pairs, each with a title.

use plotters::prelude::*;

use super::canvas::SCALE;
use super::{Area, Draw, Drawn, Map, key, letters};

/// Maps with titles, one below the other or in pairs.
pub struct Sheet<'a> {
    maps: Vec<(String, Map<'a>)>,
    /// What a sheet without maps says.
    empty: String,
    columns: usize,
    /// The size of a map with its title.
    size: (u32, u32),
}

/// The width and the height of what is beside the field of a map: margins, labels, title.
const BESIDE: (u32, u32) = (158, 162);
/// The width of a map in a pair.
const PAIRED: u32 = 760;
/// The begin of a text without maps.
const LEFT: i32 = 80;

impl<'a> Sheet<'a> {
    /// A sheet of these maps, from top to bottom, which share the colours of the first one.
    pub fn new(maps: Vec<(String, Map<'a>)>) -> Self {
        Self {
            maps,
            empty: String::new(),
            columns: 1,
            size: (1600 - key::WIDTH, 400),
        }
    }

    /// What the sheet says if it has no maps.
    #[must_use]
    pub fn or_says(mut self, empty: impl Into<String>) -> Self {
        self.empty = empty.into();
        self
    }

    /// Pairs of maps whose fields have a ratio of height to width.
    #[must_use]
    pub fn in_pairs(mut self, ratio: f64) -> Self {
        let height = ratio * f64::from(PAIRED - BESIDE.0);
        self.size = (PAIRED, BESIDE.1 + height.round() as u32);
        self.columns = 2;
        self
    }

    fn rows(&self) -> usize {
        self.maps.len().div_ceil(self.columns).max(1)
    }
}

impl Draw for Sheet<'_> {
    fn size(&self) -> (u32, u32) {
        let (width, height) = self.size;
        let height = if self.maps.is_empty() { 120 } else { height };
        let width = width * self.columns as u32 + key::WIDTH;
        (width, height * self.rows() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, _pixels: bool) -> Drawn<DB> {
        let (width, _) = area.dim_in_pixel();
        let (fields, beside) = area.split_horizontally(width - key::WIDTH * SCALE);
        let areas = fields.split_evenly((self.rows(), self.columns));
        for (area, (title, map)) in areas.iter().zip(&self.maps) {
            let left = ((24 + 110) * SCALE as i32, 10 * SCALE as i32);
            area.draw_text(title, &letters(28).into_text_style(area), left)?;
            let (_, below) = area.split_vertically(30 * SCALE);
            map.draw_field(&below)?;
        }
        match self.maps.first() {
            Some((_, map)) => key::draw(&beside, map.names[2], map.range, true),
            None => {
                let middle = (LEFT * SCALE as i32, 40 * SCALE as i32);
                area.draw_text(&self.empty, &letters(28).into_text_style(area), middle)
            }
        }
    }
}
