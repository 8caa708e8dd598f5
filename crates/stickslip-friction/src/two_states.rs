//! The parameters of friction with two state variables.

use crate::DieterichRuina;

/// Friction with two state variables, `mu = mu0 + a ln(V/V0) + b1 (alpha1 + ln(V0/L1)) + b2 (alpha2 + ln(V0/L2))`: its
/// parameters. Each state evolves by its own law. Velocity steps with recovery over two distances are fitted with it.
///
/// A contact has one state per vertex, so this is no [`FrictionLaw`](crate::FrictionLaw). Two contacts on the same part
/// carry the sum of their frictions: give each one of the two [`parts`](Self::parts). These are laws, each a
/// [`DieterichRuina`] with half of `mu0` and `a`. Their sum differs from the formula if one of the parts is cut off at
/// zero, far below the rates at which `mu` is.
///
/// Source: A. Ruina, *Slip instability and state variable friction laws*, J. Geophys. Res. 88 (1983).
///
/// ```
/// use stickslip_friction::{FrictionLaw, TwoStates};
/// use stickslip_state::LogTheta;
///
/// let friction = TwoStates {
///     a: 0.010,
///     b: [0.012, 0.004],
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: [1e-5, 1e-4],
/// };
/// let [fast, slow] = friction.parts();
/// // Ten times as fast, and steady only by the first state.
/// let mu = fast.coefficient(1e-5, LogTheta(0.0)) + slow.coefficient(1e-5, LogTheta(100f64.ln()));
/// assert!((mu - (0.6 + (0.010 - 0.012) * 10f64.ln())).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoStates {
    /// `a`, the coefficient of the direct effect, finite and positive.
    pub a: f64,
    /// `b1` and `b2`, the coefficients of the evolution effects, finite and non-negative.
    pub b: [f64; 2],
    /// `mu0`, the coefficient at `V = V0` in steady states of both, finite and non-negative.
    pub reference_friction: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
    /// `L1` and `L2` \[m\], the characteristic slip distances, finite and positive.
    pub slip_distance: [f64; 2],
}

impl TwoStates {
    /// The friction law of each state, for a separate contact on the same part, under the same normal stress.
    ///
    /// Both contacts must be bilateral: with a free normal component each would exert the normal stress.
    #[must_use]
    pub fn parts(&self) -> [DieterichRuina; 2] {
        [0, 1].map(|k| DieterichRuina {
            a: 0.5 * self.a,
            b: self.b[k],
            reference_friction: 0.5 * self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance[k],
        })
    }

    /// `max(0, mu0 + (a - b1 - b2) ln(V/V0))`, the steady-state coefficient at `V > 0` \[m/s\].
    #[must_use]
    pub fn steady_coefficient(&self, slip_rate: f64) -> f64 {
        let faster = (slip_rate / self.reference_velocity).ln();
        (self.reference_friction + (self.a - self.b[0] - self.b[1]) * faster).max(0.0)
    }
}
