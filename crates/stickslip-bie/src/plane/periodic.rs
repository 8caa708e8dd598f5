//! Planes in a whole space that continue periodically.

use std::f64::consts::PI;

use super::whole_space::{Block, WholeSpace};

/// Periods on either side that are summed one by one.
const PERIODS: i32 = 32;
/// A distance, in periods, at which a strip ends that has no end.
const FAR: f64 = 1e9;

/// The stiffness of a mode of a plane that is periodic in both directions, from its waves per period: force on a cell
/// per slip along strike and up dip, `area (mu/2) [kx^2/(1 - nu) + ky^2]/k` and so on. Slip is smooth, not constant on
/// cells.
///
/// The cross term is odd in either direction, thus 0 for two cells a wave.
pub(crate) fn mode_stiffness(space: &WholeSpace, counts: [usize; 2], waves: [usize; 2]) -> Block {
    let mut wavenumbers = [0.0; 2];
    let mut shortest = false;
    for axis in 0..2 {
        let (count, waves) = (counts[axis], waves[axis]);
        shortest |= 2 * waves == count;
        // Beyond half the count the waves run the other way.
        let signed = if 2 * waves > count {
            waves as f64 - count as f64
        } else {
            waves as f64
        };
        wavenumbers[axis] = 2.0 * PI * signed / (count as f64 * space.size[axis]);
    }
    let [x, y] = wavenumbers;
    let length = x.hypot(y);
    if length == 0.0 {
        return [0.0; 3];
    }
    let factor = 0.5 * space.area() * space.shear_modulus / length;
    let stretched = 1.0 + space.ratio;
    let cross = if shortest {
        0.0
    } else {
        -factor * space.ratio * x * y
    };
    [
        factor * (stretched * x * x + y * y),
        factor * (x * x + stretched * y * y),
        cross,
    ]
}

/// The force on a cell per slip of a cell so many cells before it and of all its images along `axis`, which repeat
/// after `count` cells.
///
/// Images beyond [`PERIODS`] are smeared to strips without end, in closed form, with the first correction of Euler and
/// Maclaurin. The error is below 1e-9 of the cell's own force times the cube of (cell size/period).
pub(crate) fn lattice_sum(
    space: &WholeSpace,
    apart: [isize; 2],
    axis: usize,
    count: usize,
) -> Block {
    let size = space.size[axis];
    let period = count as f64 * size;
    let across = 1 - axis;
    let edges = |distance: f64, size: f64| [distance + 0.5 * size, distance - 0.5 * size];
    let other = edges(
        apart[across] as f64 * space.size[across],
        space.size[across],
    );
    let own = apart[axis] as f64 * size;
    let rectangle = |along: [f64; 2]| match axis {
        0 => space.rectangle(along, other),
        _ => space.rectangle(other, along),
    };
    let image = |periods: i32| rectangle(edges(own + f64::from(periods) * period, size));
    let mut sum = [0.0; 3];
    let mut add = |factor: f64, block: Block| {
        for (sum, value) in sum.iter_mut().zip(block) {
            *sum += factor * value;
        }
    };
    for periods in -PERIODS..=PERIODS {
        add(1.0, image(periods));
    }
    let share = size / period;
    let slope = (1.0 - share * share) / 24.0;
    let reach = (f64::from(PERIODS) + 0.5) * period;
    for side in [1, -1] {
        let (near, far) = (
            own + f64::from(side) * reach,
            f64::from(side) * FAR * period,
        );
        let strip = if side > 0 { [far, near] } else { [near, far] };
        add(share, rectangle(strip));
        add(slope, image(side * (PERIODS + 1)));
        add(-slope, image(side * PERIODS));
    }
    sum
}
