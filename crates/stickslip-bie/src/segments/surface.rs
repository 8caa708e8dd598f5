//! Segments below a free surface.

use super::{Segments, SegmentsError, separation};

/// The share of the extent of all cells within which an end is on the surface.
const ON: f64 = 1e-9;
/// The least depth of an end that is not on the surface, as a share of its cell.
const LEAST: f64 = 1e-3;

/// The segments with ends on the surface to the bit.
///
/// # Errors
/// For cells above it, along it, and with an end right below it.
pub(super) fn below(mut segments: Segments) -> Result<Segments, SegmentsError> {
    let near = ON
        * separation::extent(&segments)
            .into_iter()
            .fold(0.0, f64::max);
    let heights = |cell: usize| segments.ends(cell).map(|end| end[1]);
    let all = || (0..segments.count()).flat_map(heights);
    let highest = all().fold(f64::NEG_INFINITY, f64::max);
    if highest > near && all().all(|z| z >= 0.0) {
        return Err(SegmentsError::PositiveDepths { highest });
    }
    for cell in 0..segments.count() {
        let [a, b] = heights(cell);
        let (height, least) = (a.max(b), LEAST * segments.length(cell));
        if height > near {
            return Err(SegmentsError::AboveSurface { cell, height });
        }
        if a.min(b) > -near {
            return Err(SegmentsError::AlongSurface { cell });
        }
        if height < -near && height > -least {
            let depth = -height;
            return Err(SegmentsError::NearSurface { cell, depth, least });
        }
    }
    for end in segments.ends_mut().as_flattened_mut() {
        if end[1] >= -near {
            end[1] = 0.0;
        }
    }
    Ok(segments)
}
