//! Files for the restart of a run.

mod scene_marks;

use std::fmt::Display;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::file::Format;
use crate::marks::{Fingerprint, Mark};
use crate::{FileError, Snapshot, StepState, Stepper};

const FORMAT: Format = Format {
    kind: "checkpoint",
    magic: *b"\x89slip\r\n\x1a",
    version: 5,
};

/// The marks of a scene, and the time \[s\].
type Head = (Vec<Mark>, f64);

/// A restart file: the [`StepState`], and records of the caller.
///
/// ```text
/// magic, version | checksum of all the rest | marks of the scene, time | state | records
/// ```
///
/// Numbers are stored bit for bit. [`save`](Self::save) writes a temporary file, which then replaces the old one:
/// whenever the program or the machine stops, one complete file exists. The checksum has 128 bits (XXH3).
///
/// Another scene is refused by its marks: the number of vertices and components, the mesh, products of its operators,
/// supports, the vertices of its contacts, and, at sample rates and at the time of the checkpoint, laws, loads, normal
/// stress and prescribed velocities. Functions are compared to `1e-9`, since libraries of functions round differently.
/// The method is not part of a scene: add scheme, solver, coupling and steps by [`tagged`](Self::tagged).
///
/// Save between two runs: there the last step is one of the plan, even if it was split into substeps.
/// [`Steps::count`](crate::Steps::count) divides a plan into pieces.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::integrate::StopReason;
/// use stickslip::record::{EventCatalogue, FileError};
/// use stickslip::{Checkpoint, GeneralizedAlpha, Point, Simulation, Steps};
///
/// # let load = LoadPath::steady(1e-6).then(10.0, 1e-5);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 5e3, damping: 0.0, load };
/// let block = || Simulation::new(slider.steady(FRICTION, AGING, 1e-6)?, GeneralizedAlpha::default(), Point);
/// let plan = Steps::adaptive(1e-4).until(20.0);
/// # let path = std::env::temp_dir().join(format!("stickslip-doc-{}", std::process::id()));
/// let file = Checkpoint::at(&path).tagged("tolerance", 1e-4);
///
/// let mut before = block()?;
/// let mut events = EventCatalogue::new(&before.snapshot(), 0, [5e-6, 2e-6], 3e10, 8)?;
/// before.run(&plan.clone().count(50), |at| events.record(&at))?;
/// file.save(&before.snapshot(), &events)?;
///
/// // Another program, another day.
/// let mut after = block()?;
/// let mut events: EventCatalogue<1> = file.restore(&mut after)?;
/// assert_eq!(after.state(), before.state());
/// let report = after.run(&plan, |at| events.record(&at))?;
/// assert_eq!(report.ended, StopReason::Time);
/// assert!(events.is_under_way());
///
/// let other = Checkpoint::at(&path).tagged("tolerance", 1e-3).restore::<EventCatalogue<1>, 1>(&mut block()?);
/// assert!(matches!(other, Err(FileError::Mismatch { .. })));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
#[doc(alias("restart", "snapshot file"))]
pub struct Checkpoint {
    path: PathBuf,
    tags: Vec<(String, String)>,
}

