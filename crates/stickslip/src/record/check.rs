//! Checks of recorders' settings against a scene.

use crate::SceneError;

/// Refuses a setting out of its range.
pub(super) fn require(
    what: &'static str,
    requirement: &'static str,
    value: f64,
    legal: bool,
) -> Result<(), SceneError> {
    crate::checks::require(what, requirement, 0, value, legal)
}

/// Refuses a number that is not positive and finite.
pub(super) fn positive(what: &'static str, value: f64) -> Result<(), SceneError> {
    let legal = value > 0.0 && value.is_finite();
    require(what, "positive and finite", value, legal)
}

/// Refuses an index of a vertex or contact that is out of range.
pub(super) fn check_index(
    what: &'static str,
    index: usize,
    count: usize,
) -> Result<(), SceneError> {
    SceneError::check_index(what, index, count).map(|_| ())
}
