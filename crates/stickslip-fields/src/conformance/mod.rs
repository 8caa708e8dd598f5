//! The contract of a field, as a check of any implementation.

mod advance;
mod decay;
mod order;
mod samples;
mod shown;
mod violation;

use crate::FaultField;

use samples::Samples;
pub use violation::FieldViolation;

/// Checks a field against its contract, for slip rates from 0 to 100 m/s and steps from 1e-9 to 1e15 s.
///
/// | method | must |
/// | --- | --- |
/// | `sizes` | have a vertex, and a finite initial memory |
/// | `source`, `pressure`, `read`, `total` | write every value, finite |
/// | `advance` | write every value, finite; by 0 s leave the memory as it is; by two halves of a step, with the source in their middle, lead to the end of the whole: to 1e-12 if `error` adds nothing and the pressure shows it, else the difference is of third order |
/// | `advance` without source | not let the pressure that sources have fed grow beyond the range of that of a held source; forget it alike by one long step or two |
/// | `pressure` | add to what is there; be linear in what sources have fed |
/// | `pressure_after` | agree with `advance` and `pressure`, to 1e-8 of the pressure; write what `source` reads of the memory |
///
/// Pressures and memories are compared to those that the same field reaches in the same time without sources: the memory
/// may hold the time, or an injected volume. Where the pressure changes without any source, its growth is not
/// checked.
///
/// Its samples are fixed. A field of a few vertices takes milliseconds.
///
/// ```
/// use stickslip_fields::{FieldViolation, GivenPressure, check_fault_field};
///
/// let given = GivenPressure::new(2, 0.0, |time, pressure| pressure[1] += 1e3 * time);
/// check_fault_field(&given)?;
/// # Ok::<(), FieldViolation>(())
/// ```
///
/// # Errors
///
/// The first violation, with the numbers that show it.
pub fn check_fault_field(field: &dyn FaultField) -> Result<(), FieldViolation> {
    let sizes = field.sizes();
    if sizes.vertices == 0 {
        return Err(FieldViolation::Value {
            what: "number of vertices of field",
            place: 0,
            dt: None,
            value: 0.0,
            requirement: "at least 1",
        });
    }
    samples::finite("initial memory", None, &sizes.memory)?;
    let samples = Samples::new(field, sizes)?;
    shown::check(&samples)?;
    advance::check(&samples)?;
    decay::check(&samples)?;
    if samples.is_exact()? {
        advance::check_halves(&samples)
    } else {
        order::check(&samples)
    }
}
