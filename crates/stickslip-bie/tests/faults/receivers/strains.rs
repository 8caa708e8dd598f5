//! Displacement against stress, by Hooke's law and differences.

use nalgebra::Matrix3;
use proptest::prelude::*;
use stickslip_bie::Sources;

use super::{POISSON_RATIO, in_space, lines};
use crate::MEDIUM;

/// The step of differences \[m\].
const STEP: f64 = 20.0;

/// The stress of slip of all cells and components by 1 m, from differences of the displacement.
fn by_differences<const C: usize>(sources: &Sources<C>, at: [f64; 3]) -> Matrix3<f64> {
    let moved = |axis: usize, steps: f64| {
        let mut at = at;
        at[axis] += steps * STEP;
        let mut sum = [0.0; 3];
        for moved in (0..sources.count()).flat_map(|cell| sources.displacements(cell, at)) {
            for (sum, moved) in sum.iter_mut().zip(moved) {
                *sum += moved;
            }
        }
        sum
    };
    let mut gradient = Matrix3::zeros();
    for axis in 0..3 {
        let [near, far] = [1.0, 2.0].map(|n| [moved(axis, n), moved(axis, -n)]);
        for i in 0..3 {
            let difference = 8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i]);
            gradient[(i, axis)] = difference / (12.0 * STEP);
        }
    }
    let ratio = 2.0 * POISSON_RATIO / (1.0 - 2.0 * POISSON_RATIO);
    let strained = gradient + gradient.transpose();
    (strained + Matrix3::identity() * (ratio * gradient.trace())) * MEDIUM.shear_modulus
}

fn direct<const C: usize>(sources: &Sources<C>, at: [f64; 3]) -> Matrix3<f64> {
    let cells = 0..sources.count();
    cells.flat_map(|cell| sources.stresses(cell, at)).sum()
}

fn check<const C: usize>(
    name: &str,
    sources: &Sources<C>,
    at: [f64; 3],
) -> Result<(), TestCaseError> {
    // Further than the steps from any cell: its displacement is smooth there.
    let (found, expected) = (by_differences(sources, at), direct(sources, at));
    let scale = expected.abs().max() + 1e-6 * MEDIUM.shear_modulus / 1e3;
    let error = (found - expected).abs().max();
    prop_assert!(error < 1e-4 * scale, "{name} at {at:?}: {found} {expected}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn strains_give_the_stress(
        x in -20e3..-3e3, y in 3e3..20e3, depth in 100.0..15e3_f64,
    ) {
        // Behind all lines, and beside all planes.
        let wrong = |error: Box<dyn std::error::Error>| TestCaseError::fail(error.to_string());
        for (name, sources) in lines().map_err(wrong)? {
            check(name, &sources, [x, y, -depth])?;
        }
        for (name, sources) in in_space().map_err(wrong)? {
            check(name, &sources, [x, y, -depth])?;
        }
    }
}
