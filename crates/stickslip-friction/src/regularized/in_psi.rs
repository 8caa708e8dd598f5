//! Regularised friction that reads the state in units of friction.

use stickslip_state::{Dieterich, InPsi, LogTheta, Psi, Ruina};

use super::many_nodes::ManyNodes;
use crate::{FrictionError, FrictionLaw, RegularizedDieterichRuina, Response, SlipRates};

/// Regularised rate- and state-dependent friction with the state in units of friction, `mu = a asinh( V/(2 V0) exp(psi/a) )`.
///
/// It is [`RegularizedDieterichRuina`], whose [`in_psi`](RegularizedDieterichRuina::in_psi),
/// [`aging_in_psi`](RegularizedDieterichRuina::aging_in_psi) and [`slip_in_psi`](RegularizedDieterichRuina::slip_in_psi)
/// return it and its state laws, with `psi = mu0 + b ln(V0 theta/L)`; all functions are shared.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, RegularizedDieterichRuina};
/// # use stickslip_state::LogTheta;
/// let law = RegularizedDieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 8e-3,
/// };
/// let (in_psi, aging) = (law.in_psi(), law.aging_in_psi());
/// let state = LogTheta(12.0);
/// let (here, there) = (in_psi.coefficient(1e-3, aging.psi(state)), law.coefficient(1e-3, state));
/// assert!((here - there).abs() < 1e-15);
/// // The state that carries 30 MPa at 50 MPa and 1 nm/s.
/// let psi = in_psi.state_of_friction(30.0 / 50.0, 1e-9);
/// assert!((in_psi.coefficient(1e-9, psi) - 0.6).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("psi", "SeisSol", "tandem", "RSF", "rate and state friction"))]
pub struct RegularizedInPsi {
    /// `a`, the coefficient of the direct effect, finite and positive.
    pub a: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
}

impl RegularizedDieterichRuina {
    /// This friction with the state in units of friction.
    #[must_use]
    pub fn in_psi(&self) -> RegularizedInPsi {
        RegularizedInPsi {
            a: self.a,
            reference_velocity: self.reference_velocity,
        }
    }

    /// Dieterich's aging law with the state in units of friction; `b` must be positive.
    #[must_use]
    pub fn aging_in_psi(&self) -> InPsi<Dieterich> {
        self.evolution_in_psi(self.aging())
    }

    /// Ruina's slip law with the state in units of friction; `b` must be positive.
    #[must_use]
    pub fn slip_in_psi(&self) -> InPsi<Ruina> {
        self.evolution_in_psi(self.slip())
    }

    /// Any law of `ln theta` with the state in units of this friction; `b` must be positive.
    #[must_use]
    pub fn evolution_in_psi<T>(&self, law: T) -> InPsi<T> {
        InPsi {
            law,
            b: self.b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
        }
    }
}

impl RegularizedInPsi {
    /// The state in which friction is `coefficient > 0` at `V > 0` \[m/s\]: the initial state of a node from its shear stress
    /// over its normal stress. See [`Psi::of_friction`].
    #[must_use]
    #[doc(alias("initial state", "psi0"))]
    pub fn state_of_friction(&self, coefficient: f64, slip_rate: f64) -> Psi {
        Psi::of_friction(coefficient, slip_rate, (self.a, self.reference_velocity))
    }

    /// The law whose `mu0 + b (alpha + ln(V0/L))` is its `alpha`.
    pub(crate) fn in_theta(self) -> RegularizedDieterichRuina {
        RegularizedDieterichRuina {
            a: self.a,
            b: 1.0,
            reference_friction: 0.0,
            reference_velocity: self.reference_velocity,
            slip_distance: self.reference_velocity,
        }
    }

    /// Passes over nodes with these laws.
    pub(crate) fn many_nodes(laws: impl Iterator<Item = Self>) -> Box<dyn SlipRates<Psi>> {
        let laws: Vec<_> = laws.map(Self::in_theta).collect();
        Box::new(ManyNodes::new(&laws))
    }
}

impl FrictionLaw for RegularizedInPsi {
    type State = Psi;

    fn coefficient(&self, slip_rate: f64, Psi(psi): Psi) -> f64 {
        self.in_theta().coefficient(slip_rate, LogTheta(psi))
    }

    /// `a / sqrt( V^2 + (2 V0 exp(-psi/a))^2 )`; infinite where that overflows.
    fn coefficient_rate_slope(&self, slip_rate: f64, Psi(psi): Psi) -> f64 {
        (self.in_theta()).coefficient_rate_slope(slip_rate, LogTheta(psi))
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, Psi(psi): Psi) -> (f64, f64) {
        (self.in_theta()).coefficient_and_rate_slope(slip_rate, LogTheta(psi))
    }

    fn response(&self, slip_rate: f64, Psi(psi): Psi) -> Response {
        self.in_theta().response(slip_rate, LogTheta(psi))
    }

    fn potential(&self, slip_rate: f64, Psi(psi): Psi) -> f64 {
        self.in_theta().potential(slip_rate, LogTheta(psi))
    }

    /// `tanh(mu/a)`.
    fn coefficient_state_slope(&self, slip_rate: f64, Psi(psi): Psi) -> f64 {
        (self.in_theta()).coefficient_state_slope(slip_rate, LogTheta(psi))
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, Psi(psi): Psi) -> f64 {
        (self.in_theta()).slip_rate(viscosity, drive, LogTheta(psi))
    }

    fn slip_rates(laws: &[Self]) -> Option<Box<dyn SlipRates<Psi>>> {
        Some(Self::many_nodes(laws.iter().copied()))
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_positive("a", self.a)?;
        FrictionError::check_positive("reference_velocity", self.reference_velocity)
    }
}
