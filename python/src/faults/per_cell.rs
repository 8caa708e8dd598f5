//! Numbers or vectors per cell, by the number of components of slip.

use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stickslip::nalgebra::SVector;

use crate::bodies::{PerVertex, real};
use crate::errors::argument;

/// A vector with the components of slip, for all cells or one each.
#[derive(FromPyObject)]
pub(super) enum PerCell {
    /// Of one component; a pair of two components for all cells.
    #[pyo3(transparent, annotation = "number or array")]
    Numbers(PerVertex),
    /// Of two components.
    #[pyo3(transparent, annotation = "array of pairs")]
    Pairs(#[pyo3(from_py_with = pairs)] Vec<[f64; 2]>),
}

impl PerCell {
    /// Passes finite vectors, one for each of `count` cells.
    pub(super) fn checked<const C: usize>(
        self,
        name: &str,
        count: usize,
    ) -> PyResult<Vec<SVector<f64, C>>> {
        let pairs = match self {
            Self::Numbers(values) if C == 1 => {
                let values = values.checked(name, count, "finite", f64::is_finite)?;
                return Ok(values.into_iter().map(SVector::repeat).collect());
            }
            Self::Numbers(PerVertex::Each(pair)) if pair.len() == 2 => {
                vec![[pair[0], pair[1]]; count]
            }
            Self::Pairs(pairs) if C == 2 && pairs.len() == count => pairs,
            other => return Err(other.misshapen(name, C, count)),
        };
        let finite = |pair: &[f64; 2]| pair.iter().all(|x| x.is_finite());
        match pairs.iter().position(|pair| !finite(pair)) {
            Some(n) => Err(argument(&format!("{name}[{n}]"), "finite", pairs[n])),
            None => Ok((pairs.iter())
                .map(|pair| SVector::from_fn(|c, _| pair[c]))
                .collect()),
        }
    }

    /// The exception of another shape than that of the fault.
    fn misshapen(&self, name: &str, components: usize, count: usize) -> PyErr {
        let requirement = if components == 1 {
            format!("one number, or one for each of {count} cells")
        } else {
            format!("a pair along strike and up dip, or one for each of {count} cells")
        };
        match self {
            Self::Numbers(PerVertex::Uniform(value)) => argument(name, &requirement, value),
            Self::Numbers(PerVertex::Each(values)) => argument(name, &requirement, values.len()),
            Self::Pairs(pairs) => argument(name, &requirement, (pairs.len(), 2)),
        }
    }
}

/// The pairs of a sequence, of real numbers.
fn pairs(given: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 2]>> {
    if let Ok(array) = given.cast::<PyArray2<f64>>() {
        let array = array.try_readonly()?;
        let rows = array.as_array();
        if rows.ncols() == 2 {
            return Ok(rows
                .rows()
                .into_iter()
                .map(|row| [row[0], row[1]])
                .collect());
        }
    }
    real(given)?;
    given.extract()
}
