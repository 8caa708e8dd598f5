//! Arguments from Python: numbers in their ranges, a load as a number or a list of velocity steps.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use stickslip::problems::spring_slider::LoadPath;

use crate::bodies::PerVertex;
use crate::errors::{argument, misfit};

/// An argument of any type, whose exception has the name of the argument in its message.
pub(crate) fn named<'a, 'py, T: FromPyObject<'a, 'py>>(
    given: &'a Bound<'py, PyAny>,
) -> PyResult<T> {
    let extracted: Result<T, T::Error> = given.extract();
    extracted.map_err(|error| misfit(given.py(), error.into()))
}

/// Refuses an argument of a wrong type, in words of Python.
pub(crate) fn wrong_type(requirement: &str, given: &Bound<'_, PyAny>) -> PyErr {
    let kind = given.get_type();
    let kind = kind
        .name()
        .map_or_else(|_| "?".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("must be {requirement}, not {kind}"))
}

/// Times \[s\] at which a run is sampled, from the present one to its end, in order; none if there is no such argument.
pub(crate) fn sample_times(
    times: Option<Numbers>,
    [now, until]: [f64; 2],
) -> PyResult<Option<Vec<f64>>> {
    let Some(Numbers(times)) = times else {
        return Ok(None);
    };
    if times.is_empty() {
        return Err(argument("t_eval", "of at least one time", times));
    }
    let mut last = now;
    for (n, &time) in times.iter().enumerate() {
        if !(time >= last && time <= until) {
            let requirement =
                format!("a time from {now} s to {until} s, not before the one before it");
            return Err(argument(&format!("t_eval[{n}]"), &requirement, time));
        }
        last = time;
    }
    Ok(Some(times))
}

/// Real numbers: an array of one dimension or a sequence.
pub(crate) struct Numbers(pub(crate) Vec<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match given.extract::<PerVertex>() {
            Ok(PerVertex::Each(values)) => Ok(Self(values)),
            _ => Err(wrong_type("a sequence of numbers", &given)),
        }
    }
}

/// Passes a number that is finite and positive.
pub(crate) fn positive(name: &str, value: f64) -> PyResult<f64> {
    let legal = value.is_finite() && value > 0.0;
    legal
        .then_some(value)
        .ok_or_else(|| argument(name, "finite and positive", value))
}

/// Passes a number that is finite and not negative.
pub(crate) fn non_negative(name: &str, value: f64) -> PyResult<f64> {
    let legal = value.is_finite() && value >= 0.0;
    legal
        .then_some(value)
        .ok_or_else(|| argument(name, "finite and non-negative", value))
}

/// Passes a number that is finite.
pub(crate) fn finite(name: &str, value: f64) -> PyResult<f64> {
    let legal = value.is_finite();
    legal
        .then_some(value)
        .ok_or_else(|| argument(name, "finite", value))
}

/// Passes a number of cells, steps or samples that is at least one.
pub(crate) fn count(name: &str, value: usize) -> PyResult<usize> {
    (value > 0)
        .then_some(value)
        .ok_or_else(|| argument(name, "at least 1", value))
}

/// The velocity of a load point: constant, or pairs of a time and the velocity from then on.
#[derive(Clone, IntoPyObject)]
pub(crate) enum Load {
    /// A velocity [m/s].
    Steady(f64),
    /// Times \[s\] and velocities [m/s].
    Steps(Vec<(f64, f64)>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Load {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(velocity) = given.extract() {
            return Ok(Self::Steady(velocity));
        }
        let pairs = given.extract::<Vec<[f64; 2]>>();
        let pairs = pairs.map_err(|_| {
            wrong_type(
                "a velocity [m/s] or a list of pairs (time, velocity)",
                &given,
            )
        })?;
        Ok(Self::Steps(pairs.into_iter().map(Into::into).collect()))
    }
}

impl Load {
    /// The path of the load point; the first time is 0, times increase.
    pub(crate) fn path(self) -> PyResult<LoadPath> {
        let steps = match self {
            Self::Steady(velocity) => vec![(0.0, velocity)],
            Self::Steps(steps) => steps,
        };
        let Some((&(start, first), later)) = steps.split_first() else {
            return Err(argument(
                "load",
                "a velocity or pairs (time, velocity), at least one",
                steps,
            ));
        };
        if start != 0.0 {
            return Err(argument("load[0]", "a pair whose time is 0", steps[0]));
        }
        let mut path = LoadPath::steady(finite("load[0], its velocity,", first)?);
        let mut last = start;
        for (n, &(time, velocity)) in later.iter().enumerate() {
            let position = n + 1;
            if !(time.is_finite() && time > last) {
                let name = format!("load[{position}], its time,");
                return Err(argument(&name, "finite and after the time before it", time));
            }
            finite(&format!("load[{position}], its velocity,"), velocity)?;
            path = path.then(time, velocity);
            last = time;
        }
        Ok(path)
    }
}
