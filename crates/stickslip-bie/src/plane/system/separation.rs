//! Planes of a system that are too near to each other.

use super::FaultSystem;
use super::placement::Axes;
use crate::{KernelError, Rectangles};

/// The share of a cell's shortest side by which the centres of other cells are away from a plane at least: stress is
/// singular at the edges of cells.
const APART: f64 = 0.1;
/// The share of the extent of planes below which points coincide.
const ROUNDING: f64 = 1e-9;

/// Refuses planes that cross or cover each other, and centres of cells on other planes.
pub(crate) fn check<const C: usize>(system: &FaultSystem<C>) -> Result<(), KernelError> {
    let count = system.planes.len();
    for (plane, other) in (0..count).flat_map(|plane| (0..count).map(move |other| (plane, other))) {
        if plane == other {
            continue;
        }
        // Seen from the other one.
        let own = system.placements[plane].axes_from(&system.placements[other], system.dip(plane));
        let from = super::Placement {
            strike: 0.0,
            origin: [0.0; 2],
        };
        let from = from.axes_from(&from, system.dip(other));
        let (cells, others) = (system.cells(plane), system.cells(other));
        if plane < other {
            check_crossing(cells, &own, others, &from)
                .map_err(|error| error.of_planes([plane, other]))?;
        }
        check_centers(cells, &own, others, &from)
            .map_err(|error| error.of_planes([plane, other]))?;
    }
    Ok(())
}

fn check_centers(
    cells: &Rectangles,
    own: &Axes,
    others: &Rectangles,
    from: &Axes,
) -> Result<(), KernelError> {
    let sides = [cells, others].map(|cells| {
        let lengths = [cells.along_strike().length(), cells.down_dip().length()];
        lengths[0].min(lengths[1])
    });
    let least = APART * sides[0].min(sides[1]);
    let beyond = |x: f64, [begin, end]: [f64; 2]| (begin - x).max(x - end).max(0.0);
    for cell in 0..cells.count() {
        let [x, y, off] = from.coordinates(&own.point(cells.center(cell)));
        let x = beyond(x, others.along_strike().ends());
        let y = beyond(y, others.down_dip().ends());
        let distance = (x * x + y * y + off * off).sqrt();
        // What is not a number is not apart either.
        let apart = distance >= least;
        if !apart {
            let what = "distance [m] between the centre of cell";
            let error = KernelError::new(what, "at least", distance);
            return Err(error.bound(least).of_cell(cell));
        }
    }
    Ok(())
}

/// Refuses planes with a common line, or a common part, inside both. They may touch at their edges.
fn check_crossing(
    cells: &Rectangles,
    own: &Axes,
    others: &Rectangles,
    from: &Axes,
) -> Result<(), KernelError> {
    let ([left, right], [top, bottom]) = (cells.along_strike().ends(), cells.down_dip().ends());
    let corners = [[left, top], [right, top], [right, bottom], [left, bottom]]
        .map(|corner| from.coordinates(&own.point(corner)));
    let bounds = [others.along_strike().ends(), others.down_dip().ends()];
    let [width, height] = bounds.map(|[begin, end]| end - begin);
    let extent = width.max(height).max(right - left).max(bottom - top);
    let near = ROUNDING * extent;
    // Where the corners and the edges meet the other plane.
    let mut meeting = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % 4];
        if a[2].abs() <= near {
            meeting.push([a[0], a[1]]);
        }
        if a[2].min(b[2]) < -near && a[2].max(b[2]) > near {
            let share = a[2] / (a[2] - b[2]);
            meeting.push([0, 1].map(|c| a[c] + share * (b[c] - a[c])));
        }
    }
    let sides = |sign: f64| corners.iter().any(|corner| sign * corner[2] > near);
    let coplanar = meeting.len() == 4;
    if sides(1.0) != sides(-1.0) || meeting.len() < 2 {
        // On one side of it, where the plane may end.
        return Ok(());
    }
    let length = if coplanar {
        // Edges are along those of the other plane.
        let common = [0, 1].map(|c| {
            let along = || meeting.iter().map(|point: &[f64; 2]| point[c]);
            let begin = along().fold(f64::INFINITY, f64::min).max(bounds[c][0]);
            let end = along().fold(f64::NEG_INFINITY, f64::max).min(bounds[c][1]);
            end - begin
        });
        common[0].min(common[1])
    } else {
        length_inside(meeting[0], meeting[1], &bounds, near)
    };
    if length > near {
        let what = "length [m] of the intersection";
        return Err(KernelError::new(what, "at most", length).bound(0.0));
    }
    Ok(())
}

/// The length of a segment inside a rectangle, its edges excluded.
fn length_inside(a: [f64; 2], b: [f64; 2], bounds: &[[f64; 2]; 2], near: f64) -> f64 {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (c, &[begin, end]) in bounds.iter().enumerate() {
        let (begin, end, step) = (begin + near, end - near, b[c] - a[c]);
        if step.abs() <= near {
            if a[c] <= begin || a[c] >= end {
                return 0.0;
            }
            continue;
        }
        let (p, q) = ((begin - a[c]) / step, (end - a[c]) / step);
        first = first.max(p.min(q));
        last = last.min(p.max(q));
    }
    (last - first).max(0.0) * (b[0] - a[0]).hypot(b[1] - a[1])
}
