//! The normal stress of a contact: prescribed, or from the deformation of the body.

use stickslip_friction::Nodal;

use super::relaxation::Relaxation;

/// The normal stress of a contact \[Pa\], positive in compression.
///
/// A number, or a list of them, is a prescribed normal stress. [`from_body`](Self::from_body) is one that follows the
/// deformation: the reaction `lambda` of the fixed normal velocity over the area `w` of a vertex (of all contacts that meet there on a plane) adds to what is given,
///
/// ```text
/// sigma_n = sigma_0 + lambda/w
/// ```
///
/// Friction with such a normal stress has no energy to minimise. A step freezes the normal stresses, solves for rates
/// and states, takes the reactions, and repeats until they agree. With `B` the operator of the step, condensed to the
/// fault, one vertex contracts by
///
/// ```text
/// q = abs(mu B_nt) / (B_tt + w sigma_n dmu/dV)
/// ```
///
/// [`StepReport::contraction`](crate::StepReport::contraction) shows it. Where it is 1 or more the step is refused:
/// there slip can remove the pressure that resists it faster than the body stiffens.
/// [`with_relaxation_time`](Self::with_relaxation_time) lets friction follow with a delay.
///
/// ```
/// use stickslip::NormalStress;
///
/// // The lithostatic pressure that the body's own deformation does not hold, and changes of it.
/// let fault = NormalStress::from_body(50e6);
/// // The pressure at the start, in which the deformation of the start is included.
/// let loaded = NormalStress::from_body(50e6).at_start();
/// # let _ = (fault, loaded);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct NormalStress {
    pub(crate) value: Nodal<f64>,
    pub(crate) source: Source,
    pub(crate) relaxation: Relaxation,
}

/// Where the normal stress comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Source {
    /// Prescribed.
    Given,
    /// The given one and the reaction.
    Body,
    /// The given one and the change of the reaction since the start.
    Change,
}

impl NormalStress {
    /// The normal stress of the deformation beside a given one \[Pa\] (uniform or per vertex), such as the part of a
    /// pre-stress that the displacement of the body does not hold. Tension is refused or opens the contact, see
    /// [`Contact::allow_opening`](crate::Contact::allow_opening).
    pub fn from_body(beside: impl Into<Nodal<f64>>) -> Self {
        Self {
            value: beside.into(),
            source: Source::Body,
            relaxation: Relaxation::default(),
        }
    }

    /// Makes the given normal stress that at the start: the reaction at the start, which it includes, does not add. A
    /// prescribed normal stress, without a reaction, stays as it is.
    #[must_use]
    pub fn at_start(mut self) -> Self {
        if self.source == Source::Body {
            self.source = Source::Change;
        }
        self
    }
}

impl From<f64> for NormalStress {
    fn from(value: f64) -> Self {
        Nodal::from(value).into()
    }
}

impl From<Vec<f64>> for NormalStress {
    fn from(values: Vec<f64>) -> Self {
        Nodal::from(values).into()
    }
}

impl From<Nodal<f64>> for NormalStress {
    fn from(value: Nodal<f64>) -> Self {
        Self {
            value,
            source: Source::Given,
            relaxation: Relaxation::default(),
        }
    }
}
