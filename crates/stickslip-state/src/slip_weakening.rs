//! Weakening by accumulated slip.

use crate::{StateError, StateLaw, Weakening};

/// Slip weakening, `w' = V/D_c`: the state is the accumulated slip `D` over `D_c`.
///
/// A step is exact for slip that grows evenly in it: the state after backward Euler is `w + dt V/D_c` with the slip of
/// that scheme, and of any other scheme that of its mean rate. Slip counts by its path: it never heals, unless
/// [`healing`](Self::healing) lets it.
///
/// Sources: Y. Ida, *Cohesive force across the tip of a longitudinal-shear crack and Griffith's specific surface
/// energy*, J. Geophys. Res. 77 (1972); D. J. Andrews, *Rupture propagation with finite stress in antiplane strain*, J.
/// Geophys. Res. 81 (1976).
///
/// ```
/// # use stickslip_state::{SlipWeakening, StateLaw, Weakening};
/// let law = SlipWeakening { slip_distance: 0.4 };
/// // 0.1 m/s over 1 s.
/// assert_eq!(law.advance(Weakening(0.5), 0.1, 1.0)?, Weakening(0.75));
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("linear slip weakening", "LSW", "accumulated slip", "slip path"))]
pub struct SlipWeakening {
    /// `D_c` \[m\], the slip over which friction weakens, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
}

impl StateLaw for SlipWeakening {
    type State = Weakening;

    fn evolution(&self, _state: Weakening, slip_rate: f64) -> f64 {
        slip_rate / self.slip_distance
    }

    fn evolution_state_slope(&self, _state: Weakening, _slip_rate: f64) -> f64 {
        0.0
    }

    /// `w + dt V/D_c`.
    fn advance(&self, from: Weakening, slip_rate: f64, dt: f64) -> Result<Weakening, StateError> {
        StateError::check_step(slip_rate, dt)?;
        Ok(Weakening(from.0 + dt * (slip_rate / self.slip_distance)))
    }

    /// `w + dt V/D_c`.
    fn advance_exact(&self, from: Weakening, slip_rate: f64, dt: f64) -> Option<Weakening> {
        Some(Weakening(from.0 + dt * (slip_rate / self.slip_distance)))
    }

    /// `dt/D_c`.
    fn advance_rate_slope(&self, _: Weakening, _: Weakening, _slip_rate: f64, dt: f64) -> f64 {
        dt / self.slip_distance
    }

    /// `dt/D_c`.
    fn advance_at_constant_rate_rate_slope(
        &self,
        _: Weakening,
        _: Weakening,
        _slip_rate: f64,
        dt: f64,
    ) -> f64 {
        dt / self.slip_distance
    }

    /// Accepts accumulated slip that is finite and not negative.
    fn validate_state(&self, Weakening(w): Weakening) -> Result<(), StateError> {
        let legal = w.is_finite() && w >= 0.0;
        StateError::check("state w = D/D_c", "finite and non-negative", w, legal)
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}
