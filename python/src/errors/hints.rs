//! What to try, in words of this module.

use stickslip::integrate::Limit;
use stickslip::{SceneError, StepError};

/// What to try after a scene was refused, in words of this module; `None` for the words of the library.
pub(super) fn hint_of_scene(error: &SceneError) -> Option<&'static str> {
    Some(match error {
        SceneError::Start(cause) => return hint_of_step(cause),
        SceneError::Coincident { .. } => "merge them or take one wall",
        SceneError::OpenWalls(_) => "give its sides a contact",
        SceneError::Unbalanced { .. } => "change rate, state or stress, or give no slip rate",
        SceneError::Normal { .. } => "make the surfaces that meet there contacts of their own",
        SceneError::NotPaired { .. } => "use `name+` and `name-` of Mesh.split",
        SceneError::NoBasis { .. } => "align contacts and fixed parts with the axes",
        _ => return None,
    })
}

/// What to try if a tolerance cannot be met.
pub(super) const RTOL: &str = "raise rtol";

/// What to try after a failed step, in words of this module; `None` for the words of the library.
pub(super) fn hint_of_step(error: &StepError) -> Option<&'static str> {
    Some(match error {
        StepError::Data { what: "load", .. } => "check functions of time, and plate rates",
        StepError::Tension { .. } => {
            "allow_opening=True lets it open, unless its normal motion is prescribed or contacts meet there that do not \
             all open along one normal"
        }
        StepError::PorePressure { .. } => "allow_opening=True or least_normal_stress=[Pa] takes it",
        StepError::TooManySteps {
            limit: Limit::Error(_),
            ..
        } => "raise max_steps or rtol",
        StepError::TooManySteps {
            limit: Limit::Stability(_),
            ..
        } => "raise max_steps; larger cells and more normal stress allow longer steps",
        StepError::Stage { .. } => "reduce dt, or give rtol for steps by error control",
        StepError::NotCoupled { .. } => "reduce dt or use coupling=\"monolithic\"",
        _ => return None,
    })
}

/// A message with a hint of this module in place of that of the library.
pub(super) fn worded(message: String, library: Option<&str>, own: Option<&str>) -> String {
    match (library, own) {
        (Some(library), Some(own)) => message.replace(library, own),
        _ => message,
    }
}
