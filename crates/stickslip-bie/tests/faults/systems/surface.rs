//! Planes and a surface of triangles in one half space.

use nalgebra::{DMatrix, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_bie::{
    FaultGeometry, FaultSystem, Placement, PlaneFault, Receivers, SurfaceFault, SystemKernel,
    Triangles,
};
use stickslip_solvers::{Matrix, Operator};

use super::{at, dense, dense_normal, plane, planes, raked};
use crate::operators::numbers;
use crate::planes::{POISSON, cells, flat};
use crate::surfaces::meshes::grid;
use crate::{MEDIUM, Outcome};

/// A curved sheet 4 km away from the planes.
fn sheet(counts: [usize; 2], shift: f64) -> Outcome<SurfaceFault> {
    let (points, triangles) = grid(counts, |[x, y]| {
        [
            4e3 + 30.0 * x * x - 100.0 * y,
            300.0 * x + shift,
            -250.0 * y,
        ]
    });
    let cells = Triangles::new(&points, &triangles)?;
    Ok(SurfaceFault::half_space(cells, MEDIUM, POISSON)?)
}

/// A plane as triangles, two for each cell, with the axes of its strike.
fn as_triangles(plane: &PlaneFault, place: Placement, parts: usize) -> Outcome<SurfaceFault> {
    let (cells, dip) = (plane.cells(), plane.dip().ok_or("no dip")?.to_radians());
    let (along, down) = (cells.along_strike(), cells.down_dip());
    let counts = [along.count() * parts, down.count() * parts];
    let (sin, cos) = place.strike.to_radians().sin_cos();
    let (points, triangles) = grid(counts, |[x, y]| {
        let x = along.ends()[0] + x * along.length() / parts as f64;
        let y = down.ends()[0] + y * down.length() / parts as f64;
        let [east, north] = place.origin;
        // Dip to the right of strike.
        let right = y * dip.cos();
        [
            east + x * sin + right * cos,
            north + x * cos - right * sin,
            -y * dip.sin(),
        ]
    });
    let cells = Triangles::new(&points, &triangles)?;
    Ok(SurfaceFault::half_space(cells, MEDIUM, POISSON)?.without_correction())
}

fn field<const C: usize>(seed: u64, count: usize) -> Vec<SVector<f64, C>> {
    let numbers = numbers(seed, C * count);
    numbers
        .chunks_exact(C)
        .map(SVector::from_column_slice)
        .collect()
}

fn check<const C: usize>(system: &FaultSystem<C>) -> Outcome {
    let count = system.vertex_count();
    let (stiffness, damping) = (system.stiffness(), system.radiation_damping_times(2.0)?);
    let mut sum = SystemKernel::combination(&[(0.3, &stiffness), (2.0, &damping)]);
    let expected = dense(&stiffness) * 0.3 + dense(&damping) * 2.0;
    assert!((dense(&sum) - &expected).amax() <= 4.0 * f64::EPSILON * expected.amax());
    sum.set_combination(&[(-1.5, &damping), (0.7, &stiffness), (0.1, &stiffness)]);
    sum.add_to_diagonal(count - 1, &SMatrix::from_diagonal_element(1e9));
    let (x, start) = (field::<C>(5, count), field::<C>(6, count));
    for kernel in [&stiffness, &damping, &sum, &sum.clone()] {
        let (matrix, mut y) = (dense(kernel), start.clone());
        let bound = 1e-12 * matrix.amax();
        kernel.multiply_add(-2.0, &x, &mut y);
        let exact = &matrix * flat(&x);
        assert!((flat(&y) - flat(&start) + &exact * 2.0).amax() <= bound);
        assert!((kernel.quadratic(&x) - flat(&x).dot(&exact)).abs() <= bound * count as f64);
        for i in [0, count / 2, count - 1] {
            assert!((kernel.product_at(i, &x) - exact.fixed_rows::<C>(C * i)).amax() <= bound);
            let block = matrix.fixed_view::<C, C>(C * i, C * i);
            assert!((kernel.diagonal_block(i) - block).amax() <= bound);
        }
        let some: Vec<_> = (0..count).filter(|i| i % 3 == 1).collect();
        let mut products = vec![SVector::zeros(); some.len()];
        kernel.products_at(&some, &x, &mut products);
        for (product, &i) in products.iter().zip(&some) {
            assert!((product - exact.fixed_rows::<C>(C * i)).amax() <= bound);
        }
    }
    let mut stress = vec![1.0; count];
    system
        .normal_stiffness()
        .clone()
        .multiply_add(3.0, &x, &mut stress);
    let exact = dense_normal(system) * flat(&x) * 3.0;
    let bound = 1e-12 * dense(&stiffness).amax() / system.area(0);
    assert!(
        stress
            .iter()
            .zip(&exact)
            .all(|(stress, exact)| (stress - 1.0 - exact).abs() <= bound)
    );
    let mut y = start;
    let taken = allocation_counter::measure(|| {
        sum.set_combination(&[(0.5, &stiffness), (1.0, &damping)]);
        sum.multiply_add(1.0, &x, &mut y);
        y[0][0] += sum.quadratic(&x);
    });
    assert_eq!(taken.count_total, 0);
    Ok(())
}

#[test]
fn products_are_those_of_the_matrix() -> Outcome {
    let system = FaultSystem::new(planes(0.0)?)?.with_surface(sheet([4, 3], 0.0)?)?;
    assert_eq!(
        system.vertices_of_surface(),
        system.vertex_count() - 24..system.vertex_count()
    );
    check(&system)?;
    let one = FaultSystem::new(raked(planes(0.0)?, 30.0)?)?;
    let one = one.with_surface(sheet([4, 3], 0.0)?.with_rake(100.0)?)?;
    check(&one)?;
    // Planes and the surface by themselves keep their numbers.
    let count = system.vertices_of_surface().start;
    let alone = dense(&FaultSystem::new(planes(0.0)?)?.stiffness());
    let with = dense(&system.stiffness());
    assert!(with.view((0, 0), (2 * count, 2 * count)) == alone);
    let own = DMatrix::from(&sheet([4, 3], 0.0)?.stiffness());
    assert!(with.view((2 * count, 2 * count), (48, 48)) == own);
    // As a scene sees it.
    let seen = FaultGeometry::cells(&system);
    assert_eq!(
        (seen.areas.len(), seen.identity),
        (count + 24, Some(system.identity()))
    );
    let section = system.section_of_surface(|[_, _, z]| z > -400.0)?;
    assert!(
        section
            .vertices()
            .iter()
            .all(|&k| k >= count && system.center(k)[2] > -400.0)
    );
    assert_eq!(section.identity(), system.identity());
    let rates = system.along([0.0, 1e-9, 0.0]);
    assert!(system.back_slip(&rates).is_ok() && rates.len() == count + 24);
    assert!(system.plate_loading(&[SVector::zeros(); 3]).is_err());
    Ok(())
}

/// Off the fault, cells of planes and of the surface add up.
#[test]
fn receivers_see_planes_and_the_surface() -> Outcome {
    let system = FaultSystem::new(planes(0.0)?)?.with_surface(sheet([4, 3], 0.0)?)?;
    let points = [[1e3, 2e3, 0.0], [6e3, -500.0, -3e3]];
    let slip = field::<2>(9, system.vertex_count());
    let first = system.vertices_of_surface().start;
    let both = Receivers::new(&system, &points)?.displacement(&slip)?;
    let of_planes = Receivers::new(&FaultSystem::new(planes(0.0)?)?, &points)?;
    let of_surface = Receivers::new(&sheet([4, 3], 0.0)?, &points)?;
    let [of_planes, of_surface] = [
        of_planes.displacement(&slip[..first])?,
        of_surface.displacement(&slip[first..])?,
    ];
    for k in 0..2 {
        for c in 0..3 {
            let sum = of_planes[k][c] + of_surface[k][c];
            assert!((both[k][c] - sum).abs() < 1e-12, "{k} {c}");
        }
    }
    Ok(())
}

/// Another surface makes another interaction, though both systems come from one.
#[test]
fn clones_have_their_own_surfaces() -> Outcome {
    let planes = FaultSystem::new(planes(0.0)?)?;
    let first = planes.clone().with_surface(sheet([2, 2], 0.0)?)?;
    let numbers = dense(&first.stiffness());
    let second = planes.with_surface(sheet([2, 2], 1e3)?)?;
    assert!(dense(&second.stiffness()) != numbers && first.identity() != second.identity());
    assert!(dense(&first.stiffness()) == numbers);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// A plane replaced by its triangles does the same to others, and others to it, as its cells get small: it is the
    /// same slip exactly as source, and the centres of both triangles of a cell average the centre of the cell.
    #[test]
    fn triangles_of_a_plane_are_the_plane(
        strike in -180.0..180.0_f64,
        dip in 20.0..90.0_f64,
        along in prop::array::uniform2(-1.0..1.0_f64),
    ) {
        let fail = |error: Box<dyn std::error::Error>| TestCaseError::fail(error.to_string());
        let own = plane(cells([3, 2], [300.0, 200.0], 100.0).map_err(|error| fail(error.into()))?, 70.0).map_err(|error| fail(error.into()))?;
        let other = plane(cells([3, 2], [100.0, 100.0], 200.0).map_err(|error| fail(error.into()))?, dip).map_err(|error| fail(error.into()))?;
        let places = [at(0.0, [0.0, 0.0]), at(strike, [5e3 * along[0] + 8e3, 5e3 * along[1]])];
        let both = FaultSystem::new([(own.clone(), places[0]), (other.clone(), places[1])]).map_err(|error| fail(error.into()))?;
        let triangles = as_triangles(&other, places[1], 1).map_err(fail)?;
        let system = FaultSystem::new([(own, places[0])]).map(|system| system.with_surface(triangles));
        let system = system.map_err(|error| fail(error.into()))?.map_err(|error| fail(error.into()))?;
        // Uniform slip of the second one.
        let slip = SVector::from(along);
        let (mut of_planes, mut of_triangles) = (vec![SVector::zeros(); 12], vec![SVector::zeros(); 18]);
        of_planes[6..].fill(slip);
        of_triangles[6..].fill(slip);
        let forces = [(both.stiffness(), of_planes), (system.stiffness(), of_triangles)].map(|(kernel, slip)| {
            let mut forces = vec![SVector::<f64, 2>::zeros(); slip.len()];
            kernel.multiply_add(1.0, &slip, &mut forces);
            forces
        });
        let largest = forces[0][..6].iter().map(|force| force.norm()).fold(0.0, f64::max);
        for cell in 0..6 {
            let error = (forces[0][cell] - forces[1][cell]).norm();
            prop_assert!(error <= 1e-9 * largest, "{cell}: {error:e} of {largest:e}");
        }
        // Uniform slip of the first.
        let forces = [(both.stiffness(), 12), (system.stiffness(), 18)].map(|(kernel, count)| {
            let mut motion = vec![SVector::zeros(); count];
            motion[..6].fill(slip);
            let mut forces = vec![SVector::<f64, 2>::zeros(); count];
            kernel.multiply_add(1.0, &motion, &mut forces);
            forces
        });
        let largest = forces[0][6..].iter().map(|force| force.norm()).fold(0.0, f64::max);
        for cell in 0..6 {
            let pair = forces[1][6 + 2 * cell] + forces[1][7 + 2 * cell];
            let error = (forces[0][6 + cell] - pair).norm();
            // Of second order in cells of 100 m, 2 km away at least.
            prop_assert!(error <= 1e-2 * largest, "{cell}: {error:e} of {largest:e}");
        }
    }
}

#[test]
fn surfaces_of_no_system_are_refused() -> Outcome {
    let system = || -> Outcome<_> { Ok(FaultSystem::new(planes(0.0)?)?) };
    let message = |surface: SurfaceFault| -> Outcome<String> {
        Ok(system()?
            .with_surface(surface)
            .err()
            .ok_or("accepted")?
            .to_string())
    };
    let whole = SurfaceFault::whole_space(sheet([2, 2], 0.0)?.cells().clone(), MEDIUM, POISSON)?;
    assert!(message(whole)?.contains("free surfaces"));
    let soft = SurfaceFault::half_space(sheet([2, 2], 0.0)?.cells().clone(), MEDIUM, 0.3)?;
    assert!(
        message(soft)?
            .starts_with("Poisson's ratio of triangles beside planes must be that of the planes,")
    );
    // Across the first plane, which strikes to the north at x = 100.
    let (points, triangles) = grid([3, 3], |[x, y]| {
        [400.0 * x - 500.0, 30.0, -300.0 * y - 20.0]
    });
    let across = SurfaceFault::half_space(Triangles::new(&points, &triangles)?, MEDIUM, POISSON)?;
    let found = message(across)?;
    assert!(
        found.starts_with("triangle ") && found.contains(" of plane 0 cross or cover each other"),
        "{found}"
    );
    let two = system()?
        .with_surface(sheet([2, 2], 0.0)?)?
        .with_surface(sheet([2, 2], 5e3)?);
    assert!(
        two.err()
            .ok_or("accepted")?
            .to_string()
            .contains("one may have several sheets")
    );
    assert!(system()?.section_of_surface(|_| true).is_err());
    Ok(())
}
