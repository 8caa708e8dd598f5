//! The slip law towards a strongly rate-weakening steady state.

mod many_nodes;

use crate::{Evolutions, Psi, StateError, StateLaw};
use many_nodes::ManyNodes;

/// The least `f_ss/a`: parameters far from those of rocks would make steady friction negative.
const LEAST: f64 = 1e-3;

/// The slip law of strong rate weakening by flash heating, `psi' = -(V/L) (psi - psi_ss(V))`, with the state in units of
/// friction, `mu = a asinh( V/(2 V0) exp(psi/a) )`:
///
/// ```text
/// f_LV   = mu0 - (b - a) ln(V/V0)
/// f_ss   = f_w + (f_LV - f_w)/(1 + (V/V_w)^8)^(1/8)
/// psi_ss = a ln( (2 V0/V) sinh(f_ss/a) )
/// ```
///
/// Steady friction is that of Dieterich and Ruina far below the weakening velocity `V_w`, and falls as `1/V` to the
/// weakened friction `f_w` above. There `-df_ss/d ln V` exceeds `b - a` by far, 44 times in TPV103: cells resolve
/// `G L/(sigma_n 0.18)`, not `G L/(sigma_n (b - a))`. At rest the state does not change. Steady friction is at least `a/1000`.
///
/// `StrongRateWeakening` of the friction laws has the same parameters and returns this law.
///
/// Sources: E. M. Dunham, D. Belanger, L. Cong, J. E. Kozdon, *Earthquake ruptures with strongly rate-weakening friction and
/// off-fault plasticity*, Bull. Seismol. Soc. Am. 101 (2011); TPV103 of SCEC, of which these are numbers.
///
/// ```
/// # use stickslip_state::{Psi, StateLaw, StrongWeakening};
/// let law = StrongWeakening {
///     a: 0.01,
///     b: 0.014,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.4,
///     weakened_friction: 0.2,
///     weakening_velocity: 0.1,
/// };
/// assert!((law.steady_coefficient(1.0) - 0.234_473_796).abs() < 1e-9);
/// // One metre of slip, 2.5 L, at 1 m/s.
/// let Psi(psi) = law.advance_at_constant_rate(Psi(0.6), 1.0, 1.0)?;
/// let Psi(steady) = law.steady_state(1.0);
/// assert!((psi - steady - (0.6 - steady) * (-2.5f64).exp()).abs() < 1e-15);
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("flash heating", "strong rate weakening", "TPV103", "TPV104"))]
pub struct StrongWeakening {
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

/// Steady friction and its derivative in `ln V`.
struct Steady {
    coefficient: f64,
    along: f64,
}

impl StrongWeakening {
    /// `f_ss(V)`, the coefficient of friction of steady sliding at `V > 0` \[m/s\].
    #[must_use]
    pub fn steady_coefficient(&self, slip_rate: f64) -> f64 {
        self.steady(slip_rate).coefficient
    }

    /// `psi_ss(V)`, the state of steady sliding at `V > 0` \[m/s\].
    #[must_use]
    pub fn steady_state(&self, slip_rate: f64) -> Psi {
        let scale = (self.a, self.reference_velocity);
        Psi::of_friction(self.steady_coefficient(slip_rate), slip_rate, scale)
    }

    fn steady(&self, slip_rate: f64) -> Steady {
        let ln_rate = slip_rate.ln();
        let fall = self.b - self.a;
        let slow = self.reference_friction - fall * (ln_rate - self.reference_velocity.ln());
        let excess = 8.0 * (ln_rate - self.weakening_velocity.ln());
        // ln(1 + (V/V_w)^8) without overflow.
        let part = (-excess.abs()).exp();
        let softplus = excess.max(0.0) + part.ln_1p();
        let factor = (-0.125 * softplus).exp();
        let share = if excess > 0.0 { 1.0 } else { part } / (1.0 + part);
        let above = slow - self.weakened_friction;
        let coefficient = self.weakened_friction + above * factor;
        let least = LEAST * self.a;
        if coefficient < least {
            return Steady {
                coefficient: least,
                along: 0.0,
            };
        }
        Steady {
            coefficient,
            along: -factor * (fall + above * share),
        }
    }

