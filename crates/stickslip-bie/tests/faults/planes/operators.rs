//! Products of planes are those of their matrices, and allocate nothing.

use nalgebra::{DMatrix, SVector};
use proptest::prelude::*;
use stickslip_bie::{PlaneFault, PlaneKernel};
use stickslip_solvers::{Matrix, Operator};

use super::{dense, flat, planes};
use crate::Outcome;
use crate::operators::numbers;

fn field<const C: usize>(seed: u64, count: usize) -> Vec<SVector<f64, C>> {
    let numbers = numbers(seed, C * count);
    numbers
        .chunks_exact(C)
        .map(SVector::from_column_slice)
        .collect()
}

/// Products against the dense matrix, each entry to `rounding` of the largest.
fn check<const C: usize>(
    fault: &PlaneFault<C>,
    seed: u64,
    rounding: f64,
) -> Result<(), TestCaseError> {
    let count = fault.cells().count();
    let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
    let mut sum = PlaneKernel::combination(&[(0.3, &stiffness), (2.0, &damping)]);
    let expected = dense(&stiffness) * 0.3 + dense(&damping) * 2.0;
    prop_assert!((dense(&sum) - &expected).amax() <= 4.0 * f64::EPSILON * expected.amax());
    sum.set_combination(&[(-1.5, &damping), (0.7, &stiffness), (0.1, &stiffness)]);
    sum.add_to_diagonal(count / 2, &nalgebra::SMatrix::from_diagonal_element(1e9));
    let (x, start) = (field::<C>(seed, count), field::<C>(seed ^ 1, count));
    for kernel in [&stiffness, &damping, &sum, &sum.clone()] {
        let (matrix, mut y) = (dense(kernel), start.clone());
        // By -2, of the entries of a row times those of the field.
        let bound = 2.0 * rounding * matrix.amax() * (1.0 + flat(&x).lp_norm(1)) + 1e-12;
        kernel.multiply_add(-2.0, &x, &mut y);
        let exact = &matrix * flat(&x);
        prop_assert!((flat(&y) - flat(&start) + &exact * 2.0).amax() <= bound);
        prop_assert!((kernel.quadratic(&x) - flat(&x).dot(&exact)).abs() <= bound * count as f64);
        for i in 0..count {
            let rows = exact.fixed_rows::<C>(C * i);
            prop_assert!((kernel.product_at(i, &x) - rows).amax() <= bound);
            let block = matrix.fixed_view::<C, C>(C * i, C * i);
            prop_assert!((kernel.diagonal_block(i) - block).amax() <= bound);
        }
    }
    let normal = fault.normal_stiffness();
    let matrix = DMatrix::from_fn(count, C * count, |i, j| normal.entry(i, j / C)[j % C]);
    let mut stress = vec![1.0; count];
    normal.multiply_add(3.0, &x, &mut stress);
    let exact = matrix * flat(&x) * 3.0;
    let bound = 1e-12 * dense(&stiffness).amax() / fault.cells().area();
    for (stress, exact) in stress.iter().zip(&exact) {
        prop_assert!((stress - 1.0 - exact).abs() <= bound + 1e-12);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_are_those_of_the_dense_matrix(
        columns in 1..12_usize,
        rows in 1..10_usize,
        rake in -180.0..180.0_f64,
        seed in any::<u64>(),
    ) {
        let fail = |error: stickslip_bie::KernelError| TestCaseError::fail(error.to_string());
        for fault in planes([columns, rows]).map_err(fail)? {
            for rake in [0.0, 90.0, rake] {
                check(&fault.clone().with_rake(rake).map_err(fail)?, seed, 1e-13)?;
            }
            check(&fault, seed, 1e-13)?;
        }
    }
}

/// Whole spaces have an energy, and uniform slip of a plane that repeats on all sides has none.
#[test]
fn stiffness_of_whole_spaces_is_symmetric_and_definite() -> Outcome {
    for (kind, fault) in planes([9, 8])?.into_iter().enumerate().take(4) {
        let matrix = dense(&fault.stiffness());
        assert!((&matrix - matrix.transpose()).amax() <= 1e-14 * matrix.amax());
        let eigenvalues = matrix.symmetric_eigenvalues();
        let (least, largest) = (eigenvalues.min(), eigenvalues.max());
        if kind == 3 {
            assert!(least.abs() <= 1e-13 * largest, "{least:e} {largest:e}");
        } else {
            assert!(least > 0.0, "{kind}: {least:e} {largest:e}");
        }
    }
    Ok(())
}

/// In a half space the symmetric part is definite, and the other one small.
#[test]
fn stiffness_of_half_spaces_is_nearly_symmetric() -> Outcome {
    for fault in planes([9, 8])?.into_iter().skip(4) {
        let matrix = dense(&fault.stiffness());
        let (even, odd) = (&matrix + matrix.transpose(), &matrix - matrix.transpose());
        assert!(
            odd.amax() < 0.06 * matrix.amax(),
            "{:e}",
            odd.amax() / matrix.amax()
        );
        assert!(even.symmetric_eigenvalues().min() > 0.0);
    }
    Ok(())
}

/// The allocations of products and sums.
fn taken<const C: usize>(fault: &PlaneFault<C>) -> u64 {
    let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
    let terms = [(0.5, &stiffness), (1.0, &damping)];
    let mut sum = PlaneKernel::combination(&terms);
    let normal = fault.normal_stiffness();
    let count = fault.cells().count();
    let (x, mut y) = (field::<C>(3, count), field::<C>(4, count));
    let mut stress = vec![0.0; count];
    let info = allocation_counter::measure(|| {
        sum.set_combination(&terms);
        sum.multiply_add(1.0, &x, &mut y);
        y[0][0] += sum.quadratic(&x) + sum.norm(&x) + sum.product_at(0, &x)[0];
        y[0][0] += sum.diagonal_block(0)[(0, 0)];
        normal.multiply_add(1.0, &x, &mut stress);
    });
    info.count_total
}

#[test]
fn products_and_sums_take_no_memory() -> Outcome {
    for fault in planes([14, 11])? {
        assert_eq!(taken(&fault), 0, "{fault:?}");
        assert_eq!(taken(&fault.with_rake(30.0)?), 0);
    }
    Ok(())
}

/// Clones and all stiffnesses of a fault have one interaction.
#[test]
fn clones_share_their_numbers() -> Outcome {
    for fault in planes([60, 50])?.into_iter().skip(4) {
        let first = fault.stiffness();
        let taken =
            allocation_counter::measure(|| drop((fault.clone().stiffness(), first.clone())));
        // Two memories of products, not 8 bytes per pair of rows and column and component.
        let shared = 4 * 8 * 60 * 50 * 50;
        assert!(taken.bytes_max < shared / 4, "{} {shared}", taken.bytes_max);
    }
    Ok(())
}

/// `mu/(2 c_s)` times the area.
#[test]
fn waves_are_radiated() -> Outcome {
    let medium = crate::MEDIUM;
    for fault in planes([3, 2])? {
        let eta = 0.5 * medium.shear_modulus / medium.shear_wave_speed * fault.cells().area();
        for (damping, factor) in [
            (fault.radiation_damping(), 1.0),
            (fault.radiation_damping_times(4.0)?, 4.0),
        ] {
            let exact = DMatrix::from_diagonal_element(12, 12, factor * eta);
            assert!((dense(&damping) - exact).amax() < 1e-14 * eta);
        }
    }
    Ok(())
}

/// Products of vertical planes by transforms down dip round as the square of the number of rows.
#[test]
fn transformed_products_are_those_of_the_dense_matrix() -> Outcome {
    for (columns, rows) in [(3, 100), (7, 12), (1, 5), (4, 1)] {
        let rounding = f64::EPSILON * f64::from(rows).powi(2) + 1e-13;
        for begin in [0.0, 50.0] {
            let cells = super::cells([columns, rows as usize], [30.0, 20.0], begin)?;
            let fault = PlaneFault::half_space(cells, 90.0, crate::MEDIUM, super::POISSON)?;
            let fault = fault.transformed_down_dip()?;
            let fail = |error: TestCaseError| error.to_string();
            check(&fault, 7, rounding).map_err(fail)?;
            assert_eq!(taken(&fault), 0);
            for rake in [0.0, 90.0, 33.0] {
                check(&fault.clone().with_rake(rake)?, 8, rounding).map_err(fail)?;
            }
        }
    }
    Ok(())
}
