//! Histories of displacement and velocity off a fault.

mod files;

pub use files::ReceiverFiles;

use std::collections::HashMap;
use std::fs::{File, create_dir_all};
use std::path::PathBuf;

use nalgebra::SVector;
use stickslip_bie::{ReceiverError, Receivers};

use super::check::require;
use super::seas::{Rows, SeasHeader};
use crate::{FileError, Snapshot};

/// The displacement and the velocity of receivers off a fault during a run, one file per receiver in the format of the SEAS
/// benchmarks (`srfst_fn+08`, `blkst_strk+00fn+08dp+00`).
///
/// | column | quantity | unit |
/// | --- | --- | --- |
/// | `t` | time | s |
/// | `disp_x disp_y disp_z` | displacement since the start of the run | m |
/// | `vel_x vel_y vel_z` | velocity | m/s |
///
/// The axes are those of the [`Receivers`], or others ([`with_axes`](Self::with_axes)). Displacement is that of slip on the
/// cells, and with [`with_creep`](Self::with_creep) of creep beyond them. The fault is **quasi-dynamic**: displacement follows
/// slip in elastic equilibrium, and there are no seismic waves; the header says so.
///
/// ```
/// use stickslip::bie::{Cells, Fault, Receivers};
/// use stickslip::nalgebra::Vector1;
/// use stickslip::problems::bp1;
/// use stickslip::record::{ReceiverFolder, SeasHeader};
/// use stickslip::{RungeKutta, Steps};
///
/// let fault = Fault::half_space(Cells::new([0.0, 40e3], 40)?, bp1::MEDIUM)?;
/// let mut cycle = RungeKutta::new(bp1::scene(&fault))?;
/// let stations = Receivers::new(&fault, &[[8e3, 0.0, 0.0], [-8e3, 0.0, 0.0]])?;
/// let folder = std::env::temp_dir().join("stickslip-receivers-example");
/// let mut files = ReceiverFolder::new(&folder, SeasHeader::new("SEAS Benchmark BP1-QD"), stations)
///     .with_names(["srfst_fn+08", "srfst_fn-08"])
///     .with_creep(Vector1::new(bp1::PLATE_RATE))?
///     .create(&cycle.snapshot())?;
/// cycle.run(&Steps::adaptive(1e-4).until(100.0), |at| files.record(&at))?;
/// files.finish()?;
/// // At first the fault creeps everywhere at the plate rate: each side moves by one half.
/// let text = std::fs::read_to_string(folder.join("srfst_fn+08"))?;
/// let row: Vec<f64> = text.lines().last().ok_or("no row")?.split(' ').map(str::parse).collect::<Result<_, _>>()?;
/// assert!((row[2] / (0.5 * bp1::PLATE_RATE * row[0]) - 1.0).abs() < 0.1);
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("srfst", "blkst", "GNSS", "geodesy", "off-fault station"))]
pub struct ReceiverFolder<const C: usize> {
    folder: PathBuf,
    header: SeasHeader,
    receivers: Receivers<C>,
    names: Vec<String>,
    /// The name and the direction of each component of displacement.
    axes: Vec<(String, [f64; 3])>,
    /// The velocity due to creep beyond the cells, of each receiver [m/s].
    creep: Option<Vec<[f64; 3]>>,
}

impl<const C: usize> ReceiverFolder<C> {
    /// Files `receiver_000`, `receiver_001` and so on in a folder.
    pub fn new(folder: impl Into<PathBuf>, header: SeasHeader, receivers: Receivers<C>) -> Self {
        let count = 0..receivers.points().len();
        let axes = [
            ("x", [1.0, 0.0, 0.0]),
            ("y", [0.0, 1.0, 0.0]),
            ("z", [0.0, 0.0, 1.0]),
        ];
        Self {
            folder: folder.into(),
            header,
            names: count.map(|k| format!("receiver_{k:03}")).collect(),
            receivers,
            axes: axes.map(|(name, axis)| (name.to_owned(), axis)).to_vec(),
            creep: None,
        }
    }

    /// The names of the files, in the order of the receivers.
    #[must_use]
    pub fn with_names(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        self.names = names.into_iter().map(Into::into).collect();
        self
    }

