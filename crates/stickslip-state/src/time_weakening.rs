//! Weakening in time, a forced rupture.

use crate::{StateError, StateLaw, Weakening};

/// Time weakening, `w' = 1/t_0`: friction falls over the time `t_0` from a given rupture time on, whatever the slip.
///
/// A vertex that ruptures at the time `T` has `w = (t - T)/t_0`: start from [`before`](Self::before)`(T)` at `t = 0`.
/// It forces a rupture at a given speed, with the rupture times of the vertices, and a smooth onset, where an
/// overstress would start it by a jump.
///
/// Sources: D. J. Andrews, *Dynamic plane-strain shear rupture with a slip-weakening friction law calculated by a
/// boundary integral method*, Bull. Seismol. Soc. Am. 75 (1985); R. A. Harris et al., *A suite of exercises for verifying
/// dynamic earthquake rupture codes*, Seismol. Res. Lett. 89 (2018): benchmarks of SCEC such as TPV24, where friction
/// follows the larger of this and slip weakening, as by `Contact::with_forced_rupture` of the crate `stickslip`.
///
/// ```
/// # use stickslip_state::{StateLaw, TimeWeakening, Weakening};
/// let law = TimeWeakening { duration: 0.5 };
/// let start = law.before(2.0);
/// assert_eq!(law.advance(start, 0.0, 2.25)?, Weakening(0.5));
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("forced rupture", "nucleation", "forced nucleation"))]
pub struct TimeWeakening {
    /// `t_0` \[s\], the time over which friction weakens, finite and positive.
    pub duration: f64,
}

impl TimeWeakening {
    /// The state at a time \[s\] before the rupture, `-time/t_0`; negative times are after it.
    #[must_use]
    pub fn before(&self, time: f64) -> Weakening {
        Weakening(-time / self.duration)
    }
}

impl StateLaw for TimeWeakening {
    type State = Weakening;

    fn evolution(&self, _state: Weakening, _slip_rate: f64) -> f64 {
        self.duration.recip()
    }

    fn evolution_state_slope(&self, _state: Weakening, _slip_rate: f64) -> f64 {
        0.0
    }

    /// `w + dt/t_0`.
    fn advance(&self, from: Weakening, slip_rate: f64, dt: f64) -> Result<Weakening, StateError> {
        StateError::check_step(slip_rate, dt)?;
        Ok(Weakening(from.0 + dt / self.duration))
    }

    /// `w + dt/t_0`.
    fn advance_exact(&self, from: Weakening, _slip_rate: f64, dt: f64) -> Option<Weakening> {
        Some(Weakening(from.0 + dt / self.duration))
    }

    /// 0.
    fn advance_rate_slope(&self, _: Weakening, _: Weakening, _slip_rate: f64, _dt: f64) -> f64 {
        0.0
    }

    /// 0.
    fn advance_at_constant_rate_rate_slope(
        &self,
        _: Weakening,
        _: Weakening,
        _slip_rate: f64,
        _dt: f64,
    ) -> f64 {
        0.0
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("duration", self.duration)
    }
}
