//! Rate- and state-dependent friction without a cut-off.

mod balance;
#[cfg(test)]
mod double;
mod in_psi;
mod many_nodes;

use stickslip_state::{Dieterich, LogTheta, Ruina};

use crate::{
    DieterichRuina, FrictionError, FrictionLaw, Response, SlipRates, dieterich_ruina::ln_ratio,
};
use many_nodes::ManyNodes;

pub use in_psi::RegularizedInPsi;

/// The `mu/a` from which on `asinh` and the logarithm agree to rounding.
const LOGARITHMIC: f64 = 20.0;

/// Largest number of Newton steps for the local problem; some 5 are typical.
const STEPS: usize = 100;

/// Dieterich's and Ruina's law, regularised at rest: `mu = a asinh(V / (2 Vm))`, with
///
/// ```text
/// Vm = V0 exp( -(mu0 + b (alpha + ln(V0/L))) / a )
/// ```
///
/// as in the cut-off law [`DieterichRuina`]. The two differ by at most `a asinh(1/2)`, at `V = Vm`, and by less than
/// `a (Vm/V)^2` above. The regularised law is smooth, and viscous with `mu = a V / (2 Vm)` below.
///
/// Only the logarithm of `Vm` is ever formed. If `Vm` is below [`f64::MIN_POSITIVE`], the law has, in floating point, a
/// kink at rest: rates below `MIN_POSITIVE` count as that rate, and a contact with a smaller creep rate sticks.
///
/// ```
/// # use stickslip_friction::{FrictionLaw, RegularizedDieterichRuina};
/// # use stickslip_state::{Dieterich, LogTheta, Ruina};
/// let law = RegularizedDieterichRuina {
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
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("RSF", "rate-and-state", "rate and state friction"))]
pub struct RegularizedDieterichRuina {
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

impl From<DieterichRuina> for RegularizedDieterichRuina {
    /// The law with these parameters.
    fn from(law: DieterichRuina) -> Self {
        Self {
            a: law.a,
            b: law.b,
            reference_friction: law.reference_friction,
            reference_velocity: law.reference_velocity,
            slip_distance: law.slip_distance,
        }
    }
}

impl RegularizedDieterichRuina {
    /// `ln(Vm / 1 m/s)`, the logarithm of the rate below which friction is viscous.
    #[must_use]
    pub fn ln_cutoff_rate(&self, state: LogTheta) -> f64 {
        self.cut_off().ln_cutoff_rate(state)
    }

    /// Dieterich's aging law with the characteristic slip distance of this friction.
    ///
    /// ```
    /// # use stickslip_friction::RegularizedDieterichRuina;
    /// let law = RegularizedDieterichRuina {
    ///     a: 0.010,
    ///     b: 0.015,
    ///     reference_friction: 0.6,
    ///     reference_velocity: 1e-6,
    ///     slip_distance: 8e-3,
    /// };
    /// assert_eq!(law.aging().slip_distance, law.slip().slip_distance);
    /// ```
    #[must_use]
    pub fn aging(&self) -> Dieterich {
        self.cut_off().aging()
    }

    /// Ruina's slip law with the characteristic slip distance of this friction.
    #[must_use]
    pub fn slip(&self) -> Ruina {
        self.cut_off().slip()
    }

    fn cut_off(&self) -> DieterichRuina {
        let Self {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        } = *self;
        DieterichRuina {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        }
    }

    /// Whether `Vm` is too small to be represented.
    fn sticks(&self, state: LogTheta) -> bool {
        self.ln_cutoff_rate(state) < f64::MIN_POSITIVE.ln()
    }

    /// `t = ln(V/Vm)`, minus infinity at rest.
    fn excess(&self, slip_rate: f64, state: LogTheta) -> f64 {
        if slip_rate < f64::MIN_POSITIVE && !self.sticks(state) {
            ln_ratio(slip_rate, self.reference_velocity)
                + self.cut_off().coefficient_at_reference(state) / self.a
        } else {
            self.cut_off().excess(slip_rate, state)
        }
    }

