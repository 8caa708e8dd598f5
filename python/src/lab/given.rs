//! A record as it is given, and the motion of its load point.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use stickslip::lab::{LoadHistory, Record};

use super::names::{machine, refused};
use crate::errors::argument;

/// Times or displacements, and velocities from then on.
type Steps = Vec<(f64, f64)>;

/// A record, the motion of its load point, and its machine.
#[derive(Default)]
pub(super) struct Given {
    pub(super) t: Option<Vec<f64>>,
    pub(super) mu: Vec<f64>,
    pub(super) load: Option<Steps>,
    pub(super) displacement: Option<Vec<f64>>,
    pub(super) resolution: Option<f64>,
    pub(super) steps_at: Option<Steps>,
    pub(super) k: Option<f64>,
    pub(super) stiffness: Option<f64>,
    pub(super) normal_stress: Option<f64>,
    pub(super) window: Option<(f64, f64)>,
    pub(super) weights: Option<Vec<f64>>,
}

/// A record with its history, and the stiffness [1/m] if it is known.
pub(super) struct Measured {
    pub(super) record: Record,
    pub(super) load: LoadHistory,
    pub(super) k: Option<f64>,
}

/// The keys of a record.
const KEYS: [&str; 11] = [
    "t",
    "mu",
    "load",
    "displacement",
    "resolution",
    "steps_at",
    "k",
    "stiffness",
    "normal_stress",
    "window",
    "weights",
];

impl Given {
    /// A record by the names of its arguments.
    pub(super) fn by_name(record: &Bound<'_, PyDict>) -> PyResult<Self> {
        for key in record.keys() {
            let name = key.cast::<PyString>().map(|name| name.to_string());
            if !name.is_ok_and(|name| KEYS.contains(&name.as_str())) {
                let known = KEYS.join(", ");
                return Err(PyTypeError::new_err(format!(
                    "a record has no argument {}: it has {known}",
                    key.repr()?
                )));
            }
        }
        let mu = get(record, "mu")?;
        Ok(Self {
            t: get(record, "t")?,
            mu: mu.ok_or_else(|| PyTypeError::new_err("a record needs mu, an array"))?,
            load: get(record, "load")?,
            displacement: get(record, "displacement")?,
            resolution: get(record, "resolution")?,
            steps_at: get(record, "steps_at")?,
            k: get(record, "k")?,
            stiffness: get(record, "stiffness")?,
            normal_stress: get(record, "normal_stress")?,
            window: get(record, "window")?,
            weights: get(record, "weights")?,
        })
    }

    /// The record and its history.
    pub(super) fn read(self, py: Python<'_>) -> PyResult<Measured> {
        let k = machine(self.k, self.stiffness, self.normal_stress)?;
        let (times, load) = history(
            py,
            self.t,
            (self.load, self.steps_at),
            (self.displacement, self.resolution),
        )?;
        let mut record = refused(py, Record::new(times, self.mu))?;
        if let Some(weights) = self.weights {
            record = refused(py, record.with_weights(weights))?;
        }
        if let Some((from, to)) = self.window {
            if from.is_nan() || to.is_nan() || from >= to {
                return Err(argument("window", "a pair (from, to) in order", (from, to)));
            }
            record = record.window(from, to);
        }
        Ok(Measured { record, load, k })
    }
}

/// An argument; none if it is absent or None.
fn get<'py, T>(record: &Bound<'py, PyDict>, name: &str) -> PyResult<Option<T>>
where
    T: for<'a> FromPyObject<'a, 'py>,
{
    let value = record.get_item(name)?.filter(|value| !value.is_none());
    let Some(value) = value else { return Ok(None) };
    let extracted = value.extract::<T>();
    extracted.map(Some).map_err(|error| {
        let cause: PyErr = error.into();
        PyTypeError::new_err(format!("{name} of a record: {cause}"))
    })
}

/// The times of samples and the history of the load point: by velocity steps and holds, by measured displacements, or by
/// velocity steps at displacements.
pub(super) fn history(
    py: Python<'_>,
    times: Option<Vec<f64>>,
    (load, steps_at): (Option<Steps>, Option<Steps>),
    (displacement, resolution): (Option<Vec<f64>>, Option<f64>),
) -> PyResult<(Vec<f64>, LoadHistory)> {
    let one = "give load or displacement, one of them; or steps_at with displacement, and t=None";
    let misuse = |message: &'static str| Err(pyo3::exceptions::PyValueError::new_err(message));
    match (times, load, displacement, steps_at) {
        (None, None, Some(displacement), Some(steps)) => {
            let (initial, changes) = divided("steps_at", steps)?;
            let load = refused(py, LoadHistory::by_displacement(initial, &changes))?;
            let times = displacement.iter().map(|&x| load.time(x));
            Ok((times.collect(), load))
        }
        (Some(_), None, Some(_), Some(_)) => misuse(
            "steps_at says at which displacements the velocity changes, and so the times: give t=None with it",
        ),
        (None, _, _, None) => misuse("give the times t, or steps_at with displacement"),
        (Some(times), Some(load), None, None) => {
            let (initial, changes) = divided("load", load)?;
            Ok((times, refused(py, LoadHistory::new(initial, &changes))?))
        }
        (Some(times), None, Some(displacement), None) => {
            let load = LoadHistory::measured(&times, &displacement, resolution, None);
            Ok((times, refused(py, load)?))
        }
        _ => misuse(one),
    }
}

/// The initial velocity, and the changes with theirs.
fn divided(name: &str, steps: Steps) -> PyResult<(f64, Steps)> {
    let Some((&(_, initial), changes)) = steps.split_first() else {
        let pairs = if name == "load" {
            "pairs (time, velocity), at least one"
        } else {
            "pairs (displacement, velocity), at least one"
        };
        return Err(argument(name, pairs, steps));
    };
    Ok((initial, changes.to_vec()))
}
