//! A payload in a file that is written completely or not at all.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use xxhash_rust::xxh3::Xxh3Default;

use crate::FileError;
use crate::marks::{CheckpointMismatch, Mark, compare};

/// The header of a kind of file.
pub(crate) struct Format {
    /// The name of the kind in messages.
    pub(crate) kind: &'static str,
    /// The magic number. No text begins with it: the first byte is not ASCII, and a transfer as text changes its line
    /// ends.
    pub(crate) magic: [u8; 8],
    /// The format version. It changes with every change of the payload's layout.
    pub(crate) version: u32,
}

const BEGIN: usize = size_of::<[u8; 8]>() + size_of::<u32>();
const HEADER: usize = BEGIN + size_of::<u128>();

/// The checksum of header and payload, without itself.
fn checksum(begin: &[u8], payload: &[u8]) -> [u8; 16] {
    let mut hash = Xxh3Default::new();
    hash.update(begin);
    hash.update(payload);
    hash.digest128().to_le_bytes()
}

impl Format {
    fn begin(&self) -> [u8; BEGIN] {
        let mut begin = [0; BEGIN];
        begin[..self.magic.len()].copy_from_slice(&self.magic);
        begin[self.magic.len()..].copy_from_slice(&self.version.to_le_bytes());
        begin
    }

    /// Reads a payload that is at most as large as its file.
    pub(crate) fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let unread = |source| FileError::Read {
            path: path.into(),
            source,
        };
        let damaged = || FileError::Damaged { path: path.into() };
        let mut file = File::open(path).map_err(unread)?;
        let mut header = Vec::with_capacity(HEADER);
        (&mut file)
            .take(HEADER as u64)
            .read_to_end(&mut header)
            .map_err(unread)?;
        if !header.starts_with(&self.magic) {
            return Err(FileError::Kind {
                path: path.into(),
                kind: self.kind,
            });
        }
        let (begin, sum) = header.split_at_checked(BEGIN).ok_or_else(damaged)?;
        let version = begin[self.magic.len()..].try_into();
        let found = u32::from_le_bytes(version.map_err(|_| damaged())?);
        if found != self.version {
            return Err(FileError::Version {
                path: path.into(),
                kind: self.kind,
                found,
                expected: self.version,
            });
        }
        let mut payload = Vec::new();
        file.read_to_end(&mut payload).map_err(unread)?;
        if sum != checksum(begin, &payload) {
            return Err(damaged());
        }
        Ok(payload)
    }

    /// Writes a payload to a temporary file beside `path`, which then replaces the file at `path`.
    pub(crate) fn write(&self, path: &Path, payload: &[u8]) -> Result<(), FileError> {
        replace(path, &self.begin(), payload).map_err(|source| FileError::Write {
            path: Some(path.into()),
            source,
        })
    }

    /// Refuses a file whose marks differ from the expected ones.
    pub(crate) fn compare(
        &self,
        path: &Path,
        found: &[Mark],
        expected: &[Mark],
    ) -> Result<(), FileError> {
        let Err(CheckpointMismatch {
            what,
            found,
            expected,
        }) = compare(found, expected)
        else {
            return Ok(());
        };
        Err(FileError::Mismatch {
            path: path.into(),
            kind: self.kind,
            what,
            found,
            expected,
        })
    }
}

fn replace(path: &Path, begin: &[u8], payload: &[u8]) -> io::Result<()> {
    let path = resolve(path)?;
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".new");
    let beside = path.with_file_name(name);
    let written = write_all(&beside, begin, payload).and_then(|()| fs::rename(&beside, &path));
    if written.is_err() {
        // The error that counts is the first one.
        let _ = fs::remove_file(&beside);
    }
    written?;
    // The name, too, survives a loss of power, on systems where a folder can be flushed.
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    if let Ok(folder) = File::open(folder.unwrap_or(Path::new("."))) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// The target of a symbolic link; refuses an existing path that is not a file, such as a device or a folder.
fn resolve(path: &Path) -> io::Result<PathBuf> {
    let refused = |what| Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    match fs::metadata(path) {
        Ok(found) if found.is_file() => fs::canonicalize(path),
        Ok(_) => refused("it is not a file"),
        Err(_) if path.file_name().is_none() => refused("it is not the name of a file"),
        Err(_) => Ok(path.into()),
    }
}

fn write_all(path: &Path, begin: &[u8], payload: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(begin)?;
    file.write_all(&checksum(begin, payload))?;
    file.write_all(payload)?;
    file.sync_all()
}
