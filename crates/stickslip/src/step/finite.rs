//! Fields that must be finite.

use nalgebra::SVector;

use crate::StepError;

/// Refuses a field that is not finite.
pub(crate) fn check_finite<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
) -> Result<(), StepError> {
    // One pass without a branch; the vertex is looked for only if there is one.
    let mut sound = true;
    for vector in field {
        for c in 0..C {
            sound &= vector[c].is_finite();
        }
    }
    if sound {
        return Ok(());
    }
    for (vertex, vector) in field.iter().enumerate() {
        if let Some(&value) = vector.iter().find(|value| !value.is_finite()) {
            return Err(StepError::Data {
                what,
                vertex,
                value,
            });
        }
    }
    Ok(())
}
