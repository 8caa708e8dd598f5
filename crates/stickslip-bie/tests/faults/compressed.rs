//! Faults of segments and of triangles with an approximation of their interaction.

use std::f64::consts::PI;

use nalgebra::{SVector, Vector1, Vector2};
use proptest::prelude::*;
use stickslip_bie::hmatrix::Approximation;
use stickslip_bie::{
    CellKernel, CellNormalKernel, Mode, SegmentFault, Segments, SurfaceFault, Triangles,
};
use stickslip_solvers::Matrix;

use crate::surfaces::meshes::grid;
use crate::{IN_PLANE, MEDIUM, Outcome};

/// A thrust that flattens downward, of so many cells.
fn listric(count: usize) -> Outcome<SegmentFault> {
    let whole = 40e3;
    let dip = |distance: f64| 60.0 - 30.0 * distance / whole;
    let cells = Segments::by_dip([0.0; 2], whole, whole / count as f64, dip)?;
    Ok(SegmentFault::half_space(cells, MEDIUM, IN_PLANE)?)
}

/// A surface with waves, of so many squares.
fn wavy(counts: [usize; 2], height: f64) -> Outcome<SurfaceFault> {
    let (points, triangles) = grid(counts, |[x, y]| {
        [x, -0.5 * y + height * (0.7 * x).sin() * (0.5 * y).cos(), -y]
    });
    Ok(SurfaceFault::half_space(
        Triangles::new(&points, &triangles)?,
        MEDIUM,
        0.25,
    )?)
}

fn noise<const C: usize>(count: usize) -> Vec<SVector<f64, C>> {
    let value = |k: usize| (12.9898 * (k as f64 + 1.0)).sin() * 43758.5453 % 1.0;
    (0..count)
        .map(|k| SVector::from_fn(|c, _| value(C * k + c)))
        .collect()
}

/// The errors of forces and of normal stresses, over the largest.
fn errors<const C: usize>(
    kernels: [&CellKernel<C>; 2],
    normals: [&CellNormalKernel<C>; 2],
) -> [f64; 2] {
    let count = kernels[0].vertex_count();
    let slip = noise(count);
    let forces = kernels.map(|kernel| {
        let mut forces = vec![SVector::<f64, C>::zeros(); count];
        kernel.multiply_add(1.0, &slip, &mut forces);
        forces
            .into_iter()
            .flat_map(|force| force.data.0[0])
            .collect()
    });
    let stresses = normals.map(|normal| {
        let mut stress = vec![0.0; count];
        normal.multiply_add(1.0, &slip, &mut stress);
        stress
    });
    [forces, stresses].map(|[exact, found]: [Vec<f64>; 2]| {
        let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let errors = exact.iter().zip(&found).map(|(a, b)| (a - b).abs());
        errors.fold(0.0, f64::max) / largest
    })
}

#[test]
fn many_segments_are_compressed() -> Outcome {
    let fault = listric(2400)?;
    let found = fault.compression();
    assert_eq!(found.tolerance, 1e-4);
    assert!(found.stored_share() < 0.08, "{found}");
    let whole = fault
        .clone()
        .with_approximation(Approximation::default().without_far_blocks())?;
    assert_eq!(whole.compression().stored_share(), 1.0);
    let kernels = [whole.stiffness(), fault.stiffness()];
    let normals = [whole.normal_stiffness(), fault.normal_stiffness()];
    let [force, normal] = errors(kernels.each_ref(), normals.each_ref());
    assert!(force < 1e-6 && normal < 1e-5, "{force:e} {normal:e}");
    // What is stored is told as it is.
    let [near, far] =
        [(1200, 1201), (100, 2300)].map(|(i, j)| [0, 1].map(|k| kernels[k].entry(i, j)));
    assert!(
        near[0] == near[1] && (far[1] / far[0] - 1.0).abs() < 1e-2,
        "{near:?} {far:?}"
    );
    // Antiplane slip keeps no normal stress.
    let cells = fault.cells().clone();
    let antiplane = SegmentFault::half_space(cells, MEDIUM, Mode::Antiplane)?;
    assert!(2 * antiplane.compression().dense_bytes == found.dense_bytes);
    assert!(antiplane.normal_stiffness().is_zero());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn products_are_within_the_tolerance(
        columns in 8_usize..20,
        rows in 6_usize..14,
        height in 0.0..0.4,
        exponent in 2_i32..7,
        rake in -180.0..180.0,
    ) {
        let fail = |error: Box<dyn std::error::Error>| TestCaseError::fail(error.to_string());
        let tolerance = 10f64.powi(-exponent);
        let whole = wavy([columns, rows], height).map_err(fail)?;
        let fault = whole.clone().with_tolerance(tolerance).map_err(|error| fail(error.into()))?;
        prop_assert!(whole.compression().stored_share() == 1.0 && fault.compression().stored_share() <= 1.0);
        let kernels = [whole.stiffness(), fault.stiffness()];
        let normals = [whole.normal_stiffness(), fault.normal_stiffness()];
        let [force, normal] = errors(kernels.each_ref(), normals.each_ref());
        prop_assert!(force < tolerance && normal < 10.0 * tolerance, "{force:e} {normal:e}");
        let one = |fault: SurfaceFault| fault.with_rake(rake).map_err(|error| fail(error.into()));
        let (whole, fault) = (one(whole)?, one(fault)?);
        prop_assert_eq!(fault.compression().tolerance, tolerance);
        let kernels = [whole.stiffness(), fault.stiffness()];
        let normals = [whole.normal_stiffness(), fault.normal_stiffness()];
        let [force, normal] = errors(kernels.each_ref(), normals.each_ref());
        prop_assert!(force < tolerance && normal < 10.0 * tolerance, "{force:e} {normal:e}");
    }
}

