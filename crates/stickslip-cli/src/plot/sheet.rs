//! Maps below one another, each with a title.

use plotters::prelude::*;

use super::canvas::SCALE;
use super::{Area, Draw, Drawn, Map, letters};

/// Maps with titles, one below the other.
pub struct Sheet<'a> {
    maps: Vec<(String, Map<'a>)>,
}

/// The height of a map with its title.
const HEIGHT: u32 = 400;

impl<'a> Sheet<'a> {
    /// A sheet of these maps, from top to bottom.
    pub fn new(maps: Vec<(String, Map<'a>)>) -> Self {
        Self { maps }
    }
}

impl Draw for Sheet<'_> {
    fn size(&self) -> (u32, u32) {
        (1600, HEIGHT * self.maps.len().max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pixels: bool) -> Drawn<DB> {
        let areas = area.split_evenly((self.maps.len().max(1), 1));
        for (area, (title, map)) in areas.iter().zip(&self.maps) {
            let left = ((24 + 110) * SCALE as i32, 10 * SCALE as i32);
            area.draw_text(title, &letters(28).into_text_style(area), left)?;
            let (_, below) = area.split_vertically(30 * SCALE);
            map.draw(&below, pixels)?;
        }
        Ok(())
    }
}