impl Checkpoint {
    /// A checkpoint at this path; nothing is read or written yet.
    pub fn at(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            tags: Vec::new(),
        }
    }

    /// Adds a property of the run that its scene does not contain and that its records depend on: the scheme, the step
    /// size, the command line. A file with other tags, or in another order, is refused.
    #[must_use]
    pub fn tagged(mut self, name: impl Into<String>, value: impl Display) -> Self {
        self.tags.push((name.into(), value.to_string()));
        self
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the state of the snapshot, and `records`. Their types should be self-describing, as derived ones are.
    ///
    /// # Errors
    /// [`FileError::Write`], [`FileError::Encode`].
    pub fn save<T, const C: usize>(
        &self,
        at: &Snapshot<'_, C>,
        records: &T,
    ) -> Result<(), FileError>
    where
        T: Serialize + ?Sized,
    {
        self.write(&(self.marks(at, at.time), at.time, at.state(), records))
    }

    /// Restores a simulation of the same scene to the state of the file, and returns the records. On failure the
    /// simulation is unchanged.
    ///
    /// # Errors
    /// [`FileError`]: the file cannot be read, is not a checkpoint, is damaged, belongs to another scene, or holds other
    /// records.
    pub fn restore<T, const C: usize>(
        &self,
        stepper: &mut (impl Stepper<C> + ?Sized),
    ) -> Result<T, FileError>
    where
        T: DeserializeOwned,
    {
        let payload = self.read()?;
        let ((found, time), rest) = self.head(&payload)?;
        let expected = self.marks(&stepper.snapshot(), time);
        self.compare(&found, &expected)?;
        let (state, records) = self.contents::<(StepState<C>, T)>(rest)?;
        stepper.restore(&state).map_err(|source| FileError::State {
            path: self.path.clone(),
            source: Box::new(source),
        })?;
        Ok(records)
    }

    /// Writes the gathered contents of a run at a time \[s\] that no single [`Simulation`](crate::Simulation) holds,
    /// such as a run in several processes. Its tags alone identify such a run.
    ///
    /// # Errors
    /// [`FileError::Write`], [`FileError::Encode`].
    pub fn save_gathered<T>(&self, time: f64, contents: &T) -> Result<(), FileError>
    where
        T: Serialize + ?Sized,
    {
        self.write(&(self.tags_alone(), time, contents))
    }

    /// Reads the contents that [`save_gathered`](Self::save_gathered) has written under the same tags.
    ///
    /// # Errors
    /// Those of [`restore`](Self::restore).
    pub fn restore_gathered<T>(&self) -> Result<T, FileError>
    where
        T: DeserializeOwned,
    {
        let payload = self.read()?;
        let ((found, _), rest) = self.head(&payload)?;
        self.compare(&found, &self.tags_alone())?;
        self.contents(rest)
    }

    fn write(&self, contents: &impl Serialize) -> Result<(), FileError> {
        let payload = postcard::to_stdvec(contents).map_err(|source| FileError::Encode {
            what: "records",
            source: Box::new(source),
        })?;
        FORMAT.write(&self.path, &payload)
    }

    fn read(&self) -> Result<Vec<u8>, FileError> {
        FORMAT.read(&self.path)
    }

    /// The marks and the time of a payload, and its remainder.
    fn head<'a>(&self, payload: &'a [u8]) -> Result<(Head, &'a [u8]), FileError> {
        postcard::take_from_bytes(payload).map_err(|source| self.other_records(source))
    }

    /// The contents in the remainder of a payload.
    fn contents<T: DeserializeOwned>(&self, payload: &[u8]) -> Result<T, FileError> {
        let read = match postcard::take_from_bytes(payload) {
            Ok((contents, [])) => Ok(contents),
            Ok(_) => Err(postcard::Error::DeserializeBadEncoding),
            Err(error) => Err(error),
        };
        read.map_err(|source| self.other_records(source))
    }

    fn compare(&self, found: &[Mark], expected: &[Mark]) -> Result<(), FileError> {
        FORMAT.compare(&self.path, found, expected)
    }

    fn other_records(&self, source: postcard::Error) -> FileError {
        FileError::Contents {
            path: self.path.clone(),
            what: "the records asked for",
            source: Some(Box::new(source)),
        }
    }

    fn tags_alone(&self) -> Vec<Mark> {
        self.tagged_fingerprint().into_marks()
    }

    fn tagged_fingerprint(&self) -> Fingerprint {
        let mut fingerprint = Fingerprint::default();
        for (name, value) in &self.tags {
            fingerprint.tag(name, value);
        }
        fingerprint
    }

    /// The marks of a run, at a time \[s\].
    fn marks<const C: usize>(&self, at: &Snapshot<'_, C>, time: f64) -> Vec<Mark> {
        let mut fingerprint = self.tagged_fingerprint();
        fingerprint.scene(at, time);
        fingerprint.into_marks()
    }
}
