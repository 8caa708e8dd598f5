//! Products by Fourier transforms are those of the matrices; these are symmetric and definite.

use proptest::prelude::*;
use stickslip_bie::Kernel;
use stickslip_solvers::{Matrix, Operator};

use crate::{Outcome, dense, field, flat, kinds};

/// Numbers that a seed gives, from -1 to 1.
pub(crate) fn numbers(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed;
    (0..count)
        .map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        })
        .collect()
}

/// A transform of `n` numbers rounds to some `log2 n` units of the largest entry times the norm of the field.
fn rounding(kernel: &Kernel) -> f64 {
    let count = kernel.vertex_count() as f64;
    8.0 * f64::EPSILON * (count.log2() + 2.0) * count.sqrt() * dense(kernel).amax()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_are_those_of_the_dense_matrix(count in 1..80_usize, seed in any::<u64>()) {
        let (x, start) = (numbers(seed, count), numbers(seed ^ 1, count));
        let faults = kinds(count).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let mut sums = Vec::new();
        for fault in &faults {
            let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
            // A step's operator, made and made anew.
            let mut sum = Kernel::combination(&[(0.3, &stiffness), (2.0, &damping)]);
            let expected = dense(&stiffness) * 0.3 + dense(&damping) * 2.0;
            prop_assert!((dense(&sum) - &expected).amax() <= 4.0 * f64::EPSILON * expected.amax());
            sum.set_combination(&[(-1.5, &damping), (0.7, &stiffness), (0.1, &stiffness)]);
            let expected = dense(&stiffness) * 0.8 - dense(&damping) * 1.5;
            prop_assert!((dense(&sum) - &expected).amax() <= 4.0 * f64::EPSILON * expected.amax());
            sum.add_to_diagonal(count / 2, &[[1e9]].into());
            sums.extend([stiffness, damping, sum]);
        }
        // Whatever the kernels are of.
        let all: Vec<_> = sums.iter().map(|kernel| (0.5, kernel)).collect();
        sums.push(Kernel::combination(&all));
        for kernel in &sums {
            let (x, mut y) = (field(&x), field(&start));
            let (matrix, bound) = (dense(kernel), rounding(kernel));
            kernel.multiply_add(-2.0, &x, &mut y);
            let exact = matrix.clone() * flat(&x);
            let from = flat(&field(&start));
            prop_assert!((flat(&y) - from + &exact * 2.0).amax() <= 2.0 * bound + 2.0 * f64::EPSILON);
            prop_assert!((kernel.quadratic(&x) - flat(&x).dot(&exact)).abs() <= bound * count as f64);
            for i in 0..count {
                prop_assert!((kernel.product_at(i, &x)[0] - exact[i]).abs() <= bound);
                prop_assert_eq!(kernel.diagonal_block(i)[(0, 0)], matrix[(i, i)]);
            }
            prop_assert_eq!(&matrix, &matrix.transpose());
        }
    }
}

/// Slip that is not the same everywhere takes work; in a periodic space slip that is takes none.
#[test]
fn stiffness_is_positive_definite() -> Outcome {
    for (kind, fault) in kinds(31)?.into_iter().enumerate() {
        let eigenvalues = dense(&fault.stiffness()).symmetric_eigenvalues();
        let (least, largest) = (eigenvalues.min(), eigenvalues.max());
        let periodic = kind >= 4;
        if periodic {
            assert!(least.abs() <= 1e-13 * largest, "{least:e} {largest:e}");
        } else {
            assert!(least > 0.0, "{least:e}");
        }
    }
    Ok(())
}

/// The half that is seen of a symmetric whole space is a half space.
#[test]
fn images_are_the_other_half() -> Outcome {
    use stickslip_bie::{Cells, Fault, Mode};
    let half = Fault::half_space(Cells::new([0.0, 4e3], 20)?, crate::MEDIUM)?;
    let whole = Fault::whole_space(Cells::new([-4e3, 4e3], 40)?, crate::MEDIUM, Mode::Antiplane)?;
    let slip = numbers(5, 20);
    let mirrored: Vec<f64> = slip.iter().rev().chain(&slip).copied().collect();
    let (own, all) = (
        dense(&half.stiffness()) * flat(&field(&slip)),
        dense(&whole.stiffness()) * flat(&field(&mirrored)),
    );
    for i in 0..20 {
        for of_whole in [all[20 + i], all[19 - i]] {
            assert!((own[i] - of_whole).abs() <= 1e-14 * all.amax());
        }
    }
    Ok(())
}
