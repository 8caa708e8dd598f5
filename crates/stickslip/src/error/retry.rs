//! Whether a step that failed can succeed in another way.

use stickslip_solvers::SolveError;

use super::StepError;
use super::step::BODY_STRESS;

impl StepError {
    /// Whether a shorter step can succeed.
    pub(crate) fn may_pass(&self) -> bool {
        !matches!(
            self,
            Self::NotUnique { shorter: false, .. }
                | Self::StepSize { .. }
                | Self::AmidCycle { .. }
                | Self::Tension { .. }
                | Self::PorePressure { by_slip: false, .. }
        )
    }

    /// Whether a law without a finite value can be the cause: an iteration that does not end, or ends in one.
    pub(crate) fn may_be_of_a_law(&self) -> bool {
        match self {
            Self::Solver(cause) => matches!(
                cause,
                SolveError::NotFinite { .. }
                    | SolveError::NotConverged { .. }
                    | SolveError::NotConvex { .. }
                    | SolveError::IndefiniteDirection { .. }
            ),
            Self::NotCoupled { change, .. } => !change.is_finite(),
            Self::NotContracting { contraction, .. } => !contraction.is_finite(),
            Self::Data { what, .. } => [BODY_STRESS, "acceleration"].contains(what),
            _ => false,
        }
    }
}