    /// Other components of displacement: their names, and their directions along the axes of the receivers. Those of BP3 are
    /// `("1", [1.0, 0.0, 0.0])` and `("2", [0.0, 0.0, -1.0])`.
    #[must_use]
    pub fn with_axes<'a>(mut self, axes: impl IntoIterator<Item = (&'a str, [f64; 3])>) -> Self {
        let axes = axes.into_iter();
        self.axes = axes.map(|(name, axis)| (name.to_owned(), axis)).collect();
        self
    }

    /// Adds creep of the rest of the fault's plane at a rate [m/s], that of plate loading, see [`Receivers::creep`].
    ///
    /// # Errors
    /// [`ReceiverError::NoPlane`] for a fault that is not one plane or straight line, [`ReceiverError::Value`] for a rate that
    /// is not finite.
    pub fn with_creep(mut self, rate: SVector<f64, C>) -> Result<Self, ReceiverError> {
        self.creep = Some(self.receivers.creep(rate)?);
        Ok(self)
    }

    /// Creates the folder and the files, each with a row for the state shown.
    ///
    /// # Errors
    /// [`SceneError::Value`](crate::SceneError::Value) for another number of names than receivers, or of vertices than cells,
    /// [`FileError::SameName`] for two receivers with one file, [`FileError::Write`] for a folder or file that cannot be
    /// created.
    pub fn create(self, at: &Snapshot<'_, C>) -> Result<ReceiverFiles<C>, FileError> {
        let points = self.receivers.points();
        let (what, expected) = ("number of names", "that of the receivers");
        let names = self.names.len();
        require(what, expected, names as f64, names == points.len())?;
        let (what, expected) = ("number of vertices", "that of the cells of the receivers");
        let vertices = at.displacement.len();
        let fits = vertices == self.receivers.cell_count();
        require(what, expected, vertices as f64, fits)?;
        self.check_names()?;
        create_dir_all(&self.folder).map_err(|source| FileError::Write {
            path: Some(self.folder.clone()),
            source,
        })?;
        let header = self.header.clone().with(
            "motion",
            "quasi-dynamic: elastic equilibrium with slip, no seismic waves",
        );
        let header = header.with(
            "creep_beyond_cells",
            if self.creep.is_some() {
                "the rest of the plane of the fault, at the plate rate"
            } else {
                "none: displacement is that of slip on the cells alone"
            },
        );
        let rows = self.names.iter().zip(points).map(|(name, &point)| {
            let mut rows = Rows::create(&self.folder.join(name))?;
            begin(&mut rows, &header, &self.axes, point);
            Ok(rows)
        });
        let rows = rows.collect::<Result<_, FileError>>()?;
        let mut files = ReceiverFiles {
            receivers: self.receivers,
            axes: self.axes.into_iter().map(|(_, axis)| axis).collect(),
            creep: self.creep,
            begin: at.time,
            rows,
            error: None,
        };
        let _ = files.record(at);
        files.write();
        Ok(files)
    }

    fn check_names(&self) -> Result<(), FileError> {
        let mut named = HashMap::new();
        for (name, point) in self.names.iter().zip(self.receivers.points()) {
            if let Some(first) = named.insert(name, point) {
                return Err(FileError::SameName {
                    path: self.folder.join(name),
                    points: [first, point].map(|[x, y, z]| format!("({x}, {y}, {z}) m")),
                });
            }
        }
        Ok(())
    }
}

/// The header of a file.
fn begin(rows: &mut Rows<File>, header: &SeasHeader, axes: &[(String, [f64; 3])], point: [f64; 3]) {
    let [x, y, z] = point.map(|x| x / 1e3);
    let mut columns = vec![("t".to_owned(), "Time (s)".to_owned())];
    for (short, long, unit) in [("disp", "Displacement", "m"), ("vel", "Velocity", "m/s")] {
        for (axis, _) in axes {
            columns.push((format!("{short}_{axis}"), format!("{long}_{axis} ({unit})")));
        }
    }
    let columns: Vec<(&str, &str)> = columns
        .iter()
        .map(|(name, quantity)| (name.as_str(), quantity.as_str()))
        .collect();
    let location = format!("off fault, x = {x} km, y = {y} km, z = {z} km");
    rows.begin(header, &location, &columns);
    rows.names(columns.iter().map(|(name, _)| *name));
}
