//! State laws in logarithms: the right-hand sides of the model and their derivatives.

use std::fmt;

use stickslip_friction::DieterichRuina;
use stickslip_state::{LogTheta, StateError, StateLaw, StateVariable, increasing_root};

/// A boxed state law.
pub type BoxedLaw = Box<dyn StateLaw<State = LogTheta>>;

/// The state law of one state variable.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub enum Evolution<'a> {
    /// Dieterich's law, `theta' = 1 - V theta/L`.
    #[doc(alias("Dieterich", "slowness law"))]
    Aging,
    /// Ruina's law, `theta' = -(V theta/L) ln(V theta/L)`.
    #[doc(alias = "Ruina")]
    Slip,
    /// A state law as a function of `a`, `b`, `L` and `V0`. Its fit takes derivatives by differences.
    Custom(&'a (dyn Fn(&DieterichRuina) -> BoxedLaw + Sync)),
}

impl fmt::Debug for Evolution<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Evolution<'_> {
    /// Its name: `aging`, `slip` or `custom`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Aging => "aging",
            Self::Slip => "slip",
            Self::Custom(_) => "custom",
        }
    }
}

/// A state law with its parameters, in `phi = ln(V0 theta/L)` and `w = ln(V/V0)`: `phi' = (V0/L) G(phi, w)`.
pub(crate) enum Law {
    Aging,
    Slip,
    /// The law, `V0` and `L`.
    Custom(BoxedLaw, f64, f64),
}

/// `G` and its first derivatives.
#[derive(Clone, Copy, Default)]
pub(crate) struct Rate {
    pub(crate) value: f64,
    pub(crate) by_w: f64,
    pub(crate) by_phi: f64,
}

/// The second derivatives of `G`.
#[derive(Clone, Copy, Default)]
pub(crate) struct Curvature {
    pub(crate) by_w_w: f64,
    pub(crate) by_w_phi: f64,
    pub(crate) by_phi_phi: f64,
}

/// The cube root of the machine precision, the best step of a central difference.
const DIFFERENCE: f64 = 6e-6;

impl Law {
    pub(crate) fn new(evolution: Evolution<'_>, friction: &DieterichRuina) -> Self {
        match evolution {
            Evolution::Aging => Self::Aging,
            Evolution::Slip => Self::Slip,
            Evolution::Custom(law) => Self::Custom(
                law(friction),
                friction.reference_velocity,
                friction.slip_distance,
            ),
        }
    }

    /// `G` at `phi` and `w`, with `faster = exp(w)`.
    #[inline]
    pub(crate) fn rate(&self, phi: f64, w: f64, faster: f64) -> Rate {
        match self {
            Self::Aging => {
                let younger = (-phi).exp();
                Rate {
                    value: younger - faster,
                    by_w: -faster,
                    by_phi: -younger,
                }
            }
            Self::Slip => Rate {
                value: -faster * (w + phi),
                by_w: -faster * (w + phi + 1.0),
                by_phi: -faster,
            },
            Self::Custom(law, v0, slip_distance) => {
                let state = LogTheta(phi + (slip_distance / v0).ln());
                let unit = slip_distance / v0;
                let at = |w: f64| unit * law.evolution(state, v0 * w.exp());
                Rate {
                    value: unit * law.evolution(state, v0 * faster),
                    by_w: (at(w + DIFFERENCE) - at(w - DIFFERENCE)) / (2.0 * DIFFERENCE),
                    by_phi: unit * law.evolution_state_slope(state, v0 * faster),
                }
            }
        }
    }

    /// The second derivatives; of a custom law, whose sensitivities are differences, there are none.
    #[inline]
    pub(crate) fn curvature(&self, phi: f64, w: f64, faster: f64) -> Curvature {
        match self {
            Self::Aging => Curvature {
                by_w_w: -faster,
                by_w_phi: 0.0,
                by_phi_phi: (-phi).exp(),
            },
            Self::Slip => Curvature {
                by_w_w: -faster * (w + phi + 2.0),
                by_w_phi: -faster,
                by_phi_phi: 0.0,
            },
            Self::Custom(..) => Curvature::default(),
        }
    }

    /// The steady `phi` at `w`.
    pub(crate) fn steady(&self, w: f64) -> Result<f64, StateError> {
        let Self::Custom(law, v0, slip_distance) = self else {
            return Ok(-w);
        };
        law.validate()?;
        let slip_rate = v0 * w.exp();
        let root = increasing_root((slip_distance / slip_rate).ln(), |value| {
            let state = LogTheta::from_value(value);
            (
                -law.evolution(state, slip_rate),
                -law.evolution_state_slope(state, slip_rate),
            )
        })?;
        Ok(root + (v0 / slip_distance).ln())
    }
}
