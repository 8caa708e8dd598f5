//! Arrays in NumPy's file format.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::Path;

use super::check::require;
use crate::{FileError, SceneError};

const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// The kind of file that this module reads.
const KIND: &str = "NumPy array of little-endian f64 in C order";
/// The data begin at a multiple of this number of bytes.
const ALIGNED: usize = 64;

/// An array of f64 in the file format of NumPy (`.npy`, format 1.0, little endian, C order).
///
/// ```
/// use stickslip::record::NpyArray;
///
/// # let path = std::env::temp_dir().join(format!("stickslip-npy-{}.npy", std::process::id()));
/// let slip = NpyArray::new(&[2, 3], vec![0.0, 0.1, 0.2, 1.0, 1.1, 1.2])?;
/// slip.save(&path)?;
/// // In Python: numpy.load("slip.npy")
/// let read = NpyArray::read(&path)?;
/// assert_eq!((read.shape(), read.values()), (&[2, 3][..], slip.values()));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias = "NumPy")]
pub struct NpyArray {
    shape: Vec<usize>,
    values: Vec<f64>,
}

impl NpyArray {
    /// An array of this shape; the last index runs fastest.
    ///
    /// # Errors
    /// [`SceneError::Value`] if the number of values is not the product of the shape.
    pub fn new(shape: &[usize], values: Vec<f64>) -> Result<Self, SceneError> {
        let requirement = "the product of the lengths along all axes";
        let legal = product(shape) == Some(values.len());
        require("number of values", requirement, values.len() as f64, legal)?;
        let shape = shape.to_vec();
        Ok(Self { shape, values })
    }

    /// The lengths along its axes.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// The values; the last index runs fastest.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Writes a file.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        save(path.as_ref(), &self.shape, &self.values)
    }

    /// Reads a file of format 1 to 3.
    ///
    /// # Errors
    /// [`FileError::Read`], also for a file that ends before its data; [`FileError::Kind`] for another file, other
    /// numbers or another order.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let unread = |source| FileError::Read {
            path: path.into(),
            source,
        };
        let other = || FileError::Kind {
            path: path.into(),
            kind: KIND,
        };
        let mut file = BufReader::new(File::open(path).map_err(unread)?);
        let mut begin = [0; 8];
        let length = file.read_exact(&mut begin);
        length.map_err(|_| other())?;
        if !begin.starts_with(MAGIC) || !(1..=3).contains(&begin[6]) {
            return Err(other());
        }
        // Two bytes in format 1, four in later ones.
        let mut length = [0; 4];
        let bytes = if begin[6] == 1 { 2 } else { 4 };
        file.read_exact(&mut length[..bytes]).map_err(unread)?;
        let mut header = Vec::new();
        let length = u64::from(u32::from_le_bytes(length));
        let found = (&mut file).take(length).read_to_end(&mut header);
        found.map_err(unread)?;
        let header = String::from_utf8_lossy(&header);
        let shape = shape(&header).ok_or_else(other)?;
        let count = product(&shape).ok_or_else(other)?;
        let mut data = Vec::new();
        let bytes = (count as u64).saturating_mul(8);
        file.take(bytes).read_to_end(&mut data).map_err(unread)?;
        if data.len() as u64 != bytes {
            return Err(unread(io::ErrorKind::UnexpectedEof.into()));
        }
        let numbers = data.chunks_exact(8).map(|bytes| {
            let mut number = [0; 8];
            number.copy_from_slice(bytes);
            f64::from_le_bytes(number)
        });
        let values = numbers.collect();
        Ok(Self { shape, values })
    }
}

impl From<&[f64]> for NpyArray {
    /// An array with one axis.
    fn from(values: &[f64]) -> Self {
        Self {
            shape: vec![values.len()],
            values: values.to_vec(),
        }
    }
}

fn product(shape: &[usize]) -> Option<usize> {
    shape.iter().try_fold(1_usize, |n, m| n.checked_mul(*m))
}

/// The shape in a header of f64, little endian and in C order.
fn shape(header: &str) -> Option<Vec<usize>> {
    let after = |key: &str| {
        let (_, rest) = header.split_once(key)?;
        let (_, value) = rest.split_once(':')?;
        Some(value.trim_start())
    };
    let numbers = after("descr")?.trim_start_matches(['\'', '"']);
    if !numbers.starts_with("<f8") || !after("fortran_order")?.starts_with("False") {
        return None;
    }
    let (inside, _) = after("shape")?.strip_prefix('(')?.split_once(')')?;
    let lengths = inside.split(',').map(str::trim);
    let lengths = lengths.filter(|length| !length.is_empty());
    lengths.map(|length| length.parse().ok()).collect()
}

/// Writes values of a shape in format 1.0.
pub(super) fn save(path: &Path, shape: &[usize], values: &[f64]) -> Result<(), FileError> {
    write(path, shape, values).map_err(|source| FileError::Write {
        path: Some(path.into()),
        source,
    })
}

fn write(path: &Path, shape: &[usize], values: &[f64]) -> io::Result<()> {
    let lengths: Vec<String> = shape.iter().map(|length| format!("{length},")).collect();
    let lengths = lengths.join(" ");
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
    // Magic number, version, length, and the line end of the header.
    let before = MAGIC.len() + 4;
    let end = (before + header.len() + 1).next_multiple_of(ALIGNED);
    header.extend(std::iter::repeat_n(' ', end - before - header.len() - 1));
    header.push('\n');
    let length = u16::try_from(header.len()).map_err(io::Error::other)?;
    let mut file = BufWriter::new(File::create(path)?);
    file.write_all(MAGIC)?;
    file.write_all(&[1, 0])?;
    file.write_all(&length.to_le_bytes())?;
    file.write_all(header.as_bytes())?;
    for value in values {
        file.write_all(&value.to_le_bytes())?;
    }
    file.flush()
}
