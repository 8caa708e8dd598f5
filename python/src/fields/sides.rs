//! Conditions at the sides of a fault.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use stickslip::fields::{Boundary, Side};

use super::Cells;
use crate::arguments::{finite, wrong_type};
use crate::errors::argument;

/// The names of sides.
const NAMES: [(&str, Side); 4] = [
    ("begin", Side::Begin),
    ("end", Side::End),
    ("top", Side::Top),
    ("bottom", Side::Bottom),
];

/// The conditions at sides by their names, those of a line and further ones of a plane.
#[derive(Clone, Default)]
pub(crate) struct Sides(Vec<(&'static str, Side, Boundary)>);

impl<'a, 'py> FromPyObject<'a, 'py> for Sides {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let Ok(sides) = given.cast::<PyMapping>() else {
            return Err(wrong_type("a dictionary of conditions by side", &given));
        };
        let sides = sides.items()?.into_iter().map(|item| {
            let (name, condition) = item.extract::<(Bound<'py, PyAny>, Bound<'py, PyAny>)>()?;
            let own = name.extract::<String>().ok();
            let own = own.and_then(|name| NAMES.into_iter().find(|(own, _)| *own == name));
            let Some((name, side)) = own else {
                let names = "\"begin\", \"end\", \"top\" or \"bottom\"";
                let given = name.repr()?.to_string();
                return Err(argument("the name of a side", names, given));
            };
            Ok((name, side, boundary(name, &condition)?))
        });
        sides.collect::<PyResult<_>>().map(Self)
    }
}

/// The condition at a side.
fn boundary(side: &str, condition: &Bound<'_, PyAny>) -> PyResult<Boundary> {
    let name = format!("sides[{side:?}]");
    let refused = || -> PyResult<Boundary> {
        let requirement = "\"sealed\", (\"pressure\", [Pa]) or (\"flux\", inward [m/s])";
        let given = condition.repr()?.to_string();
        Err(argument(&name, requirement, crate::errors::Bare(given)))
    };
    if let Ok(kind) = condition.extract::<String>() {
        return if kind == "sealed" {
            Ok(Boundary::Sealed)
        } else {
            refused()
        };
    }
    let Ok(kind) = condition
        .get_item(0)
        .and_then(|kind| kind.extract::<String>())
    else {
        return refused();
    };
    let Ok(value) = condition
        .get_item(1)
        .and_then(|value| value.extract::<f64>())
    else {
        return refused();
    };
    let value = finite(&name, value)?;
    match (kind.as_str(), condition.len()?) {
        ("pressure", 2) => Ok(Boundary::Pressure(value)),
        ("flux", 2) => Ok(Boundary::Flux(value)),
        _ => refused(),
    }
}

impl<'py> IntoPyObject<'py> for &Sides {
    type Target = PyDict;
    type Output = Bound<'py, PyDict>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let sides = PyDict::new(py);
        for (name, _, boundary) in &self.0 {
            match boundary {
                Boundary::Sealed => sides.set_item(name, "sealed")?,
                Boundary::Pressure(value) => sides.set_item(name, ("pressure", value))?,
                Boundary::Flux(value) => sides.set_item(name, ("flux", value))?,
            }
        }
        Ok(sides)
    }
}

impl Sides {
    /// The conditions at the sides of a fault, each with its name in messages.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<Vec<(Side, Boundary)>> {
        let sides = self.0.iter().map(|&(side, of, boundary)| {
            if cells.is_line() && matches!(of, Side::Top | Side::Bottom) {
                let name = format!("{name}.sides");
                return Err(argument(&name, "of \"begin\" and \"end\" on a line", side));
            }
            Ok((of, boundary))
        });
        sides.collect()
    }
}
