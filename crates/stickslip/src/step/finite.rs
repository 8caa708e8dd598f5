//! Fields that must be finite.

use nalgebra::SVector;
use stickslip_solvers::sum_parts;

use crate::StepError;

/// Refuses a field that is not finite.
pub(crate) fn check_finite<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
) -> Result<(), StepError> {
    // One pass without a branch; the vertex is looked for only if there is one.
    let unsound = sum_parts(0..field.len(), (), &|part, ()| {
        let mut sound = true;
        for vector in &field[part] {
            for c in 0..C {
                sound &= vector[c].is_finite();
            }
        }
        f64::from(u8::from(!sound))
    });
    if unsound == 0.0 {
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
