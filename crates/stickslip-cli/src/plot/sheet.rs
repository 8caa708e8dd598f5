//! Maps below one another or in pairs, each with a title.

use plotters::prelude::*;

use super::canvas::SCALE;
use super::{Area, Draw, Drawn, Map, key, letters};

/// Maps with titles, one below the other or in pairs.
pub struct Sheet<'a> {
    maps: Vec<(String, Map<'a>)>,
    columns: usize,
    /// The size of a map with its title.
    size: (u32, u32),
}

/// The width and the height of what is beside the field of a map: margins, labels, key, title.
const BESIDE: (u32, u32) = (key::WIDTH + 158, 162);
/// The width of a map in a pair.
const PAIRED: u32 = 1000;

impl<'a> Sheet<'a> {
    /// A sheet of these maps, from top to bottom.
    pub fn new(maps: Vec<(String, Map<'a>)>) -> Self {
        Self {
            maps,
            columns: 1,
            size: (1600, 400),
        }
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
        (width * self.columns as u32, height * self.rows() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        let areas = area.split_evenly((self.rows(), self.columns));
        for (area, (title, map)) in areas.iter().zip(&self.maps) {
            let left = ((24 + 110) * SCALE as i32, 10 * SCALE as i32);
            area.draw_text(title, &letters(28).into_text_style(area), left)?;
            let (_, below) = area.split_vertically(30 * SCALE);
            map.draw(&below, pixels)?;
        }
        Ok(())
    }
}
