//! The laws of the cells of a fault, by name or of the user.

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};

use super::per_cell::Layout;
use crate::bodies::PerVertex;
use crate::errors::argument;
use crate::laws::given;
use crate::own_laws::{OwnFriction, OwnState};
use crate::raised::Raised;

/// A friction law of any kind.
pub(super) type AnyFriction = Box<dyn FrictionLaw<State = LogTheta>>;
/// A state law of any kind.
pub(super) type AnyState = Box<dyn StateLaw<State = LogTheta>>;

/// The laws of cells.
pub(super) enum CellLaws {
    /// Regularised friction with the aging law, or the slip law if the flag is set.
    Named(Vec<RegularizedDieterichRuina>, bool),
    /// With a law of the user.
    Own(Vec<AnyFriction>, Vec<AnyState>),
}

/// The laws as arguments of Python.
pub(super) struct Given<'py> {
    /// `a`, `b`, `Dc`.
    pub(super) fitted: [Option<PerVertex>; 3],
    /// `mu0`, `V0`.
    pub(super) reference: [PerVertex; 2],
    pub(super) friction: Option<Bound<'py, PyAny>>,
    pub(super) law: Option<Bound<'py, PyAny>>,
}

impl Given<'_> {
    /// Arrays of the shape of a plane as lists of cells.
    pub(super) fn flat(self, cells: Layout) -> Self {
        let flat = |values| cells.flat(values);
        Self {
            fitted: self.fitted.map(|values| values.map(flat)),
            reference: self.reference.map(flat),
            ..self
        }
    }

    /// `alpha/b` of so many cells, if there is `alpha` of Linker and Dieterich.
    pub(super) fn normal_stress_effect(
        &self,
        alpha: Option<PerVertex>,
        cells: usize,
    ) -> PyResult<Option<Vec<f64>>> {
        let Some(alpha) = alpha else {
            return Ok(None);
        };
        let legal = |x: f64| x >= 0.0 && x.is_finite();
        let alpha = alpha.checked("alpha", cells, "finite and non-negative", legal)?;
        let Some(b) = self.fitted[1].clone() else {
            return Err(argument("b", "given with alpha", "None"));
        };
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let b = b.checked("b", cells, "finite and positive with alpha", positive)?;
        Ok(Some(
            alpha.iter().zip(b).map(|(alpha, b)| alpha / b).collect(),
        ))
    }

    /// The laws of so many cells; `raised` keeps the exceptions of the user's methods.
    pub(super) fn laws(self, cells: usize, raised: &Raised) -> PyResult<CellLaws> {
        let slip_law = match named(self.law.as_ref())? {
            Some(name) if name == "aging" => Some(false),
            Some(name) if name == "slip" => Some(true),
            Some(name) => {
                let known = "\"aging\", \"slip\" or a law of your own";
                return Err(argument("law", known, name));
            }
            None => self.law.is_none().then_some(false),
        };
        let regularized = match named(self.friction.as_ref())? {
            Some(name) if name == "regularized" => true,
            Some(name) => {
                let known = "\"regularized\" or a law of your own";
                return Err(argument("friction", known, name));
            }
            None => self.friction.is_none(),
        };
        // A law by name reads the parameters of all.
        let parameters = match (regularized, slip_law) {
            (false, None) => Vec::new(),
            _ => checked(self.fitted, self.reference, cells)?,
        };
        let friction = match self.friction.filter(|_| !regularized) {
            Some(laws) => Some(each("friction", &laws, cells)?),
            None => None,
        };
        let evolution = match self.law.filter(|_| slip_law.is_none()) {
            Some(laws) => Some(each("law", &laws, cells)?),
            None => None,
        };
        let own_friction = |law: Bound<'_, PyAny>| {
            let law = OwnFriction::new("friction", &law)?.reporting_to(raised);
            Ok(Box::new(law) as AnyFriction)
        };
        let own_state = |law: Bound<'_, PyAny>| {
            let law = OwnState::new("law", &law)?.reporting_to(raised);
            Ok(Box::new(law) as AnyState)
        };
        let (friction, evolution): (PyResult<_>, PyResult<_>) = match (friction, evolution) {
            (None, None) => return Ok(CellLaws::Named(parameters, slip_law == Some(true))),
            (friction, evolution) => (
                match friction {
                    Some(laws) => laws.into_iter().map(own_friction).collect(),
                    None => Ok(parameters.iter().map(|&law| Box::new(law) as _).collect()),
                },
                match evolution {
                    Some(laws) => laws.into_iter().map(own_state).collect(),
                    None => {
                        let laws = parameters.iter().map(|law| law.slip_distance);
                        let slips = slip_law == Some(true);
                        Ok(laws.map(|distance| by_name(distance, slips)).collect())
                    }
                },
            ),
        };
        Ok(CellLaws::Own(friction?, evolution?))
    }
}

fn by_name(slip_distance: f64, slips: bool) -> AnyState {
    if slips {
        Box::new(Ruina { slip_distance })
    } else {
        Box::new(Dieterich { slip_distance })
    }
}

/// The name of a law, if it is given by one.
fn named(law: Option<&Bound<'_, PyAny>>) -> PyResult<Option<String>> {
    Ok(law.and_then(|law| law.extract::<String>().ok()))
}

/// One law for all cells, or a list of laws with one per cell.
fn each<'py>(
    name: &str,
    laws: &Bound<'py, PyAny>,
    cells: usize,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    if laws.cast::<PyList>().is_err() && laws.cast::<PyTuple>().is_err() {
        return Ok(vec![laws.clone(); cells]);
    }
    let laws = laws.try_iter()?.collect::<PyResult<Vec<_>>>()?;
    if laws.len() != cells {
        let requirement = format!("one law, or a list of one for each of {cells} cells");
        return Err(argument(name, &requirement, laws.len()));
    }
    Ok(laws)
}

/// The parameters of regularised friction, each checked.
fn checked(
    [a, b, slip_distance]: [Option<PerVertex>; 3],
    [mu0, v0]: [PerVertex; 2],
    cells: usize,
) -> PyResult<Vec<RegularizedDieterichRuina>> {
    let positive = |name: &str, values: PerVertex| {
        let legal = |x: f64| x > 0.0 && x.is_finite();
        values.checked(name, cells, "finite and positive", legal)
    };
    let not_negative = |name: &str, values: PerVertex| {
        let legal = |x: f64| x >= 0.0 && x.is_finite();
        values.checked(name, cells, "finite and non-negative", legal)
    };
    let (a, b) = (
        positive("a", given("a", a)?)?,
        not_negative("b", given("b", b)?)?,
    );
    let slip_distance = positive("Dc", given("Dc", slip_distance)?)?;
    let (mu0, v0) = (not_negative("mu0", mu0)?, positive("V0", v0)?);
    let law = |k| RegularizedDieterichRuina {
        a: a[k],
        b: b[k],
        reference_friction: mu0[k],
        reference_velocity: v0[k],
        slip_distance: slip_distance[k],
    };
    Ok((0..cells).map(law).collect())
}
