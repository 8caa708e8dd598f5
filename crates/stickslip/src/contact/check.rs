//! What is wrong with nodal data, found before the first step.

use stickslip_friction::Nodal;

use crate::SceneError;

/// Refuses data of another length than there are vertices.
pub(crate) fn length<T>(
    what: &'static str,
    nodal: &Nodal<T>,
    expected: usize,
) -> Result<(), SceneError> {
    match nodal {
        Nodal::PerVertex(values) if values.len() != expected => Err(SceneError::Length {
            what,
            expected,
            found: values.len(),
        }),
        _ => Ok(()),
    }
}

/// Refuses infinities and what is not a number.
pub(crate) fn finite(what: &'static str, position: usize, value: f64) -> Result<(), SceneError> {
    require(what, "finite", position, value, value.is_finite())
}

/// Refuses a value that does not hold what is required of it.
pub(crate) fn require(
    what: &'static str,
    requirement: &'static str,
    position: usize,
    value: f64,
    holds: bool,
) -> Result<(), SceneError> {
    if holds {
        return Ok(());
    }
    Err(SceneError::Value {
        what,
        requirement,
        position,
        value,
    })
}
