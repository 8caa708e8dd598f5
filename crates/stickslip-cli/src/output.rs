//! The output folder of a program.

use std::fs::{File, create_dir_all};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::Problem;

/// A folder and its files.
pub struct Output {
    folder: PathBuf,
}

impl Output {
    /// Creates the folder and `files` in it: a file that cannot be written fails at once.
    pub fn create(folder: &Path, files: &[&str]) -> Result<Self, Problem> {
        create_dir_all(folder)
            .map_err(|error| format!("cannot create folder {}: {error}", folder.display()))?;
        let output = Self {
            folder: folder.into(),
        };
        for name in files {
            output.file(name)?;
        }
        Ok(output)
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The path of the file `name`.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The empty file `name`.
    pub fn file(&self, name: &str) -> Result<BufWriter<File>, Problem> {
        let path = self.path(name);
        let file = File::create(&path)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        Ok(BufWriter::new(file))
    }

    /// Writes `value` as JSON; numbers that are not finite become `null`.
    pub fn json(&self, name: &str, value: &impl Serialize) -> Result<(), Problem> {
        let mut file = self.file(name)?;
        serde_json::to_writer_pretty(&mut file, value)?;
        writeln!(file)?;
        file.flush()?;
        Ok(())
    }

    /// Writes a table; `NaN` marks missing values.
    pub fn table<R, F>(
        &self,
        name: &str,
        columns: &str,
        rows: impl IntoIterator<Item = R>,
    ) -> Result<(), Problem>
    where
        R: IntoIterator<Item = F>,
        F: AsRef<[u8]>,
    {
        let mut table = csv::Writer::from_writer(self.file(name)?);
        table.write_record(columns.split(','))?;
        for row in rows {
            table.write_record(row)?;
        }
        table.flush()?;
        Ok(())
    }
}

/// All digits of a number: parsing them returns the same number.
pub fn digits(value: f64) -> String {
    format!("{value:.16e}")
}
