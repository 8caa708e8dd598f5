//! The motion of the load point, and state laws by name.

use pyo3::prelude::*;
use stickslip::lab::{Evolution, LabError, LoadHistory};

use crate::errors::{self, argument};

/// One name, or one for each state.
#[derive(FromPyObject)]
pub(crate) enum Names {
    /// The same for all.
    #[pyo3(transparent, annotation = "name")]
    One(String),
    /// One each.
    #[pyo3(transparent, annotation = "list of names")]
    Each(Vec<String>),
}

impl Names {
    /// The state laws of so many states.
    pub(super) fn laws(self, states: usize) -> PyResult<Vec<Evolution<'static>>> {
        if !(1..=2).contains(&states) {
            return Err(argument("states", "1 or 2", states));
        }
        let names = match self {
            Self::One(name) => vec![name; states],
            Self::Each(names) => names,
        };
        let known = "\"aging\", \"slip\", \"perrin-rice-zheng\", \"kato-tullis\" or \"nagata\"";
        let named = |name: &String| {
            let law = name.parse::<Evolution<'static>>();
            law.map_err(|_| argument("law", known, name))
        };
        names.iter().map(named).collect()
    }
}

/// The history of the load point: by velocity steps and holds, or by measured displacements.
pub(super) fn history(
    py: Python<'_>,
    times: &[f64],
    load: Option<Vec<(f64, f64)>>,
    displacement: Option<Vec<f64>>,
    resolution: Option<f64>,
) -> PyResult<LoadHistory> {
    let made = match (load, displacement) {
        (Some(load), None) => {
            let Some((&(_, initial), changes)) = load.split_first() else {
                return Err(argument(
                    "load",
                    "pairs (time, velocity), at least one",
                    load,
                ));
            };
            LoadHistory::new(initial, changes)
        }
        (None, Some(displacement)) => LoadHistory::measured(times, &displacement, resolution, None),
        _ => {
            let message = "give load or displacement, one of them";
            return Err(pyo3::exceptions::PyValueError::new_err(message));
        }
    };
    refused(py, made)
}

/// The result, or its error as an exception.
pub(super) fn refused<T>(py: Python<'_>, result: Result<T, LabError>) -> PyResult<T> {
    result.map_err(|error| errors::lab(py, &error))
}
