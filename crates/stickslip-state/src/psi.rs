//! The state in units of friction.

use crate::StateVariable;

/// The size of `a` and `b`, by which friction responds to a unit of a logarithm.
const SCALE: f64 = 0.01;

/// The state in units of friction, any finite number: the friction that reads it is `a asinh( V/(2 V0) exp(psi/a) )`.
///
/// By the parameters of Dieterich and Ruina it is `psi = mu0 + b ln(V0 theta/L)`, see [`InPsi`](crate::InPsi). Strong rate
/// weakening, [`StrongWeakening`](crate::StrongWeakening), is stated in it.
///
/// ```
/// use stickslip_state::{Psi, StateVariable};
///
/// // 40 MPa of shear stress at 120 MPa, at 1e-16 m/s; a = 0.01, V0 = 1e-6 m/s.
/// let Psi(psi) = Psi::of_friction(40.0 / 120.0, 1e-16, (0.01, 1e-6));
/// assert!((psi - 0.563_591_842_633).abs() < 1e-12);
/// // A change by b counts as one of ln(theta) by 1.
/// assert!((Psi(0.60).distance(Psi(0.61)) - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Psi(pub f64);

impl Psi {
    /// The state in which friction is `coefficient > 0` at the slip rate `V > 0` \[m/s\], with `a > 0` and `V0 > 0` \[m/s\]:
    ///
    /// ```text
    /// psi = a ln( (2 V0/V) sinh(mu/a) ) = mu + a [ ln(V0/V) + ln(1 - exp(-2 mu/a)) ]
    /// ```
    ///
    /// Infinite or NaN beyond these ranges, which contacts refuse as a state.
    #[must_use]
    pub fn of_friction(
        coefficient: f64,
        slip_rate: f64,
        (a, reference_velocity): (f64, f64),
    ) -> Self {
        // The hyperbolic sine itself overflows for small `a`.
        let slower = reference_velocity.ln() - slip_rate.ln();
        let below = -(-2.0 * coefficient / a).exp_m1();
        Self(coefficient + a * (slower + below.ln()))
    }
}

impl StateVariable for Psi {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }

    /// The modulus of the difference over 0.01, the size of `a` and `b`: errors weigh as those of `ln theta`.
    fn distance(self, other: Self) -> f64 {
        (self.0 - other.0).abs() / SCALE
    }
}
