//! Planes cut, turned and exchanged.

use nalgebra::DMatrix;
use stickslip_bie::{Cells, FaultSystem, PlaneFault, Rectangles};

use super::{at, dense, dense_normal, plane, planes};
use crate::Outcome;
use crate::planes::{self, cells};

const COLUMNS: usize = 12;
const ROWS: usize = 6;
const SIZE: [f64; 2] = [300.0, 200.0];

/// The largest difference between the matrices of a plane and of its halves. `skip` are pairs of cells of the plane
/// that are not compared.
fn compare<const C: usize>(
    one: &PlaneFault<C>,
    halves: &FaultSystem<C>,
    number: impl Fn(usize) -> usize,
    skip: impl Fn([usize; 2], [usize; 2]) -> bool,
) -> f64 {
    let (expected, found) = (planes::dense(&one.stiffness()), dense(&halves.stiffness()));
    let (normal, found_normal) = (one.normal_stiffness(), dense_normal(halves));
    let (largest, area) = (expected.amax(), one.cells().area());
    let mut error = 0.0_f64;
    let count = halves.vertex_count();
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let (a, b) = (number(i), number(j));
        let exact = expected.fixed_view::<C, C>(C * a, C * b);
        let block = found.fixed_view::<C, C>(C * i, C * j);
        if !skip(one.cells().column_and_row(a), one.cells().column_and_row(b)) {
            error = error.max((block - exact).amax());
        }
        for c in 0..C {
            let difference = found_normal[(i, C * j + c)] - normal.entry(a, b)[c];
            error = error.max(difference.abs() * area);
        }
    }
    error / largest
}

/// Diagonal neighbours across the cut have no correction of the coupling of both components.
fn neighbours([column, row]: [usize; 2], [other_column, other_row]: [usize; 2]) -> bool {
    column.abs_diff(other_column) == 1 && row.abs_diff(other_row) == 1
}

#[test]
fn halves_of_a_plane_are_the_plane() -> Outcome {
    let strike = 37.0_f64;
    let (sin, cos) = strike.to_radians().sin_cos();
    let half = COLUMNS / 2;
    let width = half as f64 * SIZE[0];
    for (dip, begin) in [(90.0, 0.0), (60.0, 0.0), (25.0, 500.0)] {
        let one = plane(cells([COLUMNS, ROWS], SIZE, begin)?, dip)?;
        let part = plane(cells([half, ROWS], SIZE, begin)?, dip)?;
        let places = [
            at(strike, [5.0, 7.0]),
            at(strike, [5.0 + width * sin, 7.0 + width * cos]),
        ];
        let number = |vertex: usize| {
            let (part, cell) = (vertex / (half * ROWS), vertex % (half * ROWS));
            (cell / half) * COLUMNS + cell % half + part * half
        };
        let halves = FaultSystem::new(places.map(|place| (part.clone(), place)))?;
        let error = compare(&one, &halves, number, neighbours);
        assert!(error < 1e-10, "{dip}: {error:e}");
        for rake in [0.0, 90.0] {
            let part = part.clone().with_rake(rake)?;
            let halves = FaultSystem::new(places.map(|place| (part.clone(), place)))?;
            let error = compare(&one.clone().with_rake(rake)?, &halves, number, |_, _| false);
            assert!(error < 1e-10, "{dip} {rake}: {error:e}");
        }
        // Cut down dip.
        let upper = 2;
        let along = *one.cells().along_strike();
        let cut = begin + upper as f64 * SIZE[1];
        let end = begin + ROWS as f64 * SIZE[1];
        let parts = [
            Rectangles::new(along, Cells::new([begin, cut], upper)?),
            Rectangles::new(along, Cells::new([cut, end], ROWS - upper)?),
        ];
        let [first, second] = parts.map(|cells| plane(cells, dip));
        let place = at(strike, [-3e3, 1e3]);
        let halves = FaultSystem::new([(first?, place), (second?, place)])?;
        let error = compare(&one, &halves, |vertex| vertex, neighbours);
        assert!(error < 1e-10, "{dip} down dip: {error:e}");
    }
    Ok(())
}

/// North is of no account.
#[test]
fn systems_turn_as_a_whole() -> Outcome {
    let first = FaultSystem::new(planes(0.0)?)?;
    for turn in [90.0, 33.0, -171.5] {
        let turned = FaultSystem::new(planes(turn)?)?;
        for (a, b) in [
            (dense(&first.stiffness()), dense(&turned.stiffness())),
            (dense_normal(&first), dense_normal(&turned)),
        ] {
            let error = (&a - b).amax() / a.amax();
            assert!(error < 1e-12, "{turn}: {error:e}");
        }
        assert_ne!(turned.fingerprint(), first.fingerprint());
    }
    Ok(())
}

/// Betti: the force on a cell per slip of another one is that on the other per slip of the first, for cells that are
/// small and far away; at the surface as well.
#[test]
fn small_cells_exchange_their_forces() -> Outcome {
    let far = 1e3;
    for begin in [1e5, 300.0] {
        let mut deviations = Vec::new();
        for size in [80.0, 40.0, 20.0] {
            let one = |sides: [f64; 2], dip: f64| {
                // Cells about the same centre.
                let half = sides.map(|side| 0.5 * side);
                plane(
                    Rectangles::new(
                        Cells::new([-half[0], half[0]], 1)?,
                        Cells::new([begin - half[1], begin + half[1]], 1)?,
                    ),
                    dip,
                )
            };
            let dips = [70.0, 40.0_f64];
            // Centres are far from each other horizontally, and at different depths in the shallow system.
            let shift = |dip: f64| begin * dip.to_radians().cos();
            let system = FaultSystem::new([
                (one([size, size], dips[0])?, at(90.0, [0.0, shift(dips[0])])),
                (
                    one([size, 0.5 * size], dips[1])?,
                    at(50.0, {
                        let back = shift(dips[1]);
                        let (sin, cos) = 50f64.to_radians().sin_cos();
                        [0.6 * far - back * cos, 0.8 * far + back * sin]
                    }),
                ),
            ])?;
            let matrix = dense(&system.stiffness());
            let block = |i: usize, j: usize| -> DMatrix<f64> {
                matrix.view((2 * i, 2 * j), (2, 2)).into_owned()
            };
            let (there, back) = (block(1, 0), block(0, 1));
            deviations.push((&there - back.transpose()).amax() / there.amax());
        }
        assert!(deviations[0] < 0.02, "{begin}: {deviations:?}");
        for pair in deviations.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((ratio - 4.0).abs() < 0.2, "{begin}: {deviations:?}");
        }
    }
    Ok(())
}
