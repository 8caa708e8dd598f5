//! The parameters of the model.

use stickslip_friction::DieterichRuina;

use crate::error::LabError;
use crate::evolution::Evolution;

/// The evolution effect of one state variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateParameters {
    /// `b`, the coefficient of the evolution effect, of any sign.
    pub b: f64,
    /// `L` \[m\], the characteristic slip distance, > 0.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
    /// `ln(theta/theta_ss)` at the first sample, with the steady state `theta_ss` at the slip rate of the load point there,
    /// `L/V` by most laws; 0 in steady sliding.
    pub initial_state: f64,
    /// `Vc` > 0 [m/s] of the law of Kato and Tullis, up to which contacts age; other laws do not have it.
    pub aging_velocity: f64,
    /// `c` > 0 of Nagata's law, the weight of the stress rate; other laws do not have it.
    pub stress_weight: f64,
}

/// `Vc` [m/s]. Source: N. Kato, T. E. Tullis, "A composite rate- and state-dependent law for rock friction", Geophys. Res.
/// Lett. 28 (2001).
const AGING_VELOCITY: f64 = 1e-8;
/// `c`. Source: K. Nagata, M. Nakatani, S. Yoshida, "A revised rate- and state-dependent friction law obtained by
/// constraining constitutive and evolution laws separately with laboratory data", J. Geophys. Res. 117 (2012).
const STRESS_WEIGHT: f64 = 2.0;

impl StateParameters {
    /// A state that is steady at the first sample, with the published parameters of laws: `Vc` = 1e-8 m/s of Kato and Tullis
    /// (2001), `c` = 2 of Nagata, Nakatani and Yoshida (2012).
    pub fn steady(b: f64, slip_distance: f64) -> Self {
        Self {
            b,
            slip_distance,
            initial_state: 0.0,
            aging_velocity: AGING_VELOCITY,
            stress_weight: STRESS_WEIGHT,
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

    /// The critical stiffness `K/sigma_n` [1/m] by the aging or slip law: steady sliding on a softer spring is unstable.
    ///
    /// With one state `(b - a)/L`, else the root of the characteristic polynomial. It is at most 0 if no spring is
    /// unstable. Source: J.-C. Gu, J. R. Rice, A. L. Ruina, S. T. Tse, *Slip motion and stability of a single degree of
    /// freedom elastic system with rate and state dependent friction*, J. Mech. Phys. Solids 32 (1984).
    pub fn critical_stiffness(&self) -> f64 {
        self.critical_stiffness_by(&[])
    }

    /// The critical stiffness [1/m] by these state laws, one per state: with one state of Nagata's law
    /// `(b - a)/(L (1 + c))`. The law of Kato and Tullis counts as the slip law, which it is far above `Vc`; laws of one's own
    /// count as the aging law.
    pub fn critical_stiffness_by(&self, laws: &[Evolution<'_>]) -> f64 {
        // With p = 1/L1, q = 1/L2 and the rate s per slip: a s + k = sum s (b_i p_i - c_i k)/(s + p_i).
        let weight = |i: usize| match laws.get(i) {
            Some(Evolution::Nagata) => self.states[i].stress_weight,
            _ => 0.0,
        };
        match self.states[..] {
            [one] => (one.b - self.a) / (one.slip_distance * (1.0 + weight(0))),
            [one, two] => {
                // A cubic a s^3 + x s^2 + y s + k p q with x = c + k m and y = d + k n, whose roots have real part zero
                // where x y = a k p q.
                let (p, q) = (1.0 / one.slip_distance, 1.0 / two.slip_distance);
                let c = self.a * (p + q) - one.b * p - two.b * q;
                let d = (self.a - one.b - two.b) * p * q;
                let m = 1.0 + weight(0) + weight(1);
                let n = p + q + weight(0) * q + weight(1) * p;
                let half = 0.5 * (c * n + d * m - self.a * p * q) / (m * n);
                let discriminant = half * half - c * d / (m * n);
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
            LabError::check_positive("aging velocity Vc [m/s]", i, state.aging_velocity)?;
            LabError::check_positive("stress weight c", i, state.stress_weight)?;
        }
        LabError::check_finite("reference friction", 0, self.reference_friction)?;
        LabError::check_positive("reference velocity [m/s]", 0, self.reference_velocity)?;
        LabError::check_positive("stiffness [1/m]", 0, self.stiffness)?;
        LabError::check_finite("trend", 0, self.trend)
    }
}
