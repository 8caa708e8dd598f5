//! A payload in a file that is there as a whole or not at all.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use xxhash_rust::xxh3::Xxh3Default;

use super::CheckpointError;

/// How a checkpoint begins. No text does: the first byte is none of ASCII, and line ends do not survive a transfer as
/// text.
const MAGIC: [u8; 8] = *b"\x89slip\r\n\x1a";
/// Changes with everything that the payload is made of.
const FORMAT: u32 = 1;

const BEGIN: usize = MAGIC.len() + size_of::<u32>();
const HEADER: usize = BEGIN + size_of::<u128>();

/// The checksum of everything but itself.
fn checksum(begin: &[u8], payload: &[u8]) -> [u8; 16] {
    let mut hash = Xxh3Default::new();
    hash.update(begin);
    hash.update(payload);
    hash.digest128().to_le_bytes()
}

/// Reads a payload, of at most the size of its file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, CheckpointError> {
    let path = || path.to_path_buf();
    let unreadable = |source| CheckpointError::Read {
        path: path(),
        source,
    };
    let mut file = File::open(path()).map_err(unreadable)?;
    let mut header = Vec::with_capacity(HEADER);
    (&mut file)
        .take(HEADER as u64)
        .read_to_end(&mut header)
        .map_err(unreadable)?;
    if !header.starts_with(&MAGIC) {
        return Err(CheckpointError::NotACheckpoint { path: path() });
    }
    let damaged = || CheckpointError::Damaged { path: path() };
    let (begin, sum) = header.split_at_checked(BEGIN).ok_or_else(damaged)?;
    let format = begin[MAGIC.len()..].try_into().map_err(|_| damaged())?;
    let found = u32::from_le_bytes(format);
    if found != FORMAT {
        return Err(CheckpointError::Version {
            path: path(),
            found,
            expected: FORMAT,
        });
    }
    let mut payload = Vec::new();
    file.read_to_end(&mut payload).map_err(unreadable)?;
    if sum != checksum(begin, &payload) {
        return Err(damaged());
    }
    Ok(payload)
}

/// Writes a payload to a file beside `path` that then takes its place.
pub(super) fn write(path: &Path, payload: &[u8]) -> Result<(), CheckpointError> {
    replace(path, payload).map_err(|source| CheckpointError::Write {
        path: path.into(),
        source,
    })
}

fn replace(path: &Path, payload: &[u8]) -> io::Result<()> {
    let path = resolve(path)?;
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".new");
    let beside = path.with_file_name(name);
    let written = write_all(&beside, payload).and_then(|()| fs::rename(&beside, &path));
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

/// The file that a link leads to; refuses what is there and is no file, as a device or a folder.
fn resolve(path: &Path) -> io::Result<PathBuf> {
    let refused = |what| Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    match fs::metadata(path) {
        Ok(found) if found.is_file() => fs::canonicalize(path),
        Ok(_) => refused("it is not a file"),
        Err(_) if path.file_name().is_none() => refused("it is not the name of a file"),
        Err(_) => Ok(path.into()),
    }
}

fn write_all(path: &Path, payload: &[u8]) -> io::Result<()> {
    let mut begin = [0; BEGIN];
    begin[..MAGIC.len()].copy_from_slice(&MAGIC);
    begin[MAGIC.len()..].copy_from_slice(&FORMAT.to_le_bytes());
    let mut file = File::create(path)?;
    file.write_all(&begin)?;
    file.write_all(&checksum(&begin, payload))?;
    file.write_all(payload)?;
    file.sync_all()
}
