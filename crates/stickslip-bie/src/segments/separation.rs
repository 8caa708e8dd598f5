//! Segments that are too near to each other.

use super::{Segments, SegmentsError};

/// The least distance of a cell's centre from cells beside it and from those that share an end with it, as shares of its
/// length.
const APART: f64 = 0.5;
const APART_AT_ENDS: f64 = 0.1;
/// The share of a length below which points coincide.
const ROUNDING: f64 = 1e-9;

/// Refuses cells without length, repeated and crossing cells, and centres near other cells: an end of a cell stresses them.
pub(super) fn check(segments: &Segments) -> Result<(), SegmentsError> {
    check_lines(segments)?.map_or(Ok(()), Err)
}

/// Refuses cells without length, and cells that are the same or cross; finds a centre near to another cell, which shorter
/// cells may mend.
pub(super) fn check_lines(segments: &Segments) -> Result<Option<SegmentsError>, SegmentsError> {
    let boxes: Vec<_> = (0..segments.count())
        .map(|cell| reach(segments, cell))
        .collect();
    let extent = extent(segments);
    let far = |x: &f64| x.abs();
    for cell in 0..segments.count() {
        let ends = segments.ends(cell);
        let largest = ends.as_flattened().iter().map(far).fold(0.0, f64::max);
        // Of points that rounding alone tells apart.
        if segments.length(cell) <= 4.0 * f64::EPSILON * largest {
            let position = ends[0];
            return Err(SegmentsError::ZeroLength { cell, position });
        }
    }
    // A sweep along the longer axis meets the pairs whose surroundings overlap.
    let (along, across) = if extent[0] >= extent[1] {
        (0, 1)
    } else {
        (1, 0)
    };
    let mut order: Vec<_> = (0..segments.count()).collect();
    order.sort_by(|&i, &j| boxes[i][along][0].total_cmp(&boxes[j][along][0]));
    let mut near = None;
    for (place, &i) in order.iter().enumerate() {
        for &j in &order[place + 1..] {
            if boxes[j][along][0] > boxes[i][along][1] {
                break;
            }
            let [own, other] = [i, j].map(|cell| boxes[cell][across]);
            if own[0] <= other[1] && other[0] <= own[1] {
                let pair = check_pair(segments, [i.min(j), i.max(j)]);
                // Cells that cross are named before others that are near.
                match pair {
                    Err(error @ SegmentsError::TooNear { .. }) => near = near.or(Some(error)),
                    other => other?,
                }
            }
        }
    }
    Ok(near)
}

/// The extents of all cells along both axes.
pub(super) fn extent(segments: &Segments) -> [f64; 2] {
    [0, 1].map(|c| {
        let ends = || (0..segments.count()).flat_map(|cell| segments.ends(cell));
        let least = ends().map(|end| end[c]).fold(f64::INFINITY, f64::min);
        let most = ends().map(|end| end[c]).fold(f64::NEG_INFINITY, f64::max);
        most - least
    })
}

/// The box around a cell within half of its length, along each axis.
fn reach(segments: &Segments, cell: usize) -> [[f64; 2]; 2] {
    let ([a, b], half) = (segments.ends(cell), APART * segments.length(cell));
    [0, 1].map(|c| [a[c].min(b[c]) - half, a[c].max(b[c]) + half])
}

fn check_pair(segments: &Segments, cells: [usize; 2]) -> Result<(), SegmentsError> {
    let [own, other] = cells.map(|cell| segments.ends(cell));
    let shortest = segments.length(cells[0]).min(segments.length(cells[1]));
    let same = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= ROUNDING * shortest;
    let pairs = own.map(|a| other.map(|b| same(a, b)));
    if (pairs[0][0] && pairs[1][1]) || (pairs[0][1] && pairs[1][0]) {
        return Err(SegmentsError::Duplicate { cells });
    }
    let share = if pairs.as_flattened().contains(&true) {
        APART_AT_ENDS
    } else {
        if let Some(position) = crossing(own, other) {
            return Err(SegmentsError::Crossing { cells, position });
        }
        APART
    };
    for [cell, beside] in [cells, [cells[1], cells[0]]] {
        let distance = distance(segments.center(cell), segments.ends(beside));
        let least = share * segments.length(cell);
        if distance < least * (1.0 - ROUNDING) {
            return Err(SegmentsError::TooNear {
                cells: [cell, beside],
                distance,
                least,
            });
        }
    }
    Ok(())
}

/// The point in which two segments cross inside of both.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let along = |from: [f64; 2], to: [f64; 2]| [to[0] - from[0], to[1] - from[1]];
    let turn = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let (u, v) = (along(a, b), along(c, d));
    let (of_c, of_d) = (turn(u, along(a, c)), turn(u, along(a, d)));
    let (of_a, of_b) = (turn(v, along(c, a)), turn(v, along(c, b)));
    let across = |p: f64, q: f64| (p < 0.0 && q > 0.0) || (p > 0.0 && q < 0.0);
    (across(of_c, of_d) && across(of_a, of_b)).then(|| {
        let share = of_a / (of_a - of_b);
        [0, 1].map(|k| a[k] + share * u[k])
    })
}

/// The distance of a point from a segment.
fn distance(point: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (u, p) = (
        [b[0] - a[0], b[1] - a[1]],
        [point[0] - a[0], point[1] - a[1]],
    );
    let share = (u[0] * p[0] + u[1] * p[1]) / (u[0] * u[0] + u[1] * u[1]);
    let share = share.clamp(0.0, 1.0);
    (p[0] - share * u[0]).hypot(p[1] - share * u[1])
}
