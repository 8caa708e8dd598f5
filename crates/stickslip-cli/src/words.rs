//! Messages of the library with what a command line can try.

use std::error::Error;

use stickslip::integrate::{Limit, LocalError};
use stickslip::{SceneError, StepError, StepFailure};

/// The message of a problem: an error of the library says what to try in options of the command line, not in functions of
/// Rust.
pub(crate) fn message(problem: &(dyn Error + 'static)) -> String {
    let text = problem.to_string();
    if let Some(error) = problem.downcast_ref::<SceneError>() {
        let own = match error {
            SceneError::Start(cause) => return step(text, cause),
            error => hint_of_scene(error),
        };
        return worded(text, error.hint(), own);
    }
    let failure = problem.downcast_ref::<StepFailure>();
    let cause = failure.map(|failure| &failure.cause);
    match cause.or(problem.downcast_ref::<StepError>()) {
        Some(cause) => step(text, cause),
        None => text,
    }
}

/// A message with a hint in place of that of the library.
fn worded(text: String, library: Option<&str>, own: Option<&str>) -> String {
    match (library, own) {
        (Some(library), Some(own)) => text.replace(library, own),
        _ => text,
    }
}

fn step(text: String, cause: &StepError) -> String {
    let text = worded(text, cause.hint(), hint_of_step(cause));
    match cause {
        StepError::StepTooSmall { error, .. }
        | StepError::TooManySteps {
            limit: Limit::Error(error),
            ..
        } => worded(text, Some(error.hint()), Some(hint_of_error(error))),
        _ => text,
    }
}

fn hint_of_scene(error: &SceneError) -> Option<&'static str> {
    Some(match error {
        SceneError::Coincident { .. } => "merge them in the mesh, or take one of them",
        SceneError::OpenWalls(_) => "give its sides a --contact",
        SceneError::NotSymmetric { .. } => "take another --method",
        SceneError::Unbalanced { .. } => {
            "change the initial slip rate, the initial state or the normal stress"
        }
        SceneError::Normal { .. } => "give each of the surfaces that meet there its own --contact",
        SceneError::NoBasis { .. } => "align contacts and boundary parts with the axes",
        SceneError::NotPaired { .. } => "give the group inside the mesh as --contact",
        SceneError::BelowModes { .. } => "raise --frequency",
        _ => return None,
    })
}

fn hint_of_step(error: &StepError) -> Option<&'static str> {
    Some(match error {
        StepError::Data { what: "load", .. } => "change the load",
        StepError::Tension { .. } => {
            "--allow-opening lets it open, unless its normal motion is prescribed or contacts meet there that do not \
             all open along one normal"
        }
        StepError::PorePressure { .. } => {
            "--least-normal-stress PA keeps some of it for friction, --allow-opening opens the fault there"
        }
        StepError::NotUnique { shorter: true, .. } => "take shorter steps",
        StepError::Penetration { .. } => "take another --solver",
        StepError::NotContracting { .. } => {
            "reduce the coefficient of friction, or the steps of a body with inertia"
        }
        StepError::Stage { .. } => "take shorter or adaptive steps",
        StepError::NotCoupled { .. } => "take shorter steps or --coupling monolithic",
        _ => return None,
    })
}

fn hint_of_error(error: &LocalError) -> &'static str {
    match error.largest_of() {
        stickslip::integrate::ErrorOf::Motion => {
            "raise the tolerance, or take a --scheme that damps waves"
        }
        _ => "raise the tolerance",
    }
}
