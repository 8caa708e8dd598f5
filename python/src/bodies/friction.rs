//! Contacts: friction on a rigid surface, or between the two sides of a fault.

use numpy::{
    PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::state::{LogTheta, Theta};
use stickslip::{BlockMatrix, BoundaryPart, Contact as SceneContact, NormalStress, Scene};

use super::condition::boundary;
use super::part::Part;
use crate::arguments::wrong_type;
use crate::errors::{Bare, argument};
use crate::fields::Fields;
use crate::laws::{Evolution, Friction};
use crate::raised::Raised;

/// One value for all vertices, or one each.
#[derive(Clone)]
pub(crate) enum PerVertex {
    /// One for all.
    Uniform(f64),
    /// In the order of the part's vertices.
    Each(Vec<f64>),
    /// An array of several dimensions, with its shape.
    Shaped(Vec<f64>, Vec<usize>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for PerVertex {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(value) = given.extract() {
            return Ok(Self::Uniform(value));
        }
        // Without numpy, whose import takes time.
        let is_list = given.is_instance_of::<PyList>() || given.is_instance_of::<PyTuple>();
        if is_list && let Ok(values) = given.extract() {
            return Ok(Self::Each(values));
        }
        let array = match given.cast::<PyArrayDyn<f64>>() {
            Ok(array) => array.to_owned(),
            Err(_) => numbers(&given)?,
        };
        let (shape, array) = (array.shape().to_vec(), array.try_readonly()?);
        let values = array.as_array().iter().copied().collect();
        Ok(match shape.len() {
            1 => Self::Each(values),
            _ => Self::Shaped(values, shape),
        })
    }
}

/// The array of a sequence of real numbers.
fn numbers<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let refused = || wrong_type("a number or an array of numbers", given);
    let numpy = given.py().import("numpy")?;
    // Of sequences of several lengths there is none.
    let array = numpy
        .call_method1("asarray", (given,))
        .map_err(|_| refused())?;
    let array = array.cast_into::<PyUntypedArray>()?;
    match array.dtype().kind() {
        b'b' | b'i' | b'u' | b'f' => {}
        b'c' => {
            let message = "complex numbers in the place of real ones";
            return Err(PyTypeError::new_err(message));
        }
        // Objects such as fractions, but neither None nor text, which numpy makes numbers of.
        b'O' => {
            let objects = array.call_method0("ravel")?.call_method0("tolist")?;
            let values: Vec<f64> = objects.extract().map_err(|_| refused())?;
            let shape = array.getattr("shape")?;
            let flat = numpy.call_method1("array", (values,))?;
            return Ok(flat.call_method1("reshape", (shape,))?.cast_into()?);
        }
        _ => return Err(refused()),
    }
    let array = array.call_method1("astype", ("float64",))?;
    Ok(array.cast_into()?)
}

impl PerVertex {
    /// Passes numbers that are legal, one for each of `count` vertices.
    pub(crate) fn checked(
        self,
        name: &str,
        count: usize,
        requirement: &str,
        legal: impl Fn(f64) -> bool,
    ) -> PyResult<Vec<f64>> {
        let values = match self {
            Self::Uniform(value) if legal(value) => return Ok(vec![value; count]),
            Self::Uniform(value) => return Err(argument(name, requirement, value)),
            Self::Each(values) => values,
            Self::Shaped(_, shape) => {
                let requirement = format!("one number, or an array of {count} numbers");
                let shape = format!("an array of shape {shape:?}");
                return Err(argument(name, &requirement, Bare(shape)));
            }
        };
        if values.len() != count {
            let requirement = format!("one number, or an array of {count} numbers");
            let given = format!("an array of {} numbers", values.len());
            return Err(argument(name, &requirement, Bare(given)));
        }
        match values.iter().position(|&value| !legal(value)) {
            Some(n) => Err(argument(&format!("{name}[{n}]"), requirement, values[n])),
            None => Ok(values),
        }
    }
}

/// A normal stress: given, or that of the deformation.
pub(super) enum Pressure {
    /// Of the body.
    Named(String),
    /// Prescribed \[Pa\].
    Given(PerVertex),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Pressure {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = given.extract() {
            return Ok(Self::Named(name));
        }
        let values = given.extract().map(Self::Given);
        values.map_err(|_| wrong_type("numbers or \"body\"", &given))
    }
}

impl Pressure {
    /// The normal stress for a scene.
    pub(super) fn stress(self, count: usize) -> PyResult<NormalStress> {
        match self {
            Self::Named(name) if name == "body" => Ok(NormalStress::from_body(0.0)),
            Self::Named(name) => Err(argument("normal_stress", "numbers or \"body\"", name)),
            Self::Given(values) => {
                let values = values.checked("normal_stress", count, "finite", f64::is_finite)?;
                Ok(values.into())
            }
        }
    }
}

/// The laws of a contact.
pub(super) enum Laws {
    /// A constant coefficient.
    Coulomb(f64),
    /// Rate and state, with the initial states \[s\].
    RateAndState(Friction, Evolution, Vec<f64>),
}

/// A contact of a body.
pub(super) struct Contact {
    part: BoundaryPart,
    /// The number of its vertices.
    pub(super) count: usize,
    opposite: Option<BoundaryPart>,
    laws: Laws,
    normal_stress: NormalStress,
    more: More,
}

/// The options of a contact beside friction.
pub(super) struct More {
    /// \[Pa\].
    pub(super) cohesion: f64,
    /// Whether it opens under tension.
    pub(super) opens: bool,
    /// The heat of its vertices.
    pub(super) fields: Fields,
}

impl Contact {
    pub(super) fn new(
        (part, opposite): (&Part, Option<&Part>),
        laws: Laws,
        normal_stress: NormalStress,
        more: More,
    ) -> Self {
        Self {
            part: boundary(part),
            count: part.count(),
            opposite: opposite.map(boundary),
            laws,
            normal_stress,
            more,
        }
    }

    /// The scene with this contact.
    pub(super) fn on<const C: usize>(
        &self,
        scene: Scene<BlockMatrix<C>, C>,
        raised: &Raised,
    ) -> Scene<BlockMatrix<C>, C> {
        match &self.laws {
            &Laws::Coulomb(coefficient) => {
                let contact = self.contact(Tresca { coefficient });
                scene.with_contact(self.more.fields.clone().in_contact(contact))
            }
            Laws::RateAndState(friction, evolution, theta) => {
                let states = theta.iter().map(|&theta| LogTheta::from(Theta(theta)));
                let contact = self.contact(friction.law(raised));
                let states = states.collect::<Vec<_>>();
                let contact = contact.with_state(evolution.law(raised), states);
                scene.with_contact(self.more.fields.clone().in_contact(contact))
            }
        }
    }

    fn contact<L: FrictionLaw, const C: usize>(&self, law: L) -> SceneContact<L, (), C> {
        let (part, stress) = (self.part.clone(), self.normal_stress.clone());
        let contact = match &self.opposite {
            Some(minus) => SceneContact::between(part, minus.clone(), law, stress),
            None => SceneContact::new(part, law, stress),
        };
        let contact = contact.with_cohesion(self.more.cohesion);
        if self.more.opens {
            contact.allow_opening()
        } else {
            contact
        }
    }
}
