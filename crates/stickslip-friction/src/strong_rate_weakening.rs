//! Strong rate weakening by flash heating.

use stickslip_state::{Psi, StateError, StateLaw, StrongWeakening};

use crate::{FrictionError, FrictionLaw, RegularizedInPsi, Response, SlipRates};

/// Friction that weakens strongly with the slip rate, as by flash heating of contacts: `mu = a asinh( V/(2 V0) exp(psi/a) )`,
/// with the state law [`evolution`](Self::evolution), `psi' = -(V/L) (psi - psi_ss(V))`:
///
/// ```text
/// f_LV   = mu0 - (b - a) ln(V/V0)
/// f_ss   = f_w + (f_LV - f_w)/(1 + (V/V_w)^8)^(1/8)
/// psi_ss = a ln( (2 V0/V) sinh(f_ss/a) )
/// ```
///
/// At fixed state it is regularised friction, [`RegularizedInPsi`], and increases with the slip rate; steady friction falls
/// from `f_LV` to `f_w` about `V_w`. Below the least shear stress of steady sliding with radiation damping `eta`,
/// `min over V of sigma_n f_ss(V) + eta V`, a rupture is a pulse that heals.
///
/// Sources: those of [`StrongWeakening`]; TPV103 and TPV104 of SCEC, of which these are numbers.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, StrongRateWeakening};
/// let law = StrongRateWeakening {
///     a: 0.01,
///     b: 0.014,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.4,
///     weakened_friction: 0.2,
///     weakening_velocity: 0.1,
/// };
/// // Steady friction at the reference velocity, at the weakening velocity and at 10 m/s.
/// let steady = [1e-6, 0.1, 10.0].map(|rate| law.steady_coefficient(rate));
/// assert!((steady[0] - 0.6).abs() < 1e-15 && (steady[1] - 0.524_572).abs() < 1e-6);
/// assert!((steady[2] - 0.203_355).abs() < 1e-6);
/// // The start of TPV103: 40 MPa at 120 MPa.
/// let start = law.state_of_friction(40.0 / 120.0, 1e-16);
/// assert!((start.0 - 0.563_591_842_633).abs() < 1e-12);
/// assert!((law.coefficient(1e-16, start) - 1.0 / 3.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("flash heating", "flash weakening", "TPV103", "TPV104", "TPV105"))]
pub struct StrongRateWeakening {
    /// `a`, the coefficient of the direct effect, finite and positive.
    pub a: f64,
    /// `b`, the coefficient of the evolution effect at low velocity, finite and non-negative.
    pub b: f64,
    /// `mu0`, the coefficient of steady sliding at `V0`, finite and non-negative.
    pub reference_friction: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
    /// `f_w`, the weakened friction, finite and non-negative.
    pub weakened_friction: f64,
    /// `V_w` \[m/s\], the weakening velocity, finite and positive.
    pub weakening_velocity: f64,
}

impl StrongRateWeakening {
    /// The state law with these parameters.
    #[must_use]
    pub fn evolution(&self) -> StrongWeakening {
        StrongWeakening {
            a: self.a,
            b: self.b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
            weakened_friction: self.weakened_friction,
            weakening_velocity: self.weakening_velocity,
        }
    }

    /// `f_ss(V)`, the coefficient of friction of steady sliding at `V > 0` \[m/s\].
    #[must_use]
    pub fn steady_coefficient(&self, slip_rate: f64) -> f64 {
        self.evolution().steady_coefficient(slip_rate)
    }

    /// `psi_ss(V)`, the state of steady sliding at `V > 0` \[m/s\].
    #[must_use]
    pub fn steady_state(&self, slip_rate: f64) -> Psi {
        self.evolution().steady_state(slip_rate)
    }

    /// The state in which friction is `coefficient > 0` at `V > 0` \[m/s\]: the initial state of a node from its shear stress
    /// over its normal stress. See [`Psi::of_friction`].
    #[must_use]
    #[doc(alias("initial state", "psi0"))]
    pub fn state_of_friction(&self, coefficient: f64, slip_rate: f64) -> Psi {
        self.direct().state_of_friction(coefficient, slip_rate)
    }

    /// Friction at fixed state.
    fn direct(&self) -> RegularizedInPsi {
        RegularizedInPsi {
            a: self.a,
            reference_velocity: self.reference_velocity,
        }
    }
}

impl FrictionLaw for StrongRateWeakening {
    type State = Psi;

    fn coefficient(&self, slip_rate: f64, state: Psi) -> f64 {
        self.direct().coefficient(slip_rate, state)
    }

    /// `a / sqrt( V^2 + (2 V0 exp(-psi/a))^2 )`; infinite where that overflows.
    fn coefficient_rate_slope(&self, slip_rate: f64, state: Psi) -> f64 {
        self.direct().coefficient_rate_slope(slip_rate, state)
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: Psi) -> (f64, f64) {
        self.direct().coefficient_and_rate_slope(slip_rate, state)
    }

    fn response(&self, slip_rate: f64, state: Psi) -> Response {
        self.direct().response(slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, state: Psi) -> f64 {
        self.direct().potential(slip_rate, state)
    }

    /// `tanh(mu/a)`.
    fn coefficient_state_slope(&self, slip_rate: f64, state: Psi) -> f64 {
        self.direct().coefficient_state_slope(slip_rate, state)
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, state: Psi) -> f64 {
        self.direct().slip_rate(viscosity, drive, state)
    }

    fn slip_rates(laws: &[Self]) -> Option<Box<dyn SlipRates<Psi>>> {
        let laws = laws.iter().map(Self::direct);
        Some(RegularizedInPsi::many_nodes(laws))
    }

    fn validate(&self) -> Result<(), FrictionError> {
        match self.evolution().validate() {
            Err(StateError::Value {
                what,
                requirement,
                value,
            }) => FrictionError::check(what, requirement, value, false),
            _ => Ok(()),
        }
    }
}
