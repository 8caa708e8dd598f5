//! Arguments from Python: numbers in their ranges, a load as a number or a list of velocity steps.

use pyo3::prelude::*;
use stickslip::problems::spring_slider::LoadPath;

use crate::errors::argument;

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
#[derive(FromPyObject)]
pub(crate) enum Load {
    /// A velocity [m/s].
    #[pyo3(transparent, annotation = "velocity")]
    Steady(f64),
    /// Times \[s\] and velocities [m/s].
    #[pyo3(transparent, annotation = "list of (time, velocity)")]
    Steps(Vec<[f64; 2]>),
}

impl Load {
    /// The path of the load point; the first time is 0, times increase.
    pub(crate) fn path(self) -> PyResult<LoadPath> {
        let steps = match self {
            Self::Steady(velocity) => vec![[0.0, velocity]],
            Self::Steps(steps) => steps,
        };
        let Some((&[start, first], later)) = steps.split_first() else {
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
        for (n, &[time, velocity]) in later.iter().enumerate() {
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
