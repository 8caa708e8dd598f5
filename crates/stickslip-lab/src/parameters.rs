//! The parameters of the model.

use std::fmt;
use std::str::FromStr;

use stickslip_friction::DieterichRuina;

use crate::error::LabError;

/// The evolution effect of one state variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateParameters {
    /// `b`, the coefficient of the evolution effect, of any sign.
    pub b: f64,
    /// `L` \[m\], the characteristic slip distance, > 0.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
    /// `ln(theta V/L)` at the first sample, with the slip rate `V` of the load point there; 0 in steady sliding.
    pub initial_state: f64,
}

impl StateParameters {
    /// A state that is steady at the first sample.
    pub fn steady(b: f64, slip_distance: f64) -> Self {
        Self {
            b,
            slip_distance,
            initial_state: 0.0,
        }
    }
}

/// The parameters of friction and machine, with one or two states:
///
/// ```text
/// mu = mu0 + a ln(V/V0) + sum b_i ln(V0 theta_i/L_i) + trend,   dmu/dt = k (V_lp - V) without the trend
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    /// `a`, the coefficient of the direct effect, > 0.
    pub a: f64,
    /// `b` and `L` of each state.
    pub states: Vec<StateParameters>,
    /// `mu0`, the steady coefficient at `V0`.
    pub reference_friction: f64,
    /// `V0` > 0 [m/s], which is never fitted.
    pub reference_velocity: f64,
    /// `k = K/sigma_n` > 0 [1/m]: the stiffness of machine and sample [Pa/m] over the normal stress \[Pa\].
    pub stiffness: f64,
    /// The slope of a linear trend of friction from the first sample on, per second or per metre of load-point
    /// displacement; 0 for none.
    pub trend: f64,
}

impl Parameters {
    /// Parameters with one state, steady at first, without a trend; `stiffness` is `K/sigma_n` [1/m].
    pub fn one_state(friction: &DieterichRuina, stiffness: f64) -> Self {
        Self {
            a: friction.a,
            states: vec![StateParameters::steady(friction.b, friction.slip_distance)],
            reference_friction: friction.reference_friction,
            reference_velocity: friction.reference_velocity,
            stiffness,
            trend: 0.0,
        }
    }

    /// `a - sum b_i`, the velocity dependence of steady friction.
    pub fn a_minus_b(&self) -> f64 {
        self.a - self.states.iter().map(|state| state.b).sum::<f64>()
    }

    /// `mu0 + (a - sum b_i) ln(V/V0)`, the steady coefficient at `V` > 0 [m/s], without the trend.
    pub fn steady_coefficient(&self, slip_rate: f64) -> f64 {
        self.reference_friction + self.a_minus_b() * (slip_rate / self.reference_velocity).ln()
    }

    /// The friction law with the state `i`.
    pub fn friction(&self, i: usize) -> DieterichRuina {
        DieterichRuina {
            a: self.a,
            b: self.states[i].b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.states[i].slip_distance,
        }
    }

    /// The critical stiffness `K/sigma_n` [1/m]: steady sliding on a softer spring is unstable.
    ///
    /// With one state `(b - a)/L`, else the root of the characteristic polynomial. It is at most 0 if no spring is
    /// unstable. Source: J.-C. Gu, J. R. Rice, A. L. Ruina, S. T. Tse, *Slip motion and stability of a single degree of
    /// freedom elastic system with rate and state dependent friction*, J. Mech. Phys. Solids 32 (1984).
    pub fn critical_stiffness(&self) -> f64 {
        match self.states[..] {
            [one] => (one.b - self.a) / one.slip_distance,
            [one, two] => {
                // With p = 1/L1, q = 1/L2 and the rate s per slip: a s + k = sum b_i s p_i/(s + p_i), a cubic
                // a s^3 + x s^2 + y s + k p q with x = c + k and y = d + k (p + q), whose roots have real part zero
                // where x y = a k p q.
                let (p, q) = (1.0 / one.slip_distance, 1.0 / two.slip_distance);
                let c = self.a * (p + q) - one.b * p - two.b * q;
                let d = (self.a - one.b - two.b) * p * q;
                let (sum, product) = (p + q, p * q);
                let half = 0.5 * (c * sum + d - self.a * product) / sum;
                let discriminant = half * half - c * d / sum;
                if discriminant < 0.0 {
                    return 0.0;
                }
                -half + discriminant.sqrt()
            }
            _ => 0.0,
        }
    }

    /// Checks all values.
    pub(crate) fn validate(&self) -> Result<(), LabError> {
        if !(1..=2).contains(&self.states.len()) {
            return Err(LabError::States {
                expected: "1 or 2",
                found: self.states.len(),
            });
        }
        LabError::check_positive("a", 0, self.a)?;
        for (i, state) in self.states.iter().enumerate() {
            LabError::check_finite("b", i, state.b)?;
            LabError::check_positive("slip distance [m]", i, state.slip_distance)?;
            LabError::check_finite("initial state", i, state.initial_state)?;
        }
        LabError::check_finite("reference friction", 0, self.reference_friction)?;
        LabError::check_positive("reference velocity [m/s]", 0, self.reference_velocity)?;
        LabError::check_positive("stiffness [1/m]", 0, self.stiffness)?;
        LabError::check_finite("trend", 0, self.trend)
    }
}

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
    /// `ln(theta V/L)` of a state at the first sample, from 0 on.
    InitialState(usize),
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
        matches!(self, Self::A | Self::SlipDistance(_) | Self::Stiffness)
    }

    /// Requires a model with the state of the parameter.
    pub(crate) fn check_state(self, states: usize) -> Result<(), LabError> {
        match self {
            Self::B(i) | Self::SlipDistance(i) | Self::InitialState(i) if i >= states => {
                Err(LabError::States {
                    expected: "as many as there are state laws",
                    found: i + 1,
                })
            }
            _ => Ok(()),
        }
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
            Self::ReferenceFriction => "mu0".into(),
            Self::Trend => "trend".into(),
            Self::StepOffset => "step_offset".into(),
            Self::InitialStress => "initial_stress".into(),
        })
    }
}

impl FromStr for Parameter {
    type Err = LabError;

    /// Reads the name that is displayed; `b` and `L` are those of the first state.
    fn from_str(name: &str) -> Result<Self, LabError> {
        let numbered: [fn(usize) -> Self; 3] = [Self::B, Self::SlipDistance, Self::InitialState];
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
            _ => all.find(|parameter| parameter.to_string() == name),
        };
        found.ok_or_else(|| LabError::Name { name: name.into() })
    }
}
