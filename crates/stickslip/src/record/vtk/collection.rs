//! The list of files with their times.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use super::file::write_whole;
use super::xml::escaped;
use crate::FileError;

/// The entries of a PVD file.
#[derive(Default)]
pub(super) struct Collection {
    entries: String,
}

impl Collection {
    /// Adds a file next to the list, of a time \[s\]; files with equal times are its parts.
    pub(super) fn add(&mut self, time: f64, part: usize, name: &str) {
        let name = escaped(name);
        // Writing into a string does not fail.
        let _ = writeln!(
            self.entries,
            "<DataSet timestep=\"{time:e}\" part=\"{part}\" file=\"{name}\"/>"
        );
    }

    pub(super) fn write(&self, path: &Path) -> Result<(), FileError> {
        write_whole(path, |file| {
            write!(
                file,
                "<?xml version=\"1.0\"?>\n\
                 <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
                 <Collection>\n{}</Collection>\n</VTKFile>\n",
                self.entries
            )
        })
    }
}
