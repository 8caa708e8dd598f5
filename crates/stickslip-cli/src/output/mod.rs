//! The output folder of a program.

mod cell;
#[macro_use]
mod say;
mod whole;

use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use stickslip::record::{Event, Table};

use crate::cli::Problem;

pub use cell::{Cell, digits, number};
pub use say::{note, print};
pub(crate) use whole::write_whole;

/// Where a command writes to, and with how many digits.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct Files {
    /// The folder to write to [default: out/COMMAND]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write numbers to tables with all digits, which read as the same numbers [default: 10 digits; times have all]
    #[arg(long)]
    full_precision: bool,
}

impl Files {
    /// The folder, `out/` and a name unless the command line says another.
    pub fn folder(&self, name: &str) -> PathBuf {
        let default = || Path::new("out").join(name);
        self.out.clone().unwrap_or_else(default)
    }
}

impl Files {
    /// Creates the folder of a command, with this name by default, for these files.
    ///
    /// # Errors
    /// As [`Output::create`].
    pub fn create(&self, name: &str, names: &[&str]) -> Result<Output, Problem> {
        let output = Output::create(&self.folder(name), names)?;
        Ok(Output {
            full_precision: self.full_precision,
            ..output
        })
    }

    /// Refuses a folder that cannot be created or written to, before a run, without creating it.
    ///
    /// # Errors
    /// In one line: there is a file in its place, or no file can be written there.
    pub fn probe(&self, name: &str) -> Result<(), Problem> {
        let folder = self.folder(name);
        let mut ancestors = folder.ancestors().filter(|path| path.exists());
        let existing = ancestors.next().unwrap_or(Path::new("."));
        if !existing.is_dir() {
            return Err(format!("--out: {} is not a folder", existing.display()).into());
        }
        tempfile::tempfile_in(existing)
            .map_err(|error| format!("--out: cannot write to {}: {error}", existing.display()))?;
        Ok(())
    }
}

/// A folder and its files, each of which is whole or not there.
pub struct Output {
    folder: PathBuf,
    full_precision: bool,
}

impl Output {
    /// Creates the folder for these files: one that cannot hold them fails at once.
    ///
    /// # Errors
    /// The folder cannot be created or written to, or holds a folder with the name of a file.
    pub fn create(folder: &Path, names: &[&str]) -> Result<Self, Problem> {
        create_dir_all(folder).map_err(|error| {
            format!("--out: cannot create folder {}: {error}", folder.display())
        })?;
        tempfile::tempfile_in(folder)
            .map_err(|error| format!("--out: cannot write to {}: {error}", folder.display()))?;
        for path in names.iter().map(|name| folder.join(name)) {
            if path.is_dir() {
                return Err(format!("--out: {} is a folder, not a file", path.display()).into());
            }
        }
        Ok(Self {
            folder: folder.into(),
            full_precision: false,
        })
    }

    /// The folder of this name within this one.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn within(&self, name: &str) -> Result<Self, Problem> {
        let output = Self::create(&self.folder.join(name), &[])?;
        Ok(Self {
            full_precision: self.full_precision,
            ..output
        })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The path of the file `name`.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The names of files, and the folder that they are in, for a reader; pictures are there as SVG, too.
    pub fn told(&self, names: &[&str]) -> String {
        let names = names.iter().map(|name| match name.strip_suffix(".png") {
            Some(_) => format!("{name} and .svg"),
            None => (*name).to_owned(),
        });
        let names: Vec<String> = names.collect();
        format!("{} in {}", names.join(", "), self.folder.display())
    }

    /// The empty file `name`, for rows that are written as a run goes.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn file(&self, name: &str) -> Result<BufWriter<File>, Problem> {
        let path = self.path(name);
        let file = File::create(&path)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        Ok(BufWriter::new(file))
    }

    /// Writes `value` as JSON; numbers that are not finite become `null`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn json(&self, name: &str, value: &impl Serialize) -> Result<(), Problem> {
        let mut text = serde_json::to_vec_pretty(value)?;
        text.push(b'\n');
        write_whole(&self.path(name), |file| Ok(file.write_all(&text)?))
    }

    /// Writes a table; `NaN` marks missing values. Columns of time have all digits.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn table<R, F>(
        &self,
        name: &str,
        columns: &str,
        rows: impl IntoIterator<Item = R>,
    ) -> Result<(), Problem>
    where
        R: IntoIterator<Item = F>,
        F: Into<Cell>,
    {
        let columns: Vec<&str> = columns.split(',').collect();
        // Steps in an event are shorter than ten digits of a time of centuries tell.
        let all = |name: &&str| self.full_precision || cell::TIMES.contains(name);
        let all: Vec<bool> = columns.iter().map(all).collect();
        write_whole(&self.path(name), |file| {
            let mut table = csv::Writer::from_writer(file);
            table.write_record(&columns)?;
            for row in rows {
                for (cell, &all) in row.into_iter().zip(&all) {
                    table.write_field(cell.into().text(all))?;
                }
                table.write_record(None::<&[u8]>)?;
            }
            Ok(table.flush()?)
        })
    }

    /// Writes a catalogue of events.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn events<'a>(
        &self,
        name: &str,
        events: impl IntoIterator<Item = &'a Event>,
    ) -> Result<(), Problem> {
        write_whole(&self.path(name), |file| {
            let mut table = Table::new(file, &Event::COLUMNS)?;
            for event in events {
                table.row(event.entries())?;
            }
            table.finish()?;
            Ok(())
        })
    }
}
