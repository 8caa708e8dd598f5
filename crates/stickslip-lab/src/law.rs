//! State laws in logarithms: the right-hand sides of the model and their derivatives.

use stickslip_friction::DieterichRuina;
use stickslip_state::wright::omega;
use stickslip_state::{LogTheta, StateError, StateVariable, increasing_root};

use crate::evolution::{BoxedLaw, Evolution};
use crate::parameters::StateParameters;

/// A state law with its parameters, in `phi = ln(V0 theta/L)` and `w = ln(V/V0)`: `phi' = (V0/L) G(phi, w)`.
pub(crate) enum Law {
    /// Also that of Nagata, whose stress rate is a term of the system.
    Aging,
    Slip,
    /// With `phi = ln(V0 theta/2L)`.
    PerrinRiceZheng,
    /// `V0/Vc`.
    KatoTullis(f64),
    /// The law, `V0` and `L`.
    Custom(BoxedLaw, f64, f64),
}

/// `G` and its first derivatives, that in the logarithm of a parameter of the law with them.
#[derive(Clone, Copy, Default)]
pub(crate) struct Rate {
    pub(crate) value: f64,
    pub(crate) by_w: f64,
    pub(crate) by_phi: f64,
    pub(crate) by_parameter: f64,
}

/// The second derivatives of `G`.
#[derive(Clone, Copy, Default)]
pub(crate) struct Curvature {
    pub(crate) by_w_w: f64,
    pub(crate) by_w_phi: f64,
    pub(crate) by_phi_phi: f64,
    pub(crate) by_parameter_w: f64,
    pub(crate) by_parameter_phi: f64,
}

/// The cube root of the machine precision, the best step of a central difference.
const DIFFERENCE: f64 = 6e-6;

impl Law {
    pub(crate) fn new(
        evolution: Evolution<'_>,
        friction: &DieterichRuina,
        state: &StateParameters,
    ) -> Self {
        let v0 = friction.reference_velocity;
        match evolution {
            Evolution::Aging | Evolution::Nagata => Self::Aging,
            Evolution::Slip => Self::Slip,
            Evolution::PerrinRiceZheng => Self::PerrinRiceZheng,
            Evolution::KatoTullis => Self::KatoTullis(v0 / state.aging_velocity),
            Evolution::Custom(law) => Self::Custom(law(friction), v0, friction.slip_distance),
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
                    by_parameter: 0.0,
                }
            }
            Self::Slip => Rate {
                value: -faster * (w + phi),
                by_w: -faster * (w + phi + 1.0),
                by_phi: -faster,
                by_parameter: 0.0,
            },
            // (1/x - V^2 x)/2 with x = exp(phi).
            Self::PerrinRiceZheng => {
                let (younger, worn) = ((-phi).exp(), faster * faster * phi.exp());
                Rate {
                    value: 0.5 * (younger - worn),
                    by_w: -worn,
                    by_phi: -0.5 * (younger + worn),
                    by_parameter: 0.0,
                }
            }
            Self::KatoTullis(ratio) => {
                let fast = ratio * faster;
                let younger = (-phi - fast).exp();
                Rate {
                    value: younger - faster * (w + phi),
                    by_w: -fast * younger - faster * (w + phi + 1.0),
                    by_phi: -younger - faster,
                    by_parameter: fast * younger,
                }
            }
            Self::Custom(law, v0, slip_distance) => {
                let state = LogTheta(phi + (slip_distance / v0).ln());
                let unit = slip_distance / v0;
                let at = |w: f64| unit * law.evolution(state, v0 * w.exp());
                Rate {
                    value: unit * law.evolution(state, v0 * faster),
                    by_w: (at(w + DIFFERENCE) - at(w - DIFFERENCE)) / (2.0 * DIFFERENCE),
                    by_phi: unit * law.evolution_state_slope(state, v0 * faster),
                    by_parameter: 0.0,
                }
            }
        }
    }

    /// The second derivatives. A custom law, whose sensitivities are differences, has none.
    #[inline]
    pub(crate) fn curvature(&self, phi: f64, w: f64, faster: f64) -> Curvature {
        let none = Curvature::default();
        match self {
            Self::Aging => Curvature {
                by_w_w: -faster,
                by_phi_phi: (-phi).exp(),
                ..none
            },
            Self::Slip => Curvature {
                by_w_w: -faster * (w + phi + 2.0),
                by_w_phi: -faster,
                ..none
            },
            Self::PerrinRiceZheng => {
                let (younger, worn) = ((-phi).exp(), faster * faster * phi.exp());
                Curvature {
                    by_w_w: -2.0 * worn,
                    by_w_phi: -worn,
                    by_phi_phi: 0.5 * (younger - worn),
                    ..none
                }
            }
            Self::KatoTullis(ratio) => {
                let fast = ratio * faster;
                let younger = (-phi - fast).exp();
                Curvature {
                    by_w_w: fast * (fast - 1.0) * younger - faster * (w + phi + 2.0),
                    by_w_phi: fast * younger - faster,
                    by_phi_phi: younger,
                    by_parameter_w: fast * (1.0 - fast) * younger,
                    by_parameter_phi: -fast * younger,
                }
            }
            Self::Custom(..) => none,
        }
    }

    /// The steady `phi` at `w`, and its derivative in the logarithm of a parameter of the law.
    pub(crate) fn steady(&self, w: f64) -> Result<(f64, f64), StateError> {
        let (law, v0, slip_distance) = match self {
            // u exp(u) = exp(-V/Vc) with u = w + phi.
            Self::KatoTullis(ratio) => {
                let fast = ratio * w.exp();
                let u = omega(-fast);
                return Ok((u - w, u * fast / (1.0 + u)));
            }
            Self::Custom(law, v0, slip_distance) => (law, v0, slip_distance),
            _ => return Ok((-w, 0.0)),
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
        Ok((root + (v0 / slip_distance).ln(), 0.0))
    }
}
