//! Files from which a run goes on after its program has ended.

mod error;
mod fingerprint;
pub(crate) mod mark;

pub use error::CheckpointError;
pub(crate) use fingerprint::Fingerprint;
pub use mark::Difference;

use std::fmt::Display;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::file::{Format, Unread};
use crate::{Snapshot, StepState, Stepper};
use mark::Mark;

const FORMAT: Format = Format {
    magic: *b"\x89slip\r\n\x1a",
    version: 1,
};

/// A file from which a run goes on after its program has ended: the [`StepState`], and records of one's own.
///
/// ```text
/// magic, version | checksum of all the rest | marks of the scene, time | state | records
/// ```
///
/// Numbers are kept bit for bit. [`save`](Self::save) writes beside the file, and the new one then takes the place of the
/// old: whenever the program or the machine stops, one of both is there and whole. The checksum has 128 bits (XXH3).
///
/// Another scene is refused by its marks: the number of vertices and components, the mesh, products of its operators,
/// supports, the vertices of its contacts, and, at sample rates and at the time of the checkpoint, laws, loads,
/// normal stress and prescribed velocities. Functions are compared to `1e-9`, since libraries of functions round
/// differently. How the run goes through time is no part of a scene: scheme, solver, coupling and steps belong into
/// [`tagged`](Self::tagged).
///
/// Save between two runs: there the last step is one of the plan, also where the plan is
/// [`bridging`](crate::Steps::bridging). [`Steps::count`](crate::Steps::count) cuts a plan into pieces.
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{Checkpoint, CheckpointError, Ended, History, Newmark, Point, Simulation, Steps};
///
/// # let load = LoadPath::steady(1e-6).then(10.0, 1e-5);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 5e3, damping: 0.0, load };
/// let block = || Simulation::new(slider.steady(FRICTION, AGING, 1e-6)?, Newmark::default(), Point);
/// let plan = Steps::adaptive(1e-4).until(20.0);
/// # let path = std::env::temp_dir().join(format!("stickslip-doc-{}", std::process::id()));
/// let file = Checkpoint::at(&path).tagged("tolerance", 1e-4);
///
/// let mut before = block()?;
/// let mut history = History::new(0, 0, 0);
/// before.run(&plan.clone().count(50), |at| { history.record(&at); })?;
/// file.save(&before.snapshot(), &history)?;
///
/// // Another program, another day.
/// let mut after = block()?;
/// let mut history: History = file.restore(&mut after)?;
/// assert_eq!(after.state(), before.state());
/// let report = after.run(&plan, |at| { history.record(&at); })?;
/// assert_eq!(report.ended, Ended::Time);
/// assert_eq!(history.samples().len(), 50 + report.accepted);
///
/// let other = Checkpoint::at(&path).tagged("tolerance", 1e-3).restore::<History, 1>(&mut block()?);
/// assert!(matches!(other, Err(CheckpointError::AnotherScene { .. })));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Checkpoint {
    path: PathBuf,
    tags: Vec<(String, String)>,
}

impl Checkpoint {
    /// The checkpoint at this path; nothing is read or written yet.
    pub fn at(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            tags: Vec::new(),
        }
    }

    /// Says something of the run that its scene does not show, and without which its records make no sense: the scheme,
    /// the step size, the command line. A file with other tags, or in another order, is refused.
    #[must_use]
    pub fn tagged(mut self, name: impl Into<String>, value: impl Display) -> Self {
        self.tags.push((name.into(), value.to_string()));
        self
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the state shown, and `records`. They should be of types that say by themselves what follows, as derived
    /// ones do.
    ///
    /// # Errors
    /// [`CheckpointError::Write`], [`CheckpointError::Encode`].
    pub fn save<T, const C: usize>(
        &self,
        at: &Snapshot<'_, C>,
        records: &T,
    ) -> Result<(), CheckpointError>
    where
        T: Serialize + ?Sized,
    {
        let marks = self.marks(at, at.time);
        let contents = (marks, at.time, at.state(), records);
        let payload = postcard::to_stdvec(&contents).map_err(CheckpointError::Encode)?;
        FORMAT
            .write(&self.path, &payload)
            .map_err(|source| CheckpointError::Write {
                path: self.path.clone(),
                source,
            })
    }

    /// Puts a simulation of the same scene into the state of the file, and returns the records. Where that fails the
    /// simulation is as it was.
    ///
    /// # Errors
    /// [`CheckpointError`] that says whether the file cannot be read, is none, is damaged, of another scene, or holds
    /// other records.
    pub fn restore<T, const C: usize>(
        &self,
        stepper: &mut (impl Stepper<C> + ?Sized),
    ) -> Result<T, CheckpointError>
    where
        T: DeserializeOwned,
    {
        let other_records = |source| CheckpointError::Records {
            path: self.path.clone(),
            source,
        };
        let payload = FORMAT
            .read(&self.path)
            .map_err(|error| self.unread(error))?;
        let (head, rest) =
            postcard::take_from_bytes::<(Vec<Mark>, f64)>(&payload).map_err(other_records)?;
        let (found, time) = head;
        let expected = self.marks(&stepper.snapshot(), time);
        mark::compare(&found, &expected).map_err(|difference| CheckpointError::AnotherScene {
            path: self.path.clone(),
            difference,
        })?;
        let (contents, rest) =
            postcard::take_from_bytes::<(StepState<C>, T)>(rest).map_err(other_records)?;
        if !rest.is_empty() {
            return Err(other_records(postcard::Error::DeserializeBadEncoding));
        }
        let (state, records) = contents;
        stepper
            .restore(&state)
            .map_err(|source| CheckpointError::State {
                path: self.path.clone(),
                source: Box::new(source),
            })?;
        Ok(records)
    }

    fn unread(&self, error: Unread) -> CheckpointError {
        let path = self.path.clone();
        match error {
            Unread::Read(source) => CheckpointError::Read { path, source },
            Unread::Foreign => CheckpointError::NotACheckpoint { path },
            Unread::Version { found } => CheckpointError::Version {
                path,
                found,
                expected: FORMAT.version,
            },
            Unread::Damaged => CheckpointError::Damaged { path },
        }
    }

    /// The marks of a run, at a time \[s\].
    fn marks<const C: usize>(&self, at: &Snapshot<'_, C>, time: f64) -> Vec<Mark> {
        let mut fingerprint = Fingerprint::default();
        for (name, value) in &self.tags {
            fingerprint.tag(name, value);
        }
        fingerprint.scene(at, time);
        fingerprint.into_marks()
    }
}
