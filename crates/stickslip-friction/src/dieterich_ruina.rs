//! Rate- and state-dependent friction with a cut-off.

use stickslip_state::{Dieterich, LogTheta, Nagata, Ruina, wright::omega};

use crate::{FrictionError, FrictionLaw, Response};

/// Dieterich's and Ruina's law of rate- and state-dependent friction, cut off at zero:
/// `mu = a max(0, ln(V/Vm))`, that is `mu0 + a ln(V/V0) + b (alpha + ln(V0/L))` above
///
/// ```text
/// Vm = V0 exp( -(mu0 + b (alpha + ln(V0/L))) / a ).
/// ```
///
/// Only the logarithm of `Vm` is ever formed: old contacts push `Vm` below the smallest `f64`. In floating point the
/// law then has a kink at rest, and is treated so: rates below [`f64::MIN_POSITIVE`] count as that rate,
/// `mu(0) = a ln(MIN_POSITIVE/Vm) > 0`, and a contact with a smaller creep rate sticks.
///
/// ```
/// # use stickslip_friction::{DieterichRuina, FrictionLaw};
/// # use stickslip_state::LogTheta;
/// let law = DieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 1e-5,
/// };
/// let steady = LogTheta(10f64.ln()); // theta = L/V0
/// assert!((law.coefficient(1e-6, steady) - 0.6).abs() < 1e-15);
/// let rate = law.slip_rate(1e3, 0.7, steady);
/// assert!((1e3 * rate + law.coefficient(rate, steady) - 0.7).abs() < 1e-15);
/// assert!((law.steady_coefficient(1e-5) - (0.6 - 0.005 * 10f64.ln())).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("RSF", "rate-and-state", "rate and state friction"))]
pub struct DieterichRuina {
    /// `a`, the coefficient of the direct effect, finite and positive.
    pub a: f64,
    /// `b`, the coefficient of the evolution effect, finite and non-negative.
    pub b: f64,
    /// `mu0`, the coefficient at `V = V0`, `theta = L/V0`, finite and non-negative.
    pub reference_friction: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
}

impl DieterichRuina {
    /// `ln(Vm / 1 m/s)`, the logarithm of the rate below which there is no friction.
    #[must_use]
    pub fn ln_cutoff_rate(&self, state: LogTheta) -> f64 {
        self.reference_velocity.ln() - self.coefficient_at_reference(state) / self.a
    }

    /// `max(0, mu0 + (a - b) ln(V/V0))`, the steady-state coefficient at `V > 0` [m/s], where `theta = L/V`: by the
    /// aging law as by the slip law.
    #[must_use]
    pub fn steady_coefficient(&self, slip_rate: f64) -> f64 {
        let faster = (slip_rate / self.reference_velocity).ln();
        (self.reference_friction + (self.a - self.b) * faster).max(0.0)
    }

    /// Dieterich's aging law with the characteristic slip distance of this friction.
    #[must_use]
    pub fn aging(&self) -> Dieterich {
        Dieterich {
            slip_distance: self.slip_distance,
        }
    }

    /// Ruina's slip law with the characteristic slip distance of this friction.
    #[must_use]
    pub fn slip(&self) -> Ruina {
        Ruina {
            slip_distance: self.slip_distance,
        }
    }

    /// This friction with the state of Nagata's law, in which stress weakens contacts with the weight `c > 0`: friction
    /// with `a/(1 + c)` for `a`, and the state law for it.
    ///
    /// The steady-state friction is that of `self`. See [`Nagata`] for the derivation; `b` must be positive.
    ///
    /// ```
    /// # use stickslip_friction::{DieterichRuina, FrictionLaw};
    /// # let law = DieterichRuina {
    /// #     a: 0.008,
    /// #     b: 0.01,
    /// #     reference_friction: 0.6,
    /// #     reference_velocity: 1e-6,
    /// #     slip_distance: 1e-5,
    /// # };
    /// let (friction, evolution) = law.weakened_by_stress(2.0);
    /// let steady = evolution.state(1.0, 1e-5); // theta = L/V
    /// assert!((friction.coefficient(1e-5, steady) - law.steady_coefficient(1e-5)).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn weakened_by_stress(&self, stress_weight: f64) -> (Self, Nagata) {
        let friction = Self {
            a: self.a / (1.0 + stress_weight),
            ..*self
        };
        let evolution = Nagata {
            slip_distance: self.slip_distance,
            stress_weight,
            rate_over_state: self.a / self.b,
            reference_velocity: self.reference_velocity,
        };
        (friction, evolution)
    }

    /// `mu0 + b (alpha + ln(V0/L))`, the coefficient at `V0` before the cut-off.
    pub(crate) fn coefficient_at_reference(&self, LogTheta(alpha): LogTheta) -> f64 {
        let aging = alpha + (self.reference_velocity / self.slip_distance).ln();
        self.reference_friction + self.b * aging
    }

    /// `ln(V/Vm)`, the coefficient over `a` before the cut-off.
    pub(crate) fn excess(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let rate = slip_rate.max(f64::MIN_POSITIVE);
        ln_ratio(rate, self.reference_velocity) + self.coefficient_at_reference(state) / self.a
    }
}

