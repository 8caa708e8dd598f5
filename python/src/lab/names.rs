//! State laws by name, and the stiffness of a machine.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stickslip::lab::{Evolution, LabError};

use crate::arguments::positive;
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

/// The result, or its error as an exception.
pub(super) fn refused<T>(py: Python<'_>, result: Result<T, LabError>) -> PyResult<T> {
    result.map_err(|error| errors::lab(py, &error))
}

/// `k = K/normal stress` [1/m], given as it is or by both.
pub(super) fn machine(
    k: Option<f64>,
    stiffness: Option<f64>,
    normal_stress: Option<f64>,
) -> PyResult<Option<f64>> {
    match (k, stiffness, normal_stress) {
        (k, None, None) => k.map(|k| positive("k", k)).transpose(),
        (None, Some(stiffness), Some(stress)) => {
            let stiffness = positive("stiffness", stiffness)?;
            Ok(Some(stiffness / positive("normal_stress", stress)?))
        }
        (Some(_), ..) => {
            let message = "give k [1/m], or stiffness [Pa/m] and normal_stress [Pa], one of them";
            Err(PyValueError::new_err(message))
        }
        (None, Some(stiffness), None) => Err(PyValueError::new_err(format!(
            "stiffness = {stiffness:?} [Pa/m] needs normal_stress [Pa]: give both, or their ratio as k [1/m]"
        ))),
        (None, None, Some(stress)) => Err(PyValueError::new_err(format!(
            "normal_stress = {stress:?} [Pa] needs stiffness [Pa/m]: give both, or their ratio as k [1/m]"
        ))),
    }
}
