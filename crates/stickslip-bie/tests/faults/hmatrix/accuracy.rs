//! The error of far blocks is within the tolerance, whatever the geometry.

use proptest::prelude::*;
use stickslip_bie::hmatrix::{Approximation, HMatrix};

use super::{Points, boxes, error, exact, far_error, noise, product, sheet, smooth};
use crate::Outcome;

/// Errors of far blocks within their tolerance: the cross approximation estimates its own error.
const SAFETY: f64 = 2.0;

#[test]
fn products_are_those_of_the_dense_matrix() -> Outcome {
    let points = Points {
        places: sheet(30),
        shape: [3, 2],
        pair: smooth,
    };
    let x = noise(1800);
    let dense = exact(&points, [900, 900], &x);
    for tolerance in [1e-2, 1e-4, 1e-8] {
        let with = Approximation::default().with_tolerance(tolerance)?;
        let mut matrix = points.compress(&with)?;
        assert!(error(&product(&matrix, &x), &dense) < tolerance);
        assert!(far_error(&mut matrix, &points) < SAFETY * tolerance);
        let compression = matrix.compression();
        assert_eq!(compression.dense_bytes, 8 * 1800 * 2700);
        assert!(compression.stored_share() <= 1.0 && compression.evaluated_share() <= 1.0);
    }
    Ok(())
}

#[test]
fn receivers_need_not_be_sources() -> Outcome {
    let points = Points {
        places: sheet(25),
        shape: [2, 1],
        pair: smooth,
    };
    // Receivers: some of the points, in another place; the entries see their places.
    let receivers: Vec<[f64; 3]> = (0..240)
        .map(|k| [0.004 * f64::from(k), -0.4, 0.1])
        .collect();
    let all = Points {
        places: receivers.iter().chain(&points.places).copied().collect(),
        shape: [2, 1],
        pair: |a: [f64; 3], b: [f64; 3], block: &mut [f64]| {
            smooth(a, [b[0], b[1] + 1e-3, b[2]], block)
        },
    };
    let places = boxes(&all.places);
    let approximation = Approximation::default();
    // Sources are numbered from the first receiver on.
    let matrix = HMatrix::between(&all, &places[..240], &places, &approximation)?;
    assert_eq!(matrix.cells(), [240, 865]);
    let x = noise(865);
    let dense = exact(&all, [240, 865], &x);
    assert!(error(&product(&matrix, &x), &dense) < 1e-4);
    Ok(())
}

#[test]
fn a_kernel_of_zeros_takes_near_blocks_alone() -> Outcome {
    let points = Points {
        places: sheet(20),
        shape: [3, 2],
        pair: |_: [f64; 3], _: [f64; 3], block: &mut [f64]| block.fill(0.0),
    };
    let matrix = points.compress(&Approximation::default())?;
    let compression = matrix.compression();
    assert_eq!((compression.far_blocks, compression.largest_rank), (0, 0));
    assert_eq!(compression.bytes, compression.near_bytes);
    assert_eq!(product(&matrix, &noise(800)), vec![0.0; 1200]);
    Ok(())
}

#[test]
fn rows_that_do_not_feel_each_others_columns_are_all_approximated() -> Outcome {
    // Two kernels side by side, of far different size, and a row of zeros between them.
    let points = Points {
        places: sheet(25),
        shape: [3, 2],
        pair: |a: [f64; 3], b: [f64; 3], block: &mut [f64]| {
            let mut numbers = [0.0; 5];
            smooth(a, b, &mut numbers);
            block.copy_from_slice(&[numbers[0], 0.0, 0.0, 0.0, 0.0, 1e-2 * numbers[4]]);
        },
    };
    let mut matrix = points.compress(&Approximation::default())?;
    assert!(far_error(&mut matrix, &points) < SAFETY * 1e-4);
    let one: Vec<f64> = (0..1250).map(|k| f64::from(k % 2)).collect();
    let (found, dense) = (product(&matrix, &one), exact(&points, [625, 625], &one));
    assert!(error(&found, &dense) < 1e-2);
    Ok(())
}

#[test]
fn one_cell_and_cells_in_one_place() -> Outcome {
    for count in [1, 2, 100] {
        let points = Points {
            places: vec![[1.0, 2.0, -3.0]; count],
            shape: [2, 2],
            pair: smooth,
        };
        let mut matrix = points.compress(&Approximation::default())?;
        assert_eq!(far_error(&mut matrix, &points), 0.0);
        assert_eq!(matrix.compression().far_blocks, 0);
        let x = noise(2 * count);
        let dense = exact(&points, [count; 2], &x);
        assert!(error(&product(&matrix, &x), &dense) < 1e-14);
    }
    Ok(())
}

/// Clouds, lines, planes and several of them, with places taken more than once.
fn places() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let one =
        (0..3_usize, -2.0..2.0, -2.0..2.0, -2.0..2.0).prop_map(|(kind, x, y, z)| match kind {
            0 => [x, y, z],
            1 => [x, 0.0, 0.5],
            _ => [x, y, -3.0],
        });
    prop::collection::vec(one, 1..300)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_tolerance_is_kept(
        places in places(), shape in [1..4_usize, 1..4_usize], power in -9.0..-1.0, scale in -30.0..30.0,
    ) {
        let (tolerance, scale) = (10f64.powf(power), 10f64.powf(scale));
        let count = places.len();
        let points = Points {
            places,
            shape,
            pair: |a: [f64; 3], b: [f64; 3], block: &mut [f64]| {
                smooth(a, b, block);
                block.iter_mut().for_each(|number| *number *= scale);
            },
        };
        let with = Approximation::default().with_tolerance(tolerance)?;
        let mut matrix = points.compress(&with)?;
        let error_of_far = far_error(&mut matrix, &points);
        // Cells apart from all others are seen by few crosses.
        prop_assert!(error_of_far < 5.0 * SAFETY * tolerance, "{error_of_far:e} of {tolerance:e}");
        let x = noise(shape[1] * count);
        let of_product = error(&product(&matrix, &x), &exact(&points, [count; 2], &x));
        prop_assert!(of_product < 30.0 * tolerance, "{of_product:e} of {tolerance:e}");
    }
}