impl FrictionLaw for DieterichRuina {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.a * self.excess(slip_rate, state).max(0.0)
    }

    /// `a/V` above `Vm`, 0 below.
    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        if self.excess(slip_rate, state) > 0.0 {
            self.a / slip_rate
        } else {
            0.0
        }
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: LogTheta) -> (f64, f64) {
        let response = self.response(slip_rate, state);
        (response.coefficient, response.rate_slope)
    }

    #[inline]
    fn response(&self, slip_rate: f64, state: LogTheta) -> Response {
        let excess = self.excess(slip_rate, state);
        let slides = excess > 0.0;
        Response {
            coefficient: self.a * excess.max(0.0),
            rate_slope: if slides { self.a / slip_rate } else { 0.0 },
            state_slope: if slides { self.b } else { 0.0 },
        }
    }

    /// `a (V ln(V/Vm) - V + Vm)`, computed as `a V (t + exp(-t) - 1)` with `t = ln(V/Vm)`.
    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let t = self.excess(slip_rate, state);
        if t > 0.0 {
            self.a * slip_rate * second_remainder(t)
        } else {
            0.0
        }
    }

    /// `b` above `Vm`, 0 below.
    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        if self.excess(slip_rate, state) > 0.0 {
            self.b
        } else {
            0.0
        }
    }

    /// In closed form by Wright's omega function: `drive/viscosity` up to `Vm`, and above, with
    /// `s = viscosity`, `V = (a/s) omega( drive/a + ln Vm + ln(s/a) )`.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        let Self {
            a,
            reference_velocity,
            ..
        } = *self;
        // drive/a + ln(Vm/V0): one difference, so that nearly balanced terms cancel exactly.
        let pull = (drive - self.coefficient_at_reference(state)) / a;
        let scaled = reference_velocity * (viscosity / a);
        let x = if scaled.is_normal() {
            pull + scaled.ln()
        } else {
            pull + reference_velocity.ln() + ln_ratio(viscosity, a)
        };
        // Far below 0 omega is exp(x), which underflows before the rate does.
        let rate = if x < -700.0 {
            reference_velocity * pull.exp()
        } else {
            a * omega(x) / viscosity
        };
        let free = drive / viscosity;
        let slowest = rate.min(free);
        // Whether it sticks is the coefficient's to say, to the last bit.
        if slowest < 1e-300 && drive <= self.coefficient(0.0, state) {
            0.0
        } else if free <= rate {
            free
        } else if rate < f64::MIN_POSITIVE {
            0.0
        } else {
            rate
        }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_positive("a", self.a)?;
        FrictionError::check_non_negative("b", self.b)?;
        FrictionError::check_non_negative("reference_friction", self.reference_friction)?;
        FrictionError::check_positive("reference_velocity", self.reference_velocity)?;
        FrictionError::check_positive("slip_distance", self.slip_distance)
    }
}

/// `ln(x/y)`, also where the quotient is beyond the normal numbers.
pub(crate) fn ln_ratio(x: f64, y: f64) -> f64 {
    let ratio = x / y;
    if ratio.is_normal() {
        ratio.ln()
    } else {
        x.ln() - y.ln()
    }
}

/// `t + exp(-t) - 1 = t^2/2 - t^3/6 + ...` for `t >= 0`, without the cancellation at 0.
fn second_remainder(t: f64) -> f64 {
    if t > 0.25 {
        return t + (-t).exp_m1();
    }
    // t^15/15! is below rounding of t^2/2.
    let nested = (3..15)
        .rev()
        .fold(1.0, |sum, n| 1.0 - t / f64::from(n) * sum);
    0.5 * t * t * nested
}