    /// The `x > 0` with `x + k sinh(x) = pull`, where `k = exp(ln_k)`.
    ///
    /// The sum is convex: Newton's method never falls below the root again after its first step. `start` is close below
    /// or bounded by `pull/(1 + k)` above.
    fn balance(ln_k: f64, pull: f64, logarithmic: f64) -> f64 {
        let k = ln_k.exp();
        let viscous = pull / (1.0 + k);
        let mut x = if viscous <= 2.0 { viscous } else { logarithmic };
        for _ in 0..STEPS {
            let next = x - (x + k * x.sinh() - pull) / (1.0 + k * x.cosh());
            let step = (next - x).abs();
            x = next;
            if step <= 2.0 * f64::EPSILON * x {
                break;
            }
        }
        x
    }
}

impl FrictionLaw for RegularizedDieterichRuina {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.a * asinh_half_exp(self.excess(slip_rate, state))
    }

    /// `a / sqrt(V^2 + 4 Vm^2)`; infinite where that overflows.
    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.response(slip_rate, state).rate_slope
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: LogTheta) -> (f64, f64) {
        let response = self.response(slip_rate, state);
        (response.coefficient, response.rate_slope)
    }

    fn response(&self, slip_rate: f64, state: LogTheta) -> Response {
        let t = self.excess(slip_rate, state);
        let x = asinh_half_exp(t);
        Response {
            coefficient: self.a * x,
            rate_slope: if t > 0.0 {
                self.a / slip_rate / (1.0 + 4.0 * (-2.0 * t).exp()).sqrt()
            } else {
                let at_rest = 0.5 * self.a * (-self.ln_cutoff_rate(state)).exp();
                at_rest / (1.0 + 0.25 * (2.0 * t).exp()).sqrt()
            },
            state_slope: self.b * x.tanh(),
        }
    }

    /// `a (V asinh(V/(2 Vm)) - sqrt(V^2 + 4 Vm^2) + 2 Vm)`, computed as `a V (x - tanh(x/2))` with
    /// `x = mu/a`.
    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let x = asinh_half_exp(self.excess(slip_rate, state));
        self.a * slip_rate * (x - (0.5 * x).tanh())
    }

    /// `b tanh(mu/a)`.
    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.response(slip_rate, state).state_slope
    }

    /// Far above `Vm` the solution of the cut-off law; else Newton's method for `x = mu/a`, which solves
    /// `x + k sinh(x) = drive/a` with `k = 2 Vm viscosity/a`.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        let free = drive / viscosity;
        // Of larger friction, this law is slower than the cut-off one.
        let faster = self.cut_off().slip_rate(viscosity, drive, state);
        // Far above Vm ln(V/Vm) is what friction takes of the drive, over a.
        let resolved = faster >= f64::MIN_POSITIVE;
        if resolved && (drive - viscosity * faster) / self.a >= LOGARITHMIC {
            return faster;
        }
        let sticks = self.sticks(state);
        let logarithmic = self.excess(faster, state);
        if logarithmic >= LOGARITHMIC || faster == 0.0 && sticks {
            return faster;
        }
        let pull = drive / self.a;
        let ln_cutoff = self.ln_cutoff_rate(state);
        let ln_k = ln_cutoff + ln_ratio(viscosity, 0.5 * self.a);
        if pull == 0.0 || ln_k > 700.0 || pull == f64::INFINITY {
            return free;
        }
        let x = Self::balance(ln_k, pull, logarithmic);
        // The speed from the term that answers less to a rounding of x.
        let rate = if ln_k.exp() * x.cosh() > 1.0 {
            (drive - self.a * x) / viscosity
        } else if ln_cutoff.abs() > 690.0 {
            // Vm is next to the end of the normal numbers, the rate need not be.
            (ln_cutoff + x).exp() * -(-2.0 * x).exp_m1()
        } else {
            ln_cutoff.exp() * (2.0 * x.sinh())
        };
        // Whether it sticks is the coefficient's to say, to the last bit.
        if sticks && (rate < f64::MIN_POSITIVE || drive <= self.coefficient(0.0, state)) {
            0.0
        } else {
            rate.min(free)
        }
    }

    fn slip_rates(laws: &[Self]) -> Option<Box<dyn SlipRates<LogTheta>>> {
        Some(Box::new(ManyNodes::new(laws)))
    }

    fn validate(&self) -> Result<(), FrictionError> {
        self.cut_off().validate()
    }
}

/// `asinh(exp(t)/2)`, which is `t` to rounding from 20 on.
fn asinh_half_exp(t: f64) -> f64 {
    if t > 0.0 {
        let q = (-2.0 * t).exp();
        t + (2.0 * q / (1.0 + (1.0 + 4.0 * q).sqrt())).ln_1p()
    } else {
        (0.5 * t.exp()).asinh()
    }
}
