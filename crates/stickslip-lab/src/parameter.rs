//! The names of parameters.

use std::fmt;
use std::str::FromStr;

use crate::error::LabError;
use crate::evolution::Evolution;
use crate::parameters::Parameters;

/// A parameter of a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Parameter {
    /// `a`.
    A,
    /// `b` of a state, from 0 on.
    B(usize),
    /// `L` of a state, from 0 on \[m\].
    SlipDistance(usize),
    /// `K/sigma_n` [1/m].
    Stiffness,
    /// `ln(theta/theta_ss)` of a state at the first sample, from 0 on.
    InitialState(usize),
    /// `Vc` of the law of Kato and Tullis [m/s], of a state from 0 on.
    AgingVelocity(usize),
    /// `c` of Nagata's law, of a state from 0 on.
    StressWeight(usize),
    /// `mu0`.
    ReferenceFriction,
    /// The slope of the trend [1/s] or [1/m].
    Trend,
    /// The time by which all velocity changes are later than the load history says \[s\].
    StepOffset,
    /// Shear over normal stress at the first sample above that at which the block slides with the load point, in its initial
    /// state: its slip rate is `V_lp exp(initial_stress/a)`.
    InitialStress,
}

impl Parameter {
    /// Whether the fit varies its logarithm: it is positive.
    pub(crate) fn is_logarithmic(self) -> bool {
        matches!(
            self,
            Self::A
                | Self::SlipDistance(_)
                | Self::Stiffness
                | Self::AgingVelocity(_)
                | Self::StressWeight(_)
        )
    }

    /// The state of the parameter, from 0 on.
    pub(crate) fn state(self) -> Option<usize> {
        match self {
            Self::B(i)
            | Self::SlipDistance(i)
            | Self::InitialState(i)
            | Self::AgingVelocity(i)
            | Self::StressWeight(i) => Some(i),
            _ => None,
        }
    }

    /// Whether all records of a fit share it: a parameter of friction, not of a machine or of a record.
    pub(crate) fn is_shared(self) -> bool {
        matches!(self, Self::A | Self::B(_) | Self::SlipDistance(_)) || self.is_of_law()
    }

    /// Whether it is one that some laws have beside `L`.
    pub(crate) fn is_of_law(self) -> bool {
        matches!(self, Self::AgingVelocity(_) | Self::StressWeight(_))
    }

    /// Requires a model with the state of the parameter, and with its law.
    pub(crate) fn check(self, laws: &[Evolution<'_>]) -> Result<(), LabError> {
        let Some(i) = self.state() else { return Ok(()) };
        let Some(law) = laws.get(i) else {
            return Err(LabError::States {
                expected: "as many as there are state laws",
                found: i + 1,
            });
        };
        if self.is_of_law() && law.parameter(i) != Some(self) {
            return Err(LabError::OtherLaw {
                parameter: self,
                law: law.name(),
            });
        }
        Ok(())
    }

    /// Its value; 0 of the time of steps and of the initial stress, which are no parameters of friction or machine
    /// ([`Fitted::value`](crate::Fitted::value) has them).
    pub fn of(self, parameters: &Parameters) -> f64 {
        match self {
            Self::A => parameters.a,
            Self::B(i) => parameters.states[i].b,
            Self::SlipDistance(i) => parameters.states[i].slip_distance,
            Self::Stiffness => parameters.stiffness,
            Self::InitialState(i) => parameters.states[i].initial_state,
            Self::AgingVelocity(i) => parameters.states[i].aging_velocity,
            Self::StressWeight(i) => parameters.states[i].stress_weight,
            Self::ReferenceFriction => parameters.reference_friction,
            Self::Trend => parameters.trend,
            Self::StepOffset | Self::InitialStress => 0.0,
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbered = |name: &str, i: usize| format!("{name}{}", i + 1);
        f.pad(&match *self {
            Self::A => "a".into(),
            Self::B(i) => numbered("b", i),
            Self::SlipDistance(i) => numbered("L", i),
            Self::Stiffness => "k".into(),
            Self::InitialState(i) => numbered("initial_state", i),
            Self::AgingVelocity(i) => numbered("Vc", i),
            Self::StressWeight(i) => numbered("c", i),
            Self::ReferenceFriction => "mu0".into(),
            Self::Trend => "trend".into(),
            Self::StepOffset => "step_offset".into(),
            Self::InitialStress => "initial_stress".into(),
        })
    }
}

impl FromStr for Parameter {
    type Err = LabError;

    /// Reads the name that is displayed; `b`, `L`, `Vc` and `c` are those of the first state.
    fn from_str(name: &str) -> Result<Self, LabError> {
        let numbered: [fn(usize) -> Self; 5] = [
            Self::B,
            Self::SlipDistance,
            Self::InitialState,
            Self::AgingVelocity,
            Self::StressWeight,
        ];
        let states = numbered
            .iter()
            .flat_map(|parameter| [parameter(0), parameter(1)]);
        let all = [
            Self::A,
            Self::Stiffness,
            Self::ReferenceFriction,
            Self::Trend,
            Self::StepOffset,
            Self::InitialStress,
        ];
        let mut all = all.into_iter().chain(states);
        let found = match name {
            "b" => Some(Self::B(0)),
            "L" => Some(Self::SlipDistance(0)),
            "Vc" => Some(Self::AgingVelocity(0)),
            "c" => Some(Self::StressWeight(0)),
            _ => all.find(|parameter| parameter.to_string() == name),
        };
        found.ok_or_else(|| LabError::Name { name: name.into() })
    }
}
