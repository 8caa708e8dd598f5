//! Products are those of the matrices.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use stickslip_bie::{CellKernel, FaultGeometry, SegmentFault, Segments};
use stickslip_solvers::{Matrix, NormalStressChange, Operator};

use crate::{IN_PLANE, MEDIUM, Outcome, field, flat};

fn fault(count: usize, bend: f64) -> Outcome<SegmentFault> {
    let whole = 10e3;
    let dip = |distance: f64| 70.0 - bend * distance / whole;
    let segments = Segments::by_dip([0.0; 2], whole, whole / count as f64, dip)?;
    Ok(SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_are_dense_sums(
        bend in -10.0..60.0,
        slip in prop::collection::vec(-1.0..1.0, 1..60),
    ) {
        let fault = fault(slip.len(), bend).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let (slip, count) = (field(&slip), slip.len());
        let (kernel, damping) = (fault.stiffness(), fault.radiation_damping());
        let mut sum = CellKernel::combination(&[(0.5, &kernel), (1.0, &damping)]);
        sum.set_combination(&[(2.0, &damping), (3.0, &kernel), (-1.0, &kernel)]);
        sum.add_to_diagonal(count - 1, &nalgebra::Matrix1::new(7.0));
        let stiffness = DMatrix::from(&kernel);
        let mut of_sum = &stiffness * 2.0 + DMatrix::from(&damping) * 2.0;
        of_sum[(count - 1, count - 1)] += 7.0;
        prop_assert_eq!(sum.mesh(), Some(fault.cells().identity()));
        let bound = 1e-12 * stiffness.amax() * count as f64;
        for (kernel, matrix) in [(&kernel, &stiffness), (&sum, &of_sum)] {
            let exact = matrix * flat(&slip);
            let mut force = field(&vec![0.0; count]);
            kernel.multiply_add(-2.0, &slip, &mut force);
            prop_assert!((flat(&force) + &exact * 2.0).amax() <= bound);
            prop_assert!((kernel.quadratic(&slip) - flat(&slip).dot(&exact)).abs() <= bound * count as f64);
            prop_assert!((DMatrix::from(kernel) - matrix).amax() <= bound);
            prop_assert!((kernel.product_at(count / 2, &slip)[0] - exact[count / 2]).abs() <= bound);
            prop_assert!((kernel.diagonal_block(0)[(0, 0)] - matrix[(0, 0)]).abs() <= bound);
        }
        let normal = fault.normal_stiffness();
        let mut stress = vec![0.0; count];
        NormalStressChange::add(&normal, 3.0, &slip, &mut stress);
        let exact = DMatrix::from(&normal) * flat(&slip) * 3.0;
        prop_assert!((DVector::from(stress) - exact).amax() * 10e3 <= 3.0 * bound * count as f64);
    }
}

#[test]
fn products_and_sums_take_no_memory() -> Outcome {
    let count = 40;
    let fault = fault(count, 30.0)?;
    let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
    let normal = fault.normal_stiffness();
    let terms = [(0.5, &stiffness), (1.0, &damping)];
    let mut sum = CellKernel::combination(&terms);
    let (x, mut y) = (field(&vec![1.0; count]), field(&vec![0.0; count]));
    let mut stress = vec![0.0; count];
    let taken = allocation_counter::measure(|| {
        sum.set_combination(&terms);
        sum.multiply_add(1.0, &x, &mut y);
        normal.multiply_add(1.0, &x, &mut stress);
        y[0][0] += sum.quadratic(&x) + sum.product_at(0, &x)[0];
    });
    assert_eq!(taken.count_total, 0);
    Ok(())
}

/// As a scene sees it.
#[test]
fn a_fault_of_segments_is_a_fault_geometry() -> Outcome {
    let fault = fault(20, 30.0)?;
    let cells = FaultGeometry::cells(&fault);
    assert_eq!((cells.areas.len(), cells.dimension), (20, 2));
    assert_eq!(cells.identity, Some(fault.cells().identity()));
    assert!(fault.normal_stress_change().is_some());
    let damping = DMatrix::from(&fault.radiation_damping_times(2.0)?);
    let each = MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * fault.cells().length(3);
    assert!((damping[(3, 3)] / each - 1.0).abs() < 1e-14 && damping[(3, 4)] == 0.0);
    let section = fault.section(|[_, z]| z > -5e3)?;
    assert!(section.map(|[_, z]| z).iter().all(|&z| z > -5e3) && section.vertices().len() < 20);
    // Another curve of as many cells is another fault.
    assert_ne!(
        self::fault(20, 31.0)?.cells().identity(),
        fault.cells().identity()
    );
    Ok(())
}
