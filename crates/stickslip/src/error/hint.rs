//! What to try after a failed step: the last part of its message.

use super::{ErrorOf, Limit, LocalError, StepError};

pub(super) const SHORTER: &str = "reduce dt";
pub(super) const MINIMISES: &str = "`check_nonsmooth_solver` tells whether it minimises";
pub(super) const LOAD: &str =
    "check functions of with_load_history and with_scaled_load, and plate rates";
pub(super) const OPENING: &str = "Contact::allow_opening lets it open, unless its normal motion is prescribed or contacts meet there that do not all open along one normal";
pub(super) const PRESSURE: &str =
    "Contact::allow_opening or Contact::with_least_normal_stress takes it";
pub(super) const LESS_FRICTION: &str =
    "reduce the coefficient of friction, or dt of a body with inertia";
pub(super) const ADAPTIVE: &str = "reduce dt or take adaptive steps";
pub(super) const PLAIN: &str = "use Sdirk2, or ErrorControl without it";
pub(super) const MONOLITHIC: &str = "reduce dt or use `Monolithic`";
pub(super) const INERTIA: &str = "below the critical stiffness no step size has a unique solution: add mass or radiation damping";
pub(super) const IMPLICIT: &str = "use an implicit one";

impl StepError {
    /// What to try, in words of this library: the last part of the message. `None` if the message alone says it, or the
    /// error is that of a solver or a law.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Data { what: "load", .. } => Some(LOAD),
            Self::Tension { .. } => Some(OPENING),
            Self::PorePressure { .. } => Some(PRESSURE),
            Self::NotUnique { shorter: true, .. } => Some(SHORTER),
            Self::Penetration { .. } => Some(MINIMISES),
            Self::NotContracting { .. } => Some(LESS_FRICTION),
            Self::Stage { .. } => Some(ADAPTIVE),
            Self::StepTooSmall {
                resisted: false, ..
            }
            | Self::NotUnique { shorter: false, .. } => Some(INERTIA),
            Self::StepTooSmall { error, .. } => Some(error.hint()),
            Self::TooManySteps { limit, .. } => limit.hint(),
            Self::Extrapolation { .. } => Some(PLAIN),
            Self::NotCoupled { .. } => Some(MONOLITHIC),
            _ => None,
        }
    }
}

impl Limit {
    /// What to try for longer steps, the last part of the message; `None` for a limit that the plan set.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Error(error) => Some(error.hint()),
            Self::LargestStep(_) => None,
            Self::Stability(_) => Some(IMPLICIT),
        }
    }
}

impl LocalError {
    /// What to try for longer steps.
    pub fn hint(&self) -> &'static str {
        match self.largest_of() {
            ErrorOf::SlipRate => "raise the tolerance or ErrorControl::slip_rate_floor",
            ErrorOf::State => "raise the tolerance",
            ErrorOf::Slip | ErrorOf::Displacement => {
                "raise the tolerance or ErrorControl::slip_floor"
            }
            ErrorOf::Motion => {
                "raise the tolerance, or lower ErrorControl::motion with a scheme that damps waves"
            }
        }
    }
}