/// Single rows, sums and repeated products are those of the whole product, to the bit.
#[test]
fn products_of_some_cells_have_the_same_bits() -> Outcome {
    let fault = wavy([12, 10], 0.2)?.with_tolerance(1e-5)?;
    let (kernel, normal) = (fault.stiffness(), fault.normal_stiffness());
    let (slip, other) = (noise::<2>(240), vec![Vector2::new(1.0, 0.0); 240]);
    let cells = [0, 239, 17, 100];
    let mut some = [Vector2::zeros(); 4];
    kernel.products_at(&cells, &slip, &mut some);
    let mut stress = [vec![0.0; 240], vec![0.0; 240]];
    normal.multiply_add(1.0, &slip, &mut stress[0]);
    let mut all = vec![Vector2::zeros(); 240];
    kernel.multiply_add(1.0, &other, &mut all);
    all.fill(Vector2::zeros());
    kernel.multiply_add(1.0, &slip, &mut all);
    normal.multiply_add(1.0, &slip, &mut stress[1]);
    assert!(
        cells
            .iter()
            .zip(&some)
            .all(|(&cell, product)| all[cell] == *product)
    );
    assert!(stress[0] == stress[1]);
    let taken = allocation_counter::measure(|| {
        kernel.multiply_add(1.0, &other, &mut all);
        kernel.products_at(&cells, &slip, &mut some);
        normal.multiply_add(1.0, &slip, &mut stress[1]);
        all[0][0] += kernel.quadratic(&slip);
    });
    assert_eq!(taken.count_total, 0);
    Ok(())
}

#[cfg(feature = "rayon")]
#[test]
fn products_in_threads_have_the_same_bits() -> Outcome {
    let fault =
        wavy([40, 26], 0.2)?.with_approximation(Approximation::default().in_single_precision())?;
    let slip = noise::<2>(2080);
    let in_threads = |threads: usize| -> Outcome<_> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        // Blocks, too, are made in that many threads.
        let own = fault.clone().with_tolerance(1e-4)?;
        let (mut forces, mut stress) = (vec![Vector2::zeros(); 2080], vec![0.0; 2080]);
        pool.install(|| {
            own.stiffness().multiply_add(1.0, &slip, &mut forces);
            own.normal_stiffness().multiply_add(1.0, &slip, &mut stress);
        });
        Ok((forces, stress))
    };
    let one = in_threads(1)?;
    for threads in [2, 3, 7] {
        assert!(in_threads(threads)? == one, "{threads}");
    }
    Ok(())
}

/// Products of different slips in several threads at a time do not mix.
#[test]
fn threads_share_an_interaction() -> Outcome {
    let fault = listric(300)?;
    let kernel = fault.stiffness();
    let product = |k: usize| {
        let slip: Vec<_> = (0..300)
            .map(|i| Vector1::new((PI * (i * k) as f64 / 300.0).sin()))
            .collect();
        let mut forces = vec![Vector1::zeros(); 300];
        kernel.multiply_add(1.0, &slip, &mut forces);
        forces
    };
    let alone: Vec<_> = (0..8).map(product).collect();
    let product = &product;
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|k| scope.spawn(move || (0..50).map(|_| product(k)).collect::<Vec<_>>()))
            .collect();
        for (found, alone) in threads.into_iter().zip(&alone) {
            let found = found.join().unwrap_or_default();
            assert!(found.len() == 50 && found.iter().all(|forces| forces == alone));
        }
    });
    Ok(())
}
