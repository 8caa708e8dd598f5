//! The larger of slip weakening and a forced rupture.

use stickslip_state::Weakening;

use crate::FrictionError;

/// A forced rupture beside slip weakening, as in the TPV benchmarks of SCEC: friction follows the larger of
/// `f_1 = D/D_c` and `f_2 = (t - T)/t_0`,
///
/// ```text
/// mu = mu_s - (mu_s - mu_d) max(f_1, f_2),    0 <= f_1, f_2 <= 1
/// ```
///
/// It is no state law, but the state that [`LinearWeakening`](crate::LinearWeakening) reads at a time, beside the slip that
/// is the state of a contact: `Contact::with_forced_rupture` of the crate `stickslip` takes it. Where only the time
/// weakens, the state law [`TimeWeakening`](stickslip_state::TimeWeakening) does.
///
/// Source: R. A. Harris et al., *A suite of exercises for verifying dynamic earthquake rupture codes*, Seismol. Res.
/// Lett. 89 (2018); TPV24 of SCEC, of which these are numbers.
///
/// ```
/// # use stickslip_friction::{ForcedRupture, FrictionLaw, LinearWeakening};
/// # use stickslip_state::Weakening;
/// let law = LinearWeakening { static_friction: 0.18, dynamic_friction: 0.12 };
/// let forced = ForcedRupture { rupture_time: 1.0, duration: 0.5 };
/// let mu = |slip: f64, time| law.coefficient(0.0, forced.weakened(Weakening(slip / 0.3), time));
/// assert_eq!((mu(0.0, 1.0), mu(0.3, 0.0), mu(0.0, 1.5)), (0.18, 0.12, 0.12));
/// assert!((mu(0.15, 1.1) - 0.15).abs() < 1e-15 && (mu(0.15, 1.4) - 0.132).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("forced nucleation", "TPV"))]
pub struct ForcedRupture {
    /// `T` \[s\], the time at which friction begins to fall; infinite for a vertex that is not forced.
    pub rupture_time: f64,
    /// `t_0` \[s\], the time over which it falls, finite and positive.
    pub duration: f64,
}

impl ForcedRupture {
    /// `f_2 = (t - T)/t_0` at a time \[s\]: negative before the rupture, more than 1 behind it.
    #[must_use]
    pub fn weakening(&self, time: f64) -> Weakening {
        Weakening((time - self.rupture_time) / self.duration)
    }

    /// The larger of slip weakening and forced weakening at a time \[s\].
    #[must_use]
    pub fn weakened(&self, slip: Weakening, time: f64) -> Weakening {
        Weakening(slip.0.max(self.weakening(time).0))
    }

    /// The derivative of the value of [`weakened`](Self::weakened) in that of the state: 1 where slip decides, else 0.
    #[must_use]
    pub fn slip_slope(&self, slip: Weakening, time: f64) -> f64 {
        if slip.0 >= self.weakening(time).0 {
            1.0
        } else {
            0.0
        }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// A rupture time that is NaN, or a duration that is not finite and positive.
    pub fn validate(&self) -> Result<(), FrictionError> {
        let known = !self.rupture_time.is_nan();
        FrictionError::check("rupture_time", "a number", self.rupture_time, known)?;
        FrictionError::check_positive("duration", self.duration)
    }
}
