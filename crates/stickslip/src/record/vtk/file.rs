//! Files that are written completely or not at all.

use std::fs::{File, remove_file, rename};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use crate::FileError;

/// Writes a temporary file, which then replaces the one at `path`: a viewer never opens an incomplete file.
pub(super) fn write_whole(
    path: &Path,
    contents: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), FileError> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".new");
    let written = File::create(&beside)
        .and_then(|file| {
            let mut file = BufWriter::new(file);
            contents(&mut file)?;
            file.flush()
        })
        .and_then(|()| rename(&beside, path));
    written.map_err(|source| {
        // The error that counts is the first one.
        let _ = remove_file(&beside);
        FileError::Write {
            path: Some(path.into()),
            source,
        }
    })
}
