//! The files that pictures are drawn into.

use std::fmt::Display;
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ColorType, ImageEncoder, Rgb, RgbImage};
use plotters::prelude::*;
use plotters::style::register_font;

use super::Draw;
use crate::cli::Problem;
use crate::output::write_whole;

/// The factor by which pictures are drawn larger than they are: coordinates are whole numbers, and pixel edges become
/// soft only when the picture is scaled down.
pub(super) const SCALE: u32 = 3;

pub(super) const FONT: &str = "sans-serif";

pub(super) fn png<D: Draw + ?Sized>(path: &Path, what: &D) -> Result<(), Problem> {
    let (width, height) = what.size();
    let size = (SCALE * width, SCALE * height);
    let failed = |error: &dyn Display| failed(path, error);
    let mut pixels = RgbImage::new(size.0, size.1);
    {
        let area = BitMapBackend::with_buffer(&mut pixels, size).into_drawing_area();
        prepare()?;
        area.fill(&WHITE).map_err(|error| failed(&error))?;
        what.draw(&area, true).map_err(|error| failed(&error))?;
        area.present().map_err(|error| failed(&error))?;
    }
    let smaller = RgbImage::from_fn(width, height, |x, y| mean(&pixels, x, y));
    write_whole(path, |file| {
        let encoder = PngEncoder::new(file);
        Ok(encoder.write_image(&smaller, width, height, ColorType::Rgb8)?)
    })
}

/// The mean of the pixels behind one pixel of the picture.
fn mean(pixels: &RgbImage, x: u32, y: u32) -> Rgb<u8> {
    let mut sums = [0; 3];
    for j in 0..SCALE {
        for i in 0..SCALE {
            let Rgb(color) = pixels.get_pixel(SCALE * x + i, SCALE * y + j);
            for (sum, &value) in sums.iter_mut().zip(color) {
                *sum += u32::from(value);
            }
        }
    }
    let count = SCALE * SCALE;
    Rgb(sums.map(|sum| ((sum + count / 2) / count) as u8))
}

pub(super) fn svg<D: Draw + ?Sized>(path: &Path, what: &D) -> Result<(), Problem> {
    let (width, height) = what.size();
    let size = (SCALE * width, SCALE * height);
    let failed = |error: &dyn Display| failed(path, error);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        prepare()?;
        area.fill(&WHITE).map_err(|error| failed(&error))?;
        what.draw(&area, false).map_err(|error| failed(&error))?;
        area.present().map_err(|error| failed(&error))?;
    }
    let large = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let true_to_scale = format!("width=\"{width}\" height=\"{height}\"");
    let rounded = "stroke-linejoin=\"round\" stroke-linecap=\"round\"";
    // What holds by default takes a third of a map's file.
    let text = text
        .replace(" opacity=\"1\"", "")
        .replace(" stroke=\"none\"", "");
    let text = text.replacen(&large, &format!("{true_to_scale} {rounded}"), 1);
    write_whole(path, |file| Ok(file.write_all(text.as_bytes())?))
}

fn prepare() -> Result<(), Problem> {
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular())
        .map_err(|_| "the built-in font cannot be read".into())
}

fn failed(path: &Path, error: &dyn Display) -> String {
    format!("cannot write {}: {error}", path.display())
}
