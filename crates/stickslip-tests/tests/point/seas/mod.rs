//! Files in the format of the SEAS benchmarks, and arrays of NumPy: what was written reads back.

mod arrays;
mod events;
mod files;
mod fluid;
mod layouts;
mod lines;
mod planes;
mod refusals;

use std::path::{Path, PathBuf};

use stickslip::RungeKutta;
use stickslip::bie::{Cells, Fault};
use stickslip::problems::bp1;
use stickslip::record::{FileError, SeasHeader, SeasTable};

use crate::Outcome;

const YEAR: f64 = 3.15576e7;

/// BP1-QD with cells of this length \[m\].
fn bp1_cycle(cell: f64) -> Outcome<RungeKutta<1>> {
    let cells = Cells::new([0.0, bp1::DEPTH], (bp1::DEPTH / cell) as usize)?;
    let fault = Fault::half_space(cells, bp1::MEDIUM)?;
    Ok(RungeKutta::new(bp1::scene(&fault))?)
}

fn header() -> SeasHeader {
    SeasHeader::new("SEAS Benchmark BP1-QD").with("modeler", "J. Rice")
}

fn parse(file: &[u8]) -> Result<SeasTable, FileError> {
    SeasTable::parse(file, Path::new("written"))
}

/// Whether two columns agree to 1e-10.
fn agree(found: &[f64], expected: &[f64]) -> bool {
    let pairs = found.iter().zip(expected);
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-10 * b.abs();
    found.len() == expected.len() && pairs.into_iter().all(close)
}

/// A folder that is removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> std::io::Result<Self> {
        let path =
            std::env::temp_dir().join(format!("stickslip-seas-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path)?;
        Ok(Self(path))
    }

    fn join(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
