//! The state of friction that weakens.

use crate::StateVariable;

/// The degree of weakening `w`: friction is static up to 0, dynamic from 1 on, and changes between them.
///
/// It decreases by healing alone, with [`HealingSlipWeakening`](crate::HealingSlipWeakening).
/// [`SlipWeakening`](crate::SlipWeakening) is `w = D/D_c` of the accumulated slip,
/// [`TimeWeakening`](crate::TimeWeakening) the time since a forced rupture over its duration, negative before.
///
/// ```
/// use stickslip_state::{StateVariable, Weakening};
///
/// assert_eq!(Weakening(0.3).fraction(), 0.3);
/// assert_eq!((Weakening(-4.0).fraction(), Weakening(7.0).fraction()), (0.0, 1.0));
/// assert_eq!(Weakening(7.0).distance(Weakening(9.0)), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Weakening(pub f64);

impl Weakening {
    /// `min(max(w, 0), 1)`, the part of the weakening that has happened.
    #[must_use]
    pub fn fraction(self) -> f64 {
        self.0.clamp(0.0, 1.0)
    }
}

impl StateVariable for Weakening {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }

    /// The distance of the fractions, since friction reads these: slip beyond `D_c` changes nothing.
    fn distance(self, other: Self) -> f64 {
        (self.fraction() - other.fraction()).abs()
    }
}
