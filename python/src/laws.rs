//! Friction and state laws by name and parameters.

use pyo3::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina};
use stickslip::state::{
    Dieterich, KatoTullis, LogTheta, Nagata, PerrinRiceZheng, Ruina, Sato, StateLaw,
};

use crate::arguments::{non_negative, positive};
use crate::errors::{self, argument};
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
    /// That of Perrin, Rice and Zheng.
    PerrinRiceZheng(PerrinRiceZheng),
    /// That of Kato and Tullis.
    KatoTullis(KatoTullis),
    /// That of Sato, Nakatani and Ando.
    Sato(Sato),
    /// That of Nagata and others; friction is that with its state.
    Nagata(Nagata),
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
        further: Further,
    ) -> PyResult<Self> {
        match given.extract::<String>() {
            Ok(name) => Self::named(&name, &parameters()?, further),
            Err(_) => OwnState::new("law", given).map(Self::Own),
        }
    }

    /// The law of a name.
    pub(crate) fn named(
        name: &str,
        parameters: &DieterichRuina,
        further: Further,
    ) -> PyResult<Self> {
        let slip_distance = parameters.slip_distance;
        let need = |argument: &str, value: Option<f64>| match value {
            Some(value) => positive(argument, value),
            None => Err(errors::argument(
                argument,
                &format!("given for law={name:?}"),
                "None",
            )),
        };
        for (argument, law, value) in [
            ("Vc", "kato-tullis", further.aging_velocity),
            ("c", "nagata", further.stress_weight),
        ] {
            if let (true, Some(value)) = (name != law, value) {
                return Err(errors::argument(
                    argument,
                    &format!("None but for law={law:?}"),
                    value,
                ));
            }
        }
        match name {
            "aging" => Ok(Self::Aging(parameters.aging())),
            "slip" => Ok(Self::Slip(parameters.slip())),
            "perrin-rice-zheng" => Ok(Self::PerrinRiceZheng(PerrinRiceZheng { slip_distance })),
            "kato-tullis" => Ok(Self::KatoTullis(KatoTullis {
                slip_distance,
                aging_velocity: need("Vc", further.aging_velocity)?,
            })),
            "sato" => Ok(Self::Sato(Sato::new(slip_distance))),
            "nagata" => {
                positive("b", parameters.b)?;
                let weight = need("c", further.stress_weight)?;
                Ok(Self::Nagata(parameters.weakened_by_stress(weight).1))
            }
            _ => Err(argument("law", LAWS, name)),
        }
    }

    /// The logarithm of `theta` at a state and a slip rate.
    pub(crate) fn ln_theta(&self, state: LogTheta, slip_rate: f64) -> f64 {
        match self {
            Self::Nagata(law) => law.ln_theta(state, slip_rate),
            _ => state.0,
        }
    }

    /// The state with this `theta` \[s\] at a slip rate.
    pub(crate) fn state(&self, theta: f64, slip_rate: f64) -> LogTheta {
        match self {
            Self::Nagata(law) => law.state(theta, slip_rate),
            _ => LogTheta(theta.ln()),
        }
    }

    /// The friction of the state of this law: Nagata's has a part of `a`.
    pub(crate) fn friction(&self, friction: Friction) -> PyResult<Friction> {
        match (self, friction) {
            (Self::Nagata(law), Friction::CutOff(parameters)) => {
                let (parameters, _) = parameters.weakened_by_stress(law.stress_weight);
                Ok(Friction::CutOff(parameters))
            }
            (Self::Nagata(_), _) => {
                let requirement = "\"cut-off\" for law=\"nagata\"";
                Err(argument("friction", requirement, "another one"))
            }
            // Their theta is 2 Dc/V in steady sliding.
            (Self::PerrinRiceZheng(law), Friction::CutOff(parameters)) => {
                Ok(Friction::CutOff(DieterichRuina {
                    slip_distance: 2.0 * law.slip_distance,
                    ..parameters
                }))
            }
            (Self::PerrinRiceZheng(law), Friction::Regularized(parameters)) => {
                Ok(Friction::Regularized(RegularizedDieterichRuina {
                    slip_distance: 2.0 * law.slip_distance,
                    ..parameters
                }))
            }
            (_, friction) => Ok(friction),
        }
    }

    /// The law for a scene; `raised` keeps the exceptions of the user's methods.
    pub(crate) fn law(&self, raised: &Raised) -> Box<dyn StateLaw<State = LogTheta>> {
        match self {
            Self::Aging(law) => Box::new(*law),
            Self::Slip(law) => Box::new(*law),
            Self::PerrinRiceZheng(law) => Box::new(*law),
            Self::KatoTullis(law) => Box::new(*law),
            Self::Sato(law) => Box::new(*law),
            Self::Nagata(law) => Box::new(*law),
            Self::Own(law) => Box::new(law.reporting_to(raised)),
        }
    }
}

/// The names of state laws.
const LAWS: &str = "\"aging\", \"slip\", \"perrin-rice-zheng\", \"kato-tullis\", \"sato\", \"nagata\" or a law of your own";

/// Parameters of some state laws only.
#[derive(Clone, Copy, Default)]
pub(crate) struct Further {
    /// `Vc` of Kato and Tullis [m/s].
    pub(crate) aging_velocity: Option<f64>,
    /// `c` of Nagata.
    pub(crate) stress_weight: Option<f64>,
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
