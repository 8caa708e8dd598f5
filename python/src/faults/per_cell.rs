//! Numbers or vectors per cell, by the number of components of slip.

use pyo3::prelude::*;
use stickslip::nalgebra::SVector;

use crate::bodies::PerVertex;
use crate::errors::{Bare, argument};

/// The cells of a fault: their number, and those of a plane down dip and along strike.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) count: usize,
    pub(crate) shape: Option<[usize; 2]>,
}

impl Layout {
    /// Values per cell in the order of cells, of an array of the fault's shape; others as they are.
    pub(crate) fn flat(&self, values: PerVertex) -> PerVertex {
        match (values, self.shape) {
            (PerVertex::Shaped(values, shape), Some(own)) if shape == own => {
                PerVertex::Each(values)
            }
            (values, _) => values,
        }
    }
}

/// A vector with the components of slip, for all cells or one each.
pub(super) struct PerCell(PerVertex);

impl<'a, 'py> FromPyObject<'a, 'py> for PerCell {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        given.extract().map(Self)
    }
}

impl PerCell {
    /// Passes finite vectors, one for each cell.
    pub(super) fn checked<const C: usize>(
        self,
        name: &str,
        cells: Layout,
    ) -> PyResult<Vec<SVector<f64, C>>> {
        if C == 1 {
            let values = cells.flat(self.0);
            let values = values.checked(name, cells.count, "finite", f64::is_finite)?;
            return Ok(values.into_iter().map(SVector::repeat).collect());
        }
        let pair = |values: &[f64], n: usize| SVector::from_fn(|c, _| values[2 * n + c]);
        let (values, each) = match self.0 {
            PerVertex::Each(pair) if pair.len() == 2 => (pair, false),
            PerVertex::Shaped(values, shape)
                if shape == [cells.count, 2]
                    || cells.shape.is_some_and(|[m, n]| shape == [m, n, 2]) =>
            {
                (values, true)
            }
            other => return Err(misshapen(name, cells, &other)),
        };
        if let Some(n) = values.iter().position(|x| !x.is_finite()) {
            let pair = &values[n / 2 * 2..][..2];
            return Err(argument(&format!("{name}[{}]", n / 2), "finite", pair));
        }
        let at = |n: usize| pair(&values, if each { n } else { 0 });
        Ok((0..cells.count).map(at).collect())
    }
}

/// The exception of another shape than that of a fault with two components of slip.
fn misshapen(name: &str, cells: Layout, given: &PerVertex) -> PyErr {
    let count = cells.count;
    let requirement = format!("a pair along strike and up dip, or an array of {count} pairs");
    let given = match given {
        PerVertex::Uniform(value) => format!("{value}"),
        PerVertex::Each(values) => format!("an array of {} numbers", values.len()),
        PerVertex::Shaped(_, shape) => format!("an array of shape {shape:?}"),
    };
    argument(name, &requirement, Bare(given))
}
