//! Contacts: friction on a rigid surface, or between the two sides of a fault.

use numpy::{PyArray1, PyArrayDescrMethods, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::state::{LogTheta, Theta};
use stickslip::{BlockMatrix, BoundaryPart, Contact as SceneContact, NormalStress, Scene};

use super::condition::boundary;
use super::part::Part;
use crate::errors::argument;
use crate::laws::{Evolution, Friction};
use crate::raised::Raised;

/// One value for all vertices, or one each.
#[derive(FromPyObject)]
pub(crate) enum PerVertex {
    /// One for all.
    #[pyo3(transparent, annotation = "number")]
    Uniform(f64),
    /// In the order of the part's vertices.
    #[pyo3(transparent, annotation = "array")]
    Each(#[pyo3(from_py_with = reals)] Vec<f64>),
}

/// The numbers of a sequence, of real ones.
fn reals(given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    if let Ok(array) = given.cast::<PyArray1<f64>>() {
        return Ok(array.try_readonly()?.as_array().to_vec());
    }
    real(given)?;
    given.extract()
}

/// Refuses an array of complex numbers, whose imaginary parts numpy would drop.
pub(crate) fn real(given: &Bound<'_, PyAny>) -> PyResult<()> {
    if given
        .cast::<PyUntypedArray>()
        .is_ok_and(|array| array.dtype().kind() == b'c')
    {
        return Err(PyTypeError::new_err(
            "complex numbers in the place of real ones",
        ));
    }
    Ok(())
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
        };
        if values.len() != count {
            let requirement = format!("one number, or one for each of {count} vertices");
            return Err(argument(name, &requirement, values.len()));
        }
        match values.iter().position(|&value| !legal(value)) {
            Some(n) => Err(argument(&format!("{name}[{n}]"), requirement, values[n])),
            None => Ok(values),
        }
    }
}

/// A normal stress: given, or that of the deformation.
#[derive(FromPyObject)]
pub(super) enum Pressure {
    /// Of the body.
    #[pyo3(transparent, annotation = "\"body\"")]
    Named(String),
    /// Prescribed \[Pa\].
    #[pyo3(transparent, annotation = "number or array")]
    Given(PerVertex),
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
    cohesion: f64,
    opens: bool,
}

impl Contact {
    pub(super) fn new(
        (part, opposite): (&Part, Option<&Part>),
        laws: Laws,
        normal_stress: NormalStress,
        (cohesion, opens): (f64, bool),
    ) -> Self {
        Self {
            part: boundary(part),
            count: part.count(),
            opposite: opposite.map(boundary),
            laws,
            normal_stress,
            cohesion,
            opens,
        }
    }

    /// The scene with this contact.
    pub(super) fn on<const C: usize>(
        &self,
        scene: Scene<BlockMatrix<C>, C>,
        raised: &Raised,
    ) -> Scene<BlockMatrix<C>, C> {
        match &self.laws {
            &Laws::Coulomb(coefficient) => scene.with_contact(self.contact(Tresca { coefficient })),
            Laws::RateAndState(friction, evolution, theta) => {
                let states = theta.iter().map(|&theta| LogTheta::from(Theta(theta)));
                let contact = self.contact(friction.law(raised));
                scene.with_contact(
                    contact.with_state(evolution.law(raised), states.collect::<Vec<_>>()),
                )
            }
        }
    }

    fn contact<L: FrictionLaw, const C: usize>(&self, law: L) -> SceneContact<L, (), C> {
        let (part, stress) = (self.part.clone(), self.normal_stress.clone());
        let contact = match &self.opposite {
            Some(minus) => SceneContact::between(part, minus.clone(), law, stress),
            None => SceneContact::new(part, law, stress),
        };
        let contact = contact.with_cohesion(self.cohesion);
        if self.opens {
            contact.allow_opening()
        } else {
            contact
        }
    }
}
