//! Weakening by slip that heals in time.

use crate::{SlipWeakening, StateError, StateLaw, Weakening};

/// Slip weakening with healing, `w' = V/D_c - w/t_h`: strength returns within the healing time `t_h` where slip stops.
///
/// ```text
/// at rest            w = w_o exp(-t/t_h)                    friction is static again
/// at a constant V    w -> V t_h/D_c                         below D_c/t_h it stays above dynamic friction
/// t_h -> infinity    w = D/D_c                              slip weakening
/// ```
///
/// Slip far beyond `D_c` heals later: at rest friction is dynamic for a time `t_h ln(D/D_c)` at most, and static up to a
/// share `e` of the drop `t_h ln(1/e)` later. During a slide of length `T` healing takes the share `T/t_h` of the
/// weakening: take a `t_h` beyond the duration of slip at a point, and below the time from one event to the next.
///
/// Healing at the very instant of arrest is no law of this kind: strength would be static at rest and dynamic at any slip
/// rate, and a step could both slip and stick.
///
/// Source: the state of J.-P. Ampuero, Y. Ben-Zion, *Cracks, pulses and macroscopic asymmetry of dynamic rupture on a
/// bimaterial interface with velocity-weakening friction*, Geophys. J. Int. 173 (2008), `theta' = V - theta V_c/D_c`, with
/// `w = theta/D_c` and `t_h = D_c/V_c`.
///
/// ```
/// # use stickslip_state::{SlipWeakening, StateLaw, Weakening};
/// let law = SlipWeakening { slip_distance: 0.4 }.healing(10.0);
/// let Weakening(at_rest) = law.advance_at_constant_rate(Weakening(1.0), 0.0, 20.0)?;
/// assert!((at_rest - (-2f64).exp()).abs() < 1e-15);
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("healing", "strength recovery", "restrengthening"))]
pub struct HealingSlipWeakening {
    /// `D_c` \[m\], the slip over which friction weakens, finite and positive.
    pub slip_distance: f64,
    /// `t_h` \[s\], the time over which it heals, finite and positive.
    pub healing_time: f64,
}

impl SlipWeakening {
    /// The law that heals within a time \[s\].
    #[must_use]
    pub fn healing(self, healing_time: f64) -> HealingSlipWeakening {
        HealingSlipWeakening {
            slip_distance: self.slip_distance,
            healing_time,
        }
    }
}

impl StateLaw for HealingSlipWeakening {
    type State = Weakening;

    fn evolution(&self, Weakening(w): Weakening, slip_rate: f64) -> f64 {
        slip_rate / self.slip_distance - w / self.healing_time
    }

    fn evolution_state_slope(&self, _state: Weakening, _slip_rate: f64) -> f64 {
        -self.healing_time.recip()
    }

    /// `(w + dt V/D_c)/(1 + dt/t_h)`.
    fn advance(&self, from: Weakening, slip_rate: f64, dt: f64) -> Result<Weakening, StateError> {
        StateError::check_step(slip_rate, dt)?;
        let grown = from.0 + dt * (slip_rate / self.slip_distance);
        Ok(Weakening(grown / (1.0 + dt / self.healing_time)))
    }

    /// `w exp(-dt/t_h) + V t_h/D_c (1 - exp(-dt/t_h))`.
    fn advance_exact(&self, from: Weakening, slip_rate: f64, dt: f64) -> Option<Weakening> {
        let decay = dt / self.healing_time;
        let steady = slip_rate * (self.healing_time / self.slip_distance);
        Some(Weakening(
            from.0 * (-decay).exp() - steady * (-decay).exp_m1(),
        ))
    }

    /// `dt/D_c/(1 + dt/t_h)`.
    fn advance_rate_slope(&self, _: Weakening, _: Weakening, _slip_rate: f64, dt: f64) -> f64 {
        dt / self.slip_distance / (1.0 + dt / self.healing_time)
    }

    /// `t_h/D_c (1 - exp(-dt/t_h))`.
    fn advance_at_constant_rate_rate_slope(
        &self,
        _: Weakening,
        _: Weakening,
        _slip_rate: f64,
        dt: f64,
    ) -> f64 {
        -(self.healing_time / self.slip_distance) * (-dt / self.healing_time).exp_m1()
    }

    /// Accepts a state that is finite and not negative.
    fn validate_state(&self, Weakening(w): Weakening) -> Result<(), StateError> {
        let legal = w.is_finite() && w >= 0.0;
        StateError::check("state w", "finite and non-negative", w, legal)
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)?;
        StateError::check_positive("healing_time", self.healing_time)
    }
}
