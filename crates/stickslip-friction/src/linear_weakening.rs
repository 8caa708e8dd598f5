//! Friction that falls from a static to a dynamic coefficient.

use stickslip_state::Weakening;

use crate::{FrictionError, FrictionLaw};

/// Linear weakening: `mu = mu_s - (mu_s - mu_d) min(max(w, 0), 1)`.
///
/// The state law says what weakens: [`SlipWeakening`](stickslip_state::SlipWeakening) with `w = D/D_c` is linear slip
/// weakening, [`HealingSlipWeakening`](stickslip_state::HealingSlipWeakening) one that heals,
/// [`TimeWeakening`](stickslip_state::TimeWeakening) a forced rupture. Cohesion is a parameter of the
/// contact: the strength is `c + mu sigma_n`.
///
/// ```text
/// mu_s |\
///      | \            slope (mu_s - mu_d)/D_c
///      |  \
/// mu_d |   \__________
///      +---+-----------> D
///          D_c
/// ```
///
/// There is no direct effect: a node of stiffness below `sigma_n (mu_s - mu_d)/D_c` is unstable, and without inertia or
/// radiation damping no step has one solution then. Between different materials, where slip changes the normal stress,
/// dynamic problems with this law are ill-posed.
///
/// Sources: Y. Ida (1972); D. J. Andrews (1976); the TPV benchmarks of SCEC, of which these are the parameters of TPV5.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, LinearWeakening};
/// # use stickslip_state::{SlipWeakening, StateLaw, Weakening};
/// let law = LinearWeakening { static_friction: 0.677, dynamic_friction: 0.525 };
/// let slip = SlipWeakening { slip_distance: 0.40 };
/// let half = slip.advance(Weakening(0.0), 0.1, 2.0)?;
/// assert!((law.coefficient(0.1, half) - 0.601).abs() < 1e-15);
/// // J/m^2, at a normal stress of 120 MPa.
/// assert!((law.fracture_energy(120e6, slip.slip_distance) - 3.648e6).abs() < 1e-6);
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias(
    "LinearSlipWeakening",
    "linear slip weakening",
    "slip weakening",
    "LSW",
    "TPV"
))]
pub struct LinearWeakening {
    /// `mu_s`, the static coefficient, finite and not below `dynamic_friction`.
    pub static_friction: f64,
    /// `mu_d`, the dynamic coefficient, finite and non-negative.
    pub dynamic_friction: f64,
}

impl LinearWeakening {
    /// The work of slip above the dynamic strength per area, `G_c = sigma_n (mu_s - mu_d) D_c/2` \[J/m^2\], at a normal
    /// stress `sigma_n` \[Pa\] and `D_c` \[m\].
    #[must_use]
    #[doc(alias = "breakdown work")]
    pub fn fracture_energy(&self, normal_stress: f64, slip_distance: f64) -> f64 {
        0.5 * normal_stress * (self.static_friction - self.dynamic_friction) * slip_distance
    }
}

impl FrictionLaw for LinearWeakening {
    type State = Weakening;

    fn coefficient(&self, _slip_rate: f64, state: Weakening) -> f64 {
        // A mean, which is the dynamic coefficient itself in the end.
        let weakened = state.fraction();
        (1.0 - weakened) * self.static_friction + weakened * self.dynamic_friction
    }

    fn coefficient_rate_slope(&self, _slip_rate: f64, _state: Weakening) -> f64 {
        0.0
    }

    fn potential(&self, slip_rate: f64, state: Weakening) -> f64 {
        self.coefficient(slip_rate, state) * slip_rate
    }

    /// `-(mu_s - mu_d)` for `0 <= w < 1`, else 0: the slope to the right, since the state increases.
    fn coefficient_state_slope(&self, _slip_rate: f64, Weakening(w): Weakening) -> f64 {
        if (0.0..1.0).contains(&w) {
            self.dynamic_friction - self.static_friction
        } else {
            0.0
        }
    }

    /// `max(0, drive - mu) / viscosity`.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: Weakening) -> f64 {
        (drive - self.coefficient(0.0, state)).max(0.0) / viscosity
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_non_negative("dynamic_friction", self.dynamic_friction)?;
        FrictionError::check_non_negative("static_friction", self.static_friction)?;
        FrictionError::check(
            "static_friction",
            "at least dynamic_friction",
            self.static_friction,
            self.static_friction >= self.dynamic_friction,
        )
    }
}
