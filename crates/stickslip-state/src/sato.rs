//! The composite law of Sato, Nakatani and Ando.

use crate::{LogTheta, StateError, StateLaw};

/// The composite law of Sato, Nakatani and Ando, `theta' = exp(-W/beta) - W ln W` with `W = V theta/L`: aging far below steady
/// state, the slip law elsewhere.
///
/// As an equation for `alpha = ln theta` it is `alpha' = exp(-alpha - W/beta) - (V/L) (alpha + ln(V/L))`. Contacts age where
/// `W` is below the threshold `beta`, whatever the slip rate; that of [`KatoTullis`](crate::KatoTullis) is a slip rate. The
/// steady state is `L/V` to `exp(-1/beta)`, 4e-44 for `beta = 0.01`. There is no closed form.
///
/// Source: D. S. K. Sato, M. Nakatani, R. Ando, *Reconciling aging and slip state evolutions from laboratory-derived canons
/// of rate-and-state friction*, arXiv:2402.04478 (2024), where experiments ask for a `beta` of 0.01 or less.
///
/// ```
/// # use stickslip_state::{LogTheta, Sato, StateLaw};
/// let law = Sato::new(1e-5);
/// assert_eq!(law.threshold, 0.01);
/// let LogTheta(aged) = law.advance(LogTheta(0.0), 0.0, 1e-3)?;
/// assert!((aged - 1e-3).abs() < 1e-6); // theta = 1 s + 1 ms
/// let LogTheta(steady) = law.advance_at_constant_rate(LogTheta(0.0), 1e-3, 1e3)?;
/// assert!((steady - 1e-2f64.ln()).abs() < 1e-8); // theta = L/V
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("composite law", "SatoNakataniAndo"))]
pub struct Sato {
    /// `L` \[m\], the characteristic slip distance, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
    /// `beta`, the `V theta/L` up to which contacts age, finite and positive.
    pub threshold: f64,
}

impl Sato {
    /// The published threshold.
    pub const THRESHOLD: f64 = 0.01;

    /// The law with the published threshold, 0.01.
    #[must_use]
    pub fn new(slip_distance: f64) -> Self {
        Self {
            slip_distance,
            threshold: Self::THRESHOLD,
        }
    }

    /// `ln(V/L)`, bounded below; the quotient of subnormal numbers would have too few digits.
    fn ln_rate(&self, slip_rate: f64) -> f64 {
        slip_rate.max(f64::MIN_POSITIVE).ln() - self.slip_distance.ln()
    }

    /// `W/beta`.
    fn over_threshold(&self, alpha: f64, slip_rate: f64) -> f64 {
        if slip_rate > 0.0 {
            (alpha + self.ln_rate(slip_rate)).exp() / self.threshold
        } else {
            0.0
        }
    }

    /// `exp(-alpha - w)` and its product with `1 + w`, for `w = W/beta`.
    fn aging(alpha: f64, w: f64) -> (f64, f64) {
        let aging = (-alpha - w).exp();
        // Where `w` is infinite nothing ages.
        (aging, if aging > 0.0 { aging * (1.0 + w) } else { 0.0 })
    }
}

impl StateLaw for Sato {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / self.slip_distance;
        let slipping = if rate > 0.0 {
            rate * (alpha + self.ln_rate(slip_rate))
        } else {
            0.0
        };
        let (aging, _) = Self::aging(alpha, self.over_threshold(alpha, slip_rate));
        aging - slipping
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let (_, slope) = Self::aging(alpha, self.over_threshold(alpha, slip_rate));
        -slope - slip_rate / self.slip_distance
    }

    /// `-(dt/L) (1 + to + ln(V/L) + exp(-W/beta)/beta) / (1 + c + dt exp(-to - W/beta) (1 + W/beta))`, with `c = dt V/L` and
    /// `W` at `to`; towards rest it grows like `-ln V` and stays at its value for the smallest normal `V`.
    fn advance_rate_slope(
        &self,
        _from: LogTheta,
        LogTheta(to): LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let w = self.over_threshold(to, slip_rate);
        let (_, slope) = Self::aging(to, w);
        let drive = 1.0 + to + self.ln_rate(slip_rate) + (-w).exp() / self.threshold;
        let resistance = dt.recip() + slip_rate / self.slip_distance + slope;
        -drive / self.slip_distance / resistance
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)?;
        StateError::check_positive("threshold", self.threshold)
    }
}
