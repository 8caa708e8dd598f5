//! Check that stages lead through the step.

use super::RateSchemeViolation;
use crate::RateScheme;

pub(super) fn check<R: RateScheme + ?Sized>(scheme: &R) -> Result<(), RateSchemeViolation> {
    let stages = scheme.properties().stages;
    let mut reached = 0.0;
    for (stage, part) in stages.iter().enumerate() {
        let last = stage + 1 == stages.len();
        let at = Some(("stage", stage as f64));
        for (quantity, value, legal, requirement) in [
            (
                "share",
                part.share,
                part.share > 0.0 && part.share <= 1.0,
                "above 0 and at most 1",
            ),
            (
                "lead",
                part.lead,
                part.lead.is_finite() && (stage > 0 || part.lead == 0.0),
                "finite, and 0 in the first stage",
            ),
            (
                "end",
                part.end,
                part.end > reached && (part.end == 1.0 || !last),
                "beyond that of the stage before, and 1 in the last stage",
            ),
        ] {
            if !legal {
                return Err(RateSchemeViolation {
                    property: "stages",
                    quantity,
                    at,
                    value,
                    requirement,
                    bound: None,
                });
            }
        }
        reached = part.end;
    }
    if stages.is_empty() {
        return Err(RateSchemeViolation {
            property: "stages",
            quantity: "their number",
            at: None,
            value: 0.0,
            requirement: "at least",
            bound: Some(1.0),
        });
    }
    Ok(())
}
