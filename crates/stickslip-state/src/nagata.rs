//! Nagata's law: aging weakened by stress.

use crate::{Dieterich, LogTheta, StateError, StateLaw};

/// The law of Nagata and others, `theta' = 1 - V theta/L - (c/b) theta mu'`: aging, weakened by the rate of the
/// coefficient of friction `mu`.
///
/// With friction `mu = mu0 + a ln(V/V0) + b ln(V0 theta/L)` the rate `mu'` can be eliminated. The state of this law is
/// the logarithm of the `theta` with the same friction at the rate `V0`, with a part of `a`:
///
/// ```text
/// alpha = ln theta + p ln(V/V0),    p = (a/b) c/(1 + c)
/// alpha' = (1/theta - V/L) / (1 + c)
/// mu = mu0 + a/(1 + c) ln(V/V0) + b (alpha + ln(V0/L)).
/// ```
///
/// Friction is then that of Dieterich and Ruina with `a/(1 + c)` for `a`; `DieterichRuina::weakened_by_stress` of the
/// friction laws returns it with this law. In this form the law holds while friction is not cut off and the contact
/// slides. At `V = 0` it is its limit, `alpha' = 0`. In steady sliding `theta = L/V`.
///
/// Source: K. Nagata, M. Nakatani, S. Yoshida, *A revised rate- and state-dependent friction law obtained by constraining
/// constitutive and evolution laws separately with laboratory data*, J. Geophys. Res. 117 (2012), where `c` is about 2.
///
/// ```
/// # use stickslip_state::{LogTheta, Nagata, StateLaw};
/// let law = Nagata {
///     slip_distance: 1e-5,
///     stress_weight: 2.0,
///     rate_over_state: 0.9, // a/b
///     reference_velocity: 1e-6,
/// };
/// let alpha = law.advance(LogTheta(0.0), 1e-5, 1e9)?;
/// assert!(law.ln_theta(alpha, 1e-5).abs() < 1e-8); // theta = L/V
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nagata {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    pub slip_distance: f64,
    /// `c`, the weight of the stress rate, finite and positive.
    pub stress_weight: f64,
    /// `a/b`, finite and positive.
    pub rate_over_state: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
}

impl Nagata {
    /// `ln(theta / 1 s)` at the slip rate `V > 0` \[m/s\].
    #[must_use]
    pub fn ln_theta(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        alpha - self.offset(slip_rate)
    }

    /// The state with this `theta` \[s\] at the slip rate `V > 0` \[m/s\].
    #[must_use]
    pub fn state(&self, theta: f64, slip_rate: f64) -> LogTheta {
        LogTheta(theta.ln() + self.offset(slip_rate))
    }

    /// `p`.
    fn power(&self) -> f64 {
        self.rate_over_state * self.stress_weight / (1.0 + self.stress_weight)
    }

    /// `p ln(V/V0)`; rates below the normal numbers count as the smallest of these.
    fn offset(&self, slip_rate: f64) -> f64 {
        let rate = slip_rate.max(f64::MIN_POSITIVE);
        self.power() * (rate.ln() - self.reference_velocity.ln())
    }

    /// `p/V`.
    fn offset_slope(&self, slip_rate: f64) -> f64 {
        self.power() / slip_rate.max(f64::MIN_POSITIVE)
    }

    /// The aging law of `ln theta` at constant slip rate, in a time shorter by `1 + c`.
    fn aging(&self) -> Dieterich {
        Dieterich {
            slip_distance: self.slip_distance,
        }
    }

    /// `dt/(1 + c)`.
    fn aging_time(&self, dt: f64) -> f64 {
        dt / (1.0 + self.stress_weight)
    }
}

impl StateLaw for Nagata {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        if slip_rate == 0.0 {
            return 0.0;
        }
        let young = (-self.ln_theta(state, slip_rate)).exp();
        (young - slip_rate / self.slip_distance) / (1.0 + self.stress_weight)
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        if slip_rate == 0.0 {
            return 0.0;
        }
        -(-self.ln_theta(state, slip_rate)).exp() / (1.0 + self.stress_weight)
    }

    /// The step of the aging law in the time `dt/(1 + c)`.
    fn advance(&self, from: LogTheta, slip_rate: f64, dt: f64) -> Result<LogTheta, StateError> {
        StateError::check_step(slip_rate, dt)?;
        if dt == 0.0 || slip_rate == 0.0 {
            return Ok(from);
        }
        let start = LogTheta(self.ln_theta(from, slip_rate));
        let end = (self.aging()).advance(start, slip_rate, self.aging_time(dt))?;
        Ok(LogTheta(from.0 + (end.0 - start.0)))
    }

    /// The solution of the aging law after the time `dt/(1 + c)`.
    fn advance_exact(&self, from: LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        if slip_rate == 0.0 {
            return Some(from);
        }
        let start = LogTheta(self.ln_theta(from, slip_rate));
        let end = (self.aging()).advance_exact(start, slip_rate, self.aging_time(dt))?;
        Some(LogTheta(from.0 + (end.0 - start.0)))
    }

    /// The slope of the aging law, and `p/V` times the share of new `theta`, `1/(1 + (1 + c) theta/dt)` with `theta`
    /// after the step. Towards rest it stays at its value for the smallest normal `V`.
    fn advance_rate_slope(&self, from: LogTheta, to: LogTheta, slip_rate: f64, dt: f64) -> f64 {
        let [start, end] = [from, to].map(|state| LogTheta(self.ln_theta(state, slip_rate)));
        let time = self.aging_time(dt);
        let worn = self.aging().advance_rate_slope(start, end, slip_rate, time);
        let new = (1.0 + end.0.exp() / time).recip();
        worn + self.offset_slope(slip_rate) * new
    }

    /// The slope of the aging law, and `p/V` times the share of new `theta`.
    fn advance_at_constant_rate_rate_slope(
        &self,
        from: LogTheta,
        to: LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let [start, end] = [from, to].map(|state| LogTheta(self.ln_theta(state, slip_rate)));
        let time = self.aging_time(dt);
        let worn = (self.aging()).advance_at_constant_rate_rate_slope(start, end, slip_rate, time);
        let left = start.0 - time * (slip_rate / self.slip_distance) - end.0;
        worn - self.offset_slope(slip_rate) * left.min(0.0).exp_m1()
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)?;
        StateError::check_positive("stress_weight", self.stress_weight)?;
        StateError::check_positive("rate_over_state", self.rate_over_state)?;
        StateError::check_positive("reference_velocity", self.reference_velocity)
    }
}
