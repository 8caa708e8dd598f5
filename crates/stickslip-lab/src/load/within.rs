//! The polygon through samples that meets all others to within a resolution.

use super::Piece;
use super::gauge::LineError;

/// The pieces of the polygon, the first one from the first sample on; without errors.
pub(super) fn within(times: &[f64], displacements: &[f64], resolution: f64) -> Vec<Piece> {
    let corners = samples(times, displacements, resolution);
    let corner = |pair: &[usize]| {
        let (from, to) = (pair[0], pair[1]);
        Piece {
            start: times[from],
            displacement: displacements[from],
            velocity: (displacements[to] - displacements[from]) / (times[to] - times[from]),
            error: LineError::default(),
        }
    };
    corners.windows(2).map(corner).collect()
}

/// The samples at which a polygon through some of the samples has its corners: it meets the others to `resolution`.
///
/// A piece goes on as long as one line through its first sample meets all of its samples.
fn samples(times: &[f64], displacements: &[f64], resolution: f64) -> Vec<usize> {
    let mut corners = vec![0];
    let (mut from, mut last) = (0, 0);
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for to in 1..times.len() {
        let span = times[to] - times[from];
        let change = displacements[to] - displacements[from];
        let velocity = change / span;
        if !(low..=high).contains(&velocity) && last > from {
            corners.push(last);
            from = last;
            (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let span = times[to] - times[from];
        let change = displacements[to] - displacements[from];
        low = low.max((change - resolution) / span);
        high = high.min((change + resolution) / span);
        last = to;
    }
    corners.push(last);
    corners
}
