//! Products of several planes are those of their matrices, and allocate nothing.

use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_bie::{FaultSystem, KernelError, Placement, PlaneFault, SystemKernel};
use stickslip_solvers::{Matrix, Operator};

use super::{at, dense, dense_normal, plane, raked};
use crate::Outcome;
use crate::operators::numbers;
use crate::planes::{cells, flat};

fn field<const C: usize>(seed: u64, count: usize) -> Vec<SVector<f64, C>> {
    let numbers = numbers(seed, C * count);
    let blocks = numbers.chunks_exact(C);
    blocks.map(SVector::from_column_slice).collect()
}

/// Products against the dense matrix, to rounding of its largest entry.
fn check<const C: usize>(system: &FaultSystem<C>, seed: u64) -> Result<(), TestCaseError> {
    let count = system.vertex_count();
    let (stiffness, damping) = (system.stiffness(), system.radiation_damping());
    let mut sum = SystemKernel::combination(&[(0.3, &stiffness), (2.0, &damping)]);
    let expected = dense(&stiffness) * 0.3 + dense(&damping) * 2.0;
    prop_assert!((dense(&sum) - &expected).amax() <= 4.0 * f64::EPSILON * expected.amax());
    sum.set_combination(&[(-1.5, &damping), (0.7, &stiffness), (0.1, &stiffness)]);
    sum.add_to_diagonal(count / 2, &SMatrix::from_diagonal_element(1e9));
    let (x, start) = (field::<C>(seed, count), field::<C>(seed ^ 1, count));
    for kernel in [&stiffness, &damping, &sum, &sum.clone()] {
        prop_assert_eq!(kernel.vertex_count(), count);
        let (matrix, mut y) = (dense(kernel), start.clone());
        let bound = 1e-12 * matrix.amax() + 1e-12;
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
        let some: Vec<_> = (0..count).filter(|i| i % 3 == 1).collect();
        let mut products = vec![SVector::zeros(); some.len()];
        kernel.products_at(&some, &x, &mut products);
        for (product, &i) in products.iter().zip(&some) {
            prop_assert!((product - exact.fixed_rows::<C>(C * i)).amax() <= bound);
        }
    }
    let normal = system.normal_stiffness().clone();
    prop_assert_eq!(normal.vertex_count(), count);
    let mut stress = vec![1.0; count];
    normal.multiply_add(3.0, &x, &mut stress);
    let exact = dense_normal(system) * flat(&x) * 3.0;
    let bound = 1e-12 * dense(&stiffness).amax() / system.area(0);
    for (stress, exact) in stress.iter().zip(&exact) {
        prop_assert!((stress - 1.0 - exact).abs() <= bound + 1e-12);
    }
    Ok(())
}

/// Planes whose cells are of any number.
fn sized(
    counts: [[usize; 2]; 3],
    strike: f64,
    dip: f64,
) -> Result<Vec<(PlaneFault, Placement)>, KernelError> {
    let [first, second, third] = counts.map(|counts| cells(counts, [300.0, 200.0], 0.0));
    Ok(vec![
        (plane(first?, 90.0)?, at(strike, [0.0, 0.0])),
        (plane(second?, dip)?, at(-strike, [9e3, 0.0])),
        (plane(third?, 0.5 * dip)?, at(0.3 * strike, [0.0, 2e4])),
    ])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_are_those_of_the_dense_matrix(
        counts in [[1..6_usize, 1..5_usize], [1..6_usize, 1..5_usize], [1..6_usize, 1..5_usize]],
        strike in -180.0..180.0_f64,
        dip in 10.0..90.0_f64,
        rake in -180.0..180.0_f64,
        seed in any::<u64>(),
    ) {
        let fail = |error: KernelError| TestCaseError::fail(error.to_string());
        let planes = sized(counts, strike, dip).map_err(fail)?;
        let of_rake = FaultSystem::new(raked(planes.clone(), rake).map_err(fail)?);
        check(&of_rake.map_err(fail)?, seed)?;
        check(&FaultSystem::new(planes[..2].to_vec()).map_err(fail)?, seed)?;
        check(&FaultSystem::new(planes).map_err(fail)?, seed)?;
    }
}

/// The allocations of products and sums.
fn taken<const C: usize>(system: &FaultSystem<C>) -> u64 {
    let (stiffness, damping) = (system.stiffness(), system.radiation_damping());
    let terms = [(0.5, &stiffness), (1.0, &damping)];
    let mut sum = SystemKernel::combination(&terms);
    let normal = system.normal_stiffness();
    let count = system.vertex_count();
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
    let planes = sized([[7, 5], [4, 6], [3, 3]], 20.0, 60.0)?;
    assert_eq!(taken(&FaultSystem::new(planes.clone())?), 0);
    assert_eq!(taken(&FaultSystem::new(raked(planes, 30.0)?)?), 0);
    Ok(())
}

/// A plane alone is the plane.
#[test]
fn one_plane_is_a_system() -> Outcome {
    let alone = plane(cells([5, 4], [300.0, 200.0], 0.0)?, 50.0)?;
    let system = FaultSystem::new([(alone.clone(), at(12.0, [3.0, 4.0]))])?;
    let expected = crate::planes::dense(&alone.stiffness());
    assert_eq!(dense(&system.stiffness()), expected);
    check(&system, 5).map_err(|error| error.to_string())?;
    Ok(())
}

/// Clones and all stiffnesses of a system have one interaction.
#[test]
fn clones_share_their_numbers() -> Outcome {
    let planes = sized([[30, 20], [30, 20], [2, 2]], 20.0, 60.0)?;
    let system = FaultSystem::new(planes)?;
    let first = (system.stiffness(), system.normal_stiffness());
    let taken = allocation_counter::measure(|| {
        let again = system.clone();
        drop((again.stiffness(), first.0.clone(), first.1.clone()));
    });
    let shared = 2 * 600 * 600 * 4 * 8;
    assert!(taken.bytes_max < shared / 4, "{} {shared}", taken.bytes_max);
    Ok(())
}

/// `mu/(2 c_s)` times the area of each cell.
#[test]
fn waves_are_radiated() -> Outcome {
    let system = FaultSystem::new(super::planes(0.0)?)?;
    let eta = 0.5 * crate::MEDIUM.shear_modulus / crate::MEDIUM.shear_wave_speed;
    for (damping, factor) in [
        (system.radiation_damping(), 1.0),
        (system.radiation_damping_times(4.0)?, 4.0),
    ] {
        for vertex in 0..system.vertex_count() {
            let exact = factor * eta * system.area(vertex);
            let block = damping.diagonal_block(vertex);
            assert!((block - SMatrix::from_diagonal_element(exact)).amax() < 1e-14 * exact);
        }
        let matrix = dense(&damping);
        assert!(matrix.clone().lower_triangle() == matrix.upper_triangle());
    }
    Ok(())
}

/// Stress rates load the cells of each plane as those of the plane alone.
#[test]
fn stress_rates_are_those_of_the_planes() -> Outcome {
    let planes = super::planes(0.0)?;
    let system = FaultSystem::new(planes.clone())?;
    let rates = field::<2>(3, system.vertex_count());
    let mut together = field::<2>(5, rates.len());
    let mut alone = together.clone();
    system.stress_rates(&rates)?(7.0, &mut together);
    for (number, (plane, _)) in planes.iter().enumerate() {
        let own = system.vertices(number);
        plane.stress_rates(&rates[own.clone()])?(7.0, &mut alone[own]);
    }
    assert_eq!(together, alone);
    assert!(system.stress_rates(&rates[1..]).is_err());
    Ok(())
}
