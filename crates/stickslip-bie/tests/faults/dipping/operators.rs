//! Products are those of the matrices.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use stickslip_bie::{Cells, DippingFault, DippingKernel, KernelError};
use stickslip_solvers::{Matrix, Operator};

use super::{matrices, thrust};
use crate::{Outcome, field, flat};

/// Products are those of the dense sums, to 1e-9 of the largest entry times the largest slip; so are sums of operators.
fn products_are_dense_sums(fault: &DippingFault, slip: &[f64]) -> Result<(), TestCaseError> {
    let [stiffness, normal] = matrices(fault);
    let (slip, count) = (field(slip), slip.len());
    let bound = 1e-9 * stiffness.amax();
    let (kernel, damping) = (fault.stiffness(), fault.radiation_damping());
    let mut sum = DippingKernel::combination(&[(0.5, &kernel), (1.0, &damping)]);
    sum.set_combination(&[(2.0, &damping), (3.0, &kernel), (-1.0, &kernel)]);
    let of_sum = &stiffness * 2.0 + DMatrix::from(&damping) * 2.0;
    for (kernel, matrix) in [(&kernel, &stiffness), (&sum, &of_sum)] {
        let exact = matrix * flat(&slip);
        let mut force = field(&vec![0.0; count]);
        kernel.multiply_add(-2.0, &slip, &mut force);
        prop_assert!((flat(&force) + &exact * 2.0).amax() <= 3.0 * bound);
        let energy = flat(&slip).dot(&exact);
        prop_assert!((kernel.quadratic(&slip) - energy).abs() <= 3.0 * bound * count as f64);
        prop_assert!((DMatrix::from(kernel) - matrix).amax() <= 3.0 * bound);
        for i in [0, count / 2, count - 1] {
            prop_assert!((kernel.product_at(i, &slip)[0] - exact[i]).abs() <= 3.0 * bound);
            let diagonal = kernel.diagonal_block(i)[(0, 0)];
            prop_assert!((diagonal - matrix[(i, i)]).abs() <= 3.0 * bound);
        }
    }
    let (of_normal, exact) = (fault.normal_stiffness(), &normal * flat(&slip));
    let mut stress = vec![0.0; count];
    let length = fault.cells().length();
    of_normal.multiply_add(3.0 * length, &slip, &mut stress);
    prop_assert!((DVector::from(stress) - &exact * 3.0).amax() <= 3.0 * bound);
    prop_assert!((DMatrix::from(&of_normal) * length - &normal).amax() <= bound);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_faults_multiply_as_their_matrices(
        dip in prop_oneof![3.0..90.0, Just(90.0)],
        begin in prop_oneof![Just(0.0), 1.0..3e3],
        slip in prop::collection::vec(-1.0..1.0, 1..260),
    ) {
        let cells = Cells::new([begin, 10e3], slip.len()).map_err(failed)?;
        products_are_dense_sums(&thrust(cells, dip).map_err(failed)?, &slip)?;
    }
}

fn failed(error: KernelError) -> TestCaseError {
    TestCaseError::fail(error.to_string())
}

/// With images of low rank, and dense ones.
#[test]
fn products_and_sums_take_no_memory() -> Outcome {
    for (count, dip) in [(150, 60.0), (12, 20.0)] {
        let fault = thrust(Cells::new([0.0, 5e3], count)?, dip)?;
        let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
        let normal = fault.normal_stiffness();
        let terms = [(0.5, &stiffness), (1.0, &damping)];
        let mut sum = DippingKernel::combination(&terms);
        let (x, mut y) = (field(&vec![1.0; count]), field(&vec![0.0; count]));
        let mut stress = vec![0.0; count];
        let taken = allocation_counter::measure(|| {
            sum.set_combination(&terms);
            sum.multiply_add(1.0, &x, &mut y);
            normal.multiply_add(1.0, &x, &mut stress);
            y[0][0] += sum.quadratic(&x) + sum.norm(&x) + sum.product_at(0, &x)[0];
        });
        assert_eq!(taken.count_total, 0);
    }
    Ok(())
}
