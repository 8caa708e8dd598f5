//! Friction and state laws by name and parameters.

use pyo3::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};

use crate::arguments::{non_negative, positive};
use crate::errors::argument;
use crate::own_laws::{OwnFriction, OwnState, raised};

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

    /// The law for a scene.
    pub(crate) fn law(&self) -> Box<dyn FrictionLaw<State = LogTheta>> {
        match self {
            Self::CutOff(law) => Box::new(*law),
            Self::Regularized(law) => Box::new(*law),
            Self::Own(law) => Box::new(law.clone()),
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
            Err(_) => OwnFriction::new(given).map(Self::Own),
        }
    }

    /// The exception that a law of the user has raised.
    pub(crate) fn raised(&self) -> Option<PyErr> {
        match self {
            Self::Own(law) => raised(&law.raised),
            _ => None,
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
            Err(_) => OwnState::new(given).map(Self::Own),
        }
    }

    /// The exception that a law of the user has raised.
    pub(crate) fn raised(&self) -> Option<PyErr> {
        match self {
            Self::Own(law) => raised(&law.raised),
            _ => None,
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

    /// The law for a scene.
    pub(crate) fn law(&self) -> Box<dyn StateLaw<State = LogTheta>> {
        match self {
            Self::Aging(law) => Box::new(*law),
            Self::Slip(law) => Box::new(*law),
            Self::Own(law) => Box::new(law.clone()),
        }
    }
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