    /// `psi_ss` and `d psi_ss/d ln V = coth(f_ss/a) df_ss/d ln V - a`; rates below the normal numbers count as the smallest
    /// of these.
    fn steady_and_slope(&self, slip_rate: f64) -> (f64, f64) {
        let rate = slip_rate.max(f64::MIN_POSITIVE);
        let Steady { coefficient, along } = self.steady(rate);
        let Psi(psi) = Psi::of_friction(coefficient, rate, (self.a, self.reference_velocity));
        (psi, along / (coefficient / self.a).tanh() - self.a)
    }
}

impl StateLaw for StrongWeakening {
    type State = Psi;

    fn evolution(&self, Psi(psi): Psi, slip_rate: f64) -> f64 {
        let rate = slip_rate / self.slip_distance;
        if rate > 0.0 {
            let (steady, _) = self.steady_and_slope(slip_rate);
            rate * (steady - psi)
        } else {
            0.0
        }
    }

    fn evolutions(laws: &[Self]) -> Option<Box<dyn Evolutions<Psi>>> {
        Some(Box::new(ManyNodes::new(laws)))
    }

    fn evolution_state_slope(&self, _state: Psi, slip_rate: f64) -> f64 {
        -slip_rate / self.slip_distance
    }

    /// Backward Euler in closed form, `psi + (psi_ss - psi) c/(1 + c)` with `c = dt V/L`.
    fn advance(&self, Psi(from): Psi, slip_rate: f64, dt: f64) -> Result<Psi, StateError> {
        StateError::check_step(slip_rate, dt)?;
        let c = dt * (slip_rate / self.slip_distance);
        if c > 0.0 {
            let (steady, _) = self.steady_and_slope(slip_rate);
            return Ok(Psi((from + c * steady) / (1.0 + c)));
        }
        Ok(Psi(from))
    }

    /// `psi exp(-x) + psi_ss (1 - exp(-x))` with `x = dt V/L`.
    fn advance_exact(&self, Psi(from): Psi, slip_rate: f64, dt: f64) -> Option<Psi> {
        let x = dt * (slip_rate / self.slip_distance);
        if x > 0.0 {
            let (steady, _) = self.steady_and_slope(slip_rate);
            return Some(Psi(from * (-x).exp() - steady * (-x).exp_m1()));
        }
        Some(Psi(from))
    }

    /// `(dt/L) ( (psi_ss - from)/(1 + c) + d psi_ss/d ln V )/(1 + c)` with `c = dt V/L`; towards rest it grows like `-ln V`
    /// and stays at its value for the smallest normal `V`.
    fn advance_rate_slope(&self, Psi(from): Psi, _to: Psi, slip_rate: f64, dt: f64) -> f64 {
        let c = dt * (slip_rate / self.slip_distance);
        let (steady, slope) = self.steady_and_slope(slip_rate);
        dt / self.slip_distance / (1.0 + c) * ((steady - from) / (1.0 + c) + slope)
    }

    /// `(dt/L) ( exp(-x) (psi_ss - from) + (1 - exp(-x))/x d psi_ss/d ln V )` with `x = dt V/L`; the limit at rest is as for
    /// backward Euler.
    fn advance_at_constant_rate_rate_slope(
        &self,
        Psi(from): Psi,
        _to: Psi,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let x = dt * (slip_rate / self.slip_distance);
        let (steady, slope) = self.steady_and_slope(slip_rate);
        let mean_decay = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
        dt / self.slip_distance * ((-x).exp() * (steady - from) + mean_decay * slope)
    }

    fn validate(&self) -> Result<(), StateError> {
        let non_negative = |what, value: f64| {
            let legal = value.is_finite() && value >= 0.0;
            StateError::check(what, "finite and non-negative", value, legal)
        };
        StateError::check_positive("a", self.a)?;
        non_negative("b", self.b)?;
        non_negative("reference_friction", self.reference_friction)?;
        StateError::check_positive("reference_velocity", self.reference_velocity)?;
        StateError::check_positive("slip_distance", self.slip_distance)?;
        non_negative("weakened_friction", self.weakened_friction)?;
        StateError::check_positive("weakening_velocity", self.weakening_velocity)
    }
}
