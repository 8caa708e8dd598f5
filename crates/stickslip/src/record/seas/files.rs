//! The files of a run in the format of the SEAS benchmarks, while it runs.

use std::fs::File;
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::PathBuf;

#[cfg(doc)]
use super::SeasFolder;
use super::{SeasGlobal, SeasHeader, SeasProfile, SeasStation};
use crate::Snapshot;
use crate::record::{FileError, RuptureTimes};

/// The files of a run, made by [`SeasFolder::create`].
#[derive(Debug)]
pub struct SeasFiles {
    pub(super) folder: PathBuf,
    pub(super) header: SeasHeader,
    pub(super) stations: Vec<SeasStation<File>>,
    pub(super) global: SeasGlobal<File>,
    pub(super) profiles: Vec<SeasProfile<File>>,
    pub(super) ruptures: RuptureTimes,
}

impl SeasFiles {
    /// Records a step; ends the run on a write error, which [`finish`](Self::finish) returns.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        for station in &mut self.stations {
            station.record(at)?;
        }
        self.global.record(at)?;
        for profile in &mut self.profiles {
            profile.record(at)?;
        }
        self.ruptures.record(at);
        ControlFlow::Continue(())
    }

    /// Writes the buffered rows, and the rupture times of the first event.
    ///
    /// # Errors
    /// [`FileError::Write`], also that of a step.
    pub fn finish(self) -> Result<(), FileError> {
        for station in self.stations {
            station.finish()?;
        }
        self.global.finish()?;
        for profile in self.profiles {
            profile.finish()?;
        }
        let first = self.ruptures.events().first();
        let Some(rupture) = first.or(self.ruptures.under_way()) else {
            return Ok(());
        };
        let path = self.folder.join("rupture.dat");
        let file = File::create(&path).map_err(|source| FileError::Write {
            path: Some(path),
            source,
        })?;
        let rows = BufWriter::new(file);
        self.ruptures.write(rupture, &self.header, rows)?;
        Ok(())
    }
}
