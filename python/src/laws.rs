//! Friction and state laws by name and parameters.

use pyo3::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};

use crate::arguments::{non_negative, positive};
use crate::errors::argument;
use crate::own_laws::{OwnFriction, OwnState};
use crate::raised::Raised;

/// A friction law.
#[derive(Clone)]
pub(crate) enum Friction {
    /// Cut off at zero.
    CutOff(DieterichRuina),
    /// Regularised by asinh.
    Regularized(RegularizedDieterichRuina),
    /// Of the user.
    Own(OwnFriction),
}

/// A state law.
#[derive(Clone)]
pub(crate) enum Evolution {
    /// The aging law.
    Aging(Dieterich),
    /// The slip law.
    Slip(Ruina),
    /// Of the user.
    Own(OwnState),
}

impl Friction {
    /// The law of a name.
    pub(crate) fn named(name: &str, parameters: DieterichRuina) -> PyResult<Self> {
        match name {
            "cut-off" => Ok(Self::CutOff(parameters)),
            "regularized" => Ok(Self::Regularized(parameters.into())),
            _ => Err(argument("friction", "\"cut-off\" or \"regularized\"", name)),
        }
    }

    /// The law for a scene; `raised` keeps the exceptions of the user's methods.
    pub(crate) fn law(&self, raised: &Raised) -> Box<dyn FrictionLaw<State = LogTheta>> {
        match self {
            Self::CutOff(law) => Box::new(*law),
            Self::Regularized(law) => Box::new(*law),
            Self::Own(law) => Box::new(law.reporting_to(raised)),
        }
    }
}

impl Friction {
    /// The law of a name, or that of an object of the user.
    pub(crate) fn of(
        given: &Bound<'_, PyAny>,
        parameters: impl FnOnce() -> PyResult<DieterichRuina>,
    ) -> PyResult<Self> {
        match given.extract::<String>() {
            Ok(name) => Self::named(&name, parameters()?),
            Err(_) => OwnFriction::new("friction", given).map(Self::Own),
        }
    }
}

impl Evolution {
    /// The law of a name, or that of an object of the user.
    pub(crate) fn of(
        given: &Bound<'_, PyAny>,
        parameters: impl FnOnce() -> PyResult<DieterichRuina>,
    ) -> PyResult<Self> {
        match given.extract::<String>() {
            Ok(name) => Self::named(&name, &parameters()?),
            Err(_) => OwnState::new("law", given).map(Self::Own),
        }
    }

    /// The law of a name.
    pub(crate) fn named(name: &str, parameters: &DieterichRuina) -> PyResult<Self> {
        match name {
            "aging" => Ok(Self::Aging(parameters.aging())),
            "slip" => Ok(Self::Slip(parameters.slip())),
            _ => Err(argument("law", "\"aging\" or \"slip\"", name)),
        }
    }

    /// The law for a scene; `raised` keeps the exceptions of the user's methods.
    pub(crate) fn law(&self, raised: &Raised) -> Box<dyn StateLaw<State = LogTheta>> {
        match self {
            Self::Aging(law) => Box::new(*law),
            Self::Slip(law) => Box::new(*law),
            Self::Own(law) => Box::new(law.reporting_to(raised)),
        }
    }
}

/// A parameter of a law by name, which must be given.
pub(crate) fn given<T>(name: &str, value: Option<T>) -> PyResult<T> {
    value.ok_or_else(|| argument(name, "given for laws by name", "None"))
}

/// The parameters of rate- and state-dependent friction, each checked.
pub(crate) fn parameters(
    [a, b, slip_distance]: [f64; 3],
    [reference_friction, reference_velocity]: [f64; 2],
) -> PyResult<DieterichRuina> {
    Ok(DieterichRuina {
        a: positive("a", a)?,
        b: non_negative("b", b)?,
        reference_friction: non_negative("mu0", reference_friction)?,
        reference_velocity: positive("V0", reference_velocity)?,
        slip_distance: positive("Dc", slip_distance)?,
    })
}
