//! Pictures of triangles in rows, with one key of colours.

use plotters::prelude::*;

use super::canvas::SCALE;
use super::patches::{Colors, Patches};
use super::{Area, Draw, Drawn, key, letters};

/// Rows of pictures of triangles, which share their colours.
pub struct PatchSheet<'a> {
    /// The name of the values.
    pub name: &'a str,
    /// Their colours.
    pub colors: Colors,
    /// One or two pictures a row, from top to bottom; one is as wide as two.
    pub rows: Vec<[Option<Patches<'a>>; 2]>,
}

/// The width of a row, and the height of titles.
const WIDTH: u32 = 1360;
const TITLE: u32 = 40;

impl PatchSheet<'_> {
    /// Pictures in a row.
    fn columns(&self) -> u32 {
        1 + u32::from(self.rows.iter().any(|row| row[1].is_some()))
    }

    fn heights(&self) -> Vec<u32> {
        let height = |row: &[Option<Patches<'_>>; 2]| {
            let heights = row
                .iter()
                .flatten()
                .map(|patches| patches.height(WIDTH / self.columns()));
            heights.max().unwrap_or(0) + TITLE
        };
        self.rows.iter().map(height).collect()
    }
}

impl Draw for PatchSheet<'_> {
    fn size(&self) -> (u32, u32) {
        let height = self.heights().iter().sum::<u32>().max(480);
        (WIDTH + key::WIDTH, height)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, _pixels: bool) -> Drawn<DB> {
        let (fields, beside) = area.split_horizontally(WIDTH * SCALE);
        let mut rest = fields;
        for (row, height) in self.rows.iter().zip(self.heights()) {
            let (own, below) = rest.split_vertically(height * SCALE);
            rest = below;
            for (area, patches) in own
                .split_evenly((1, self.columns() as usize))
                .iter()
                .zip(row)
            {
                let Some(patches) = patches else {
                    continue;
                };
                let (title, field) = area.split_vertically(TITLE * SCALE);
                let left = (24 * SCALE as i32, 10 * SCALE as i32);
                title.draw_text(&patches.title, &letters(26).into_text_style(&title), left)?;
                patches.draw(&field, &self.colors)?;
            }
        }
        key::draw(
            &beside,
            self.name,
            self.colors.range,
            self.colors.logarithmic,
        )
    }
}
