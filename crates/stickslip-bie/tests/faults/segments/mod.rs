//! Faults along polylines.

mod closed_forms;
mod loads;
mod off_fault;
mod operators;
mod planar;
mod ranges;
mod references;
mod refusals;
#[cfg(feature = "csv")]
mod tables;

use stickslip_bie::{Medium, SegmentFault, Segments, SegmentsError};

use crate::IN_PLANE;

/// Of modulus 1, for numbers that are known so.
pub(crate) const UNIT: Medium = Medium {
    shear_modulus: 1.0,
    shear_wave_speed: 1.0,
};

/// In a half space, in plane strain.
pub(crate) fn half_space(segments: Segments) -> Result<SegmentFault, SegmentsError> {
    SegmentFault::half_space(segments, UNIT, IN_PLANE)
}
