//! Planes in a half space.

use std::f64::consts::PI;

use nalgebra::{Vector1, Vector2};
use stickslip_bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip_solvers::Matrix;

use super::{POISSON, cells, dense};
use crate::{MEDIUM, Outcome};

/// Vertical, 10 km x 10 km, centred at 10 km: by an independent program.
#[test]
fn a_patch_relieves_itself() -> Outcome {
    let rock = Medium {
        shear_modulus: 32.04e9,
        ..MEDIUM
    };
    let patch = PlaneFault::half_space(cells([1, 1], [1e4, 1e4], 5e3)?, 90.0, rock, POISSON)?;
    let stress = patch.stiffness().diagonal_block(0)[(0, 0)] / 1e8;
    assert!((stress / 3.309_041_65e6 - 1.0).abs() < 1e-8, "{stress:e}");
    Ok(())
}

/// Entries are the tractions of the stress of a cell at the centres of others.
#[test]
fn entries_are_stresses_of_cells() -> Outcome {
    for (dip, begin) in [(90.0_f64, 0.0), (60.0, 0.0), (30.0, 100.0), (5.0, 0.0)] {
        let rectangles = cells([5, 4], [300.0, 200.0], begin)?;
        let fault = PlaneFault::half_space(rectangles, dip, MEDIUM, POISSON)?;
        let (matrix, normal_stiffness) = (dense(&fault.stiffness()), fault.normal_stiffness());
        let (sin, cos) = if dip == 90.0 {
            (1.0, 0.0)
        } else {
            dip.to_radians().sin_cos()
        };
        let normal = nalgebra::Vector3::new(0.0, -sin, cos);
        let axes = [
            nalgebra::Vector3::new(1.0, 0.0, 0.0),
            nalgebra::Vector3::new(0.0, cos, sin),
        ];
        let largest = matrix.amax();
        for (i, j) in (0..20).flat_map(|i| (0..20).map(move |j| (i, j))) {
            let of_cell = fault.dislocation(j).ok_or("no rectangle")?;
            let [x, y] = rectangles.center(i);
            let [[column, row], [of_column, of_row]] =
                [i, j].map(|cell| rectangles.column_and_row(cell));
            let neighbours = column.abs_diff(of_column) == 1 && row.abs_diff(of_row) == 1;
            for (from, slip) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let stress = of_cell.stress(slip, [x, -y * cos, -y * sin]);
                let traction = stress * normal;
                for (to, axis) in axes.iter().enumerate() {
                    // The cross term of diagonal neighbours is corrected.
                    if to != from && neighbours {
                        continue;
                    }
                    let exact = -traction.dot(axis) * rectangles.area();
                    let error = (matrix[(2 * i + to, 2 * j + from)] - exact).abs() / largest;
                    assert!(error < 1e-12, "{dip} {i} {j} {to} {from}: {error:e}");
                }
                let error = (normal_stiffness.entry(i, j)[from] + traction.dot(&normal)).abs();
                let error = error * rectangles.area() / largest;
                assert!(error < 1e-12, "{dip} {i} {j}: normal {error:e}");
            }
        }
    }
    Ok(())
}

/// Far below the surface nothing is left of it; the image decays with the cube of the distance.
#[test]
fn deep_planes_are_in_a_whole_space() -> Outcome {
    let deep = 1e6;
    for dip in [90.0, 60.0, 30.0] {
        let cells = cells([4, 3], [300.0, 200.0], deep)?;
        let half = PlaneFault::half_space(cells, dip, MEDIUM, POISSON)?;
        let whole = PlaneFault::whole_space(cells, MEDIUM, POISSON)?;
        let (half_matrix, whole) = (dense(&half.stiffness()), dense(&whole.stiffness()));
        let error = (&half_matrix - &whole).amax() / whole.amax();
        assert!(error < 1e-10, "{dip}: {error:e}");
        let normal = half.normal_stiffness();
        for (i, j) in [(0, 0), (3, 11), (11, 3)] {
            assert!(normal.entry(i, j).amax() * cells.area() < 1e-10 * whole.amax());
        }
    }
    Ok(())
}

/// Slip of a vertical plane does not change its normal stress.
#[test]
fn vertical_planes_keep_their_normal_stress() -> Outcome {
    let cells = cells([4, 3], [300.0, 200.0], 0.0)?;
    let fault = PlaneFault::half_space(cells, 90.0, MEDIUM, POISSON)?;
    assert!(fault.normal_stiffness().is_zero());
    for (cell, slip) in [(0, [1.0, 0.0]), (5, [0.0, 1.0])] {
        let patch = fault.dislocation(cell).ok_or("no rectangle")?;
        for i in 0..cells.count() {
            let [x, y] = cells.center(i);
            let tension = patch.stress(slip, [x, 0.0, -y])[(1, 1)];
            assert!(
                tension.abs() < 1e-13 * MEDIUM.shear_modulus / 200.0,
                "{i}: {tension:e}"
            );
        }
    }
    // The limit of planes that hardly dip from it.
    let tilted = PlaneFault::half_space(cells, 89.9999, MEDIUM, POISSON)?.normal_stiffness();
    let largest = (0..12)
        .map(|i| tilted.entry(i, 5).amax())
        .fold(0.0, f64::max);
    assert!(
        largest < 1e-5 * MEDIUM.shear_modulus / 200.0 && largest > 0.0,
        "{largest:e}"
    );
    Ok(())
}

/// Long cells at the surface, dip slip: `mu/h` times numbers of plane strain, by an independent program of complex
/// potentials. Thrust slip is clamped less at its own cell.
#[test]
fn long_dipping_cells_are_lines() -> Outcome {
    for (dip, shear, normal) in [
        (90.0, Some(0.5030), 0.0),
        (60.0, None, -0.01286),
        (30.0, None, -0.16336),
    ] {
        let cells = cells([1, 3], [1e5, 1.0], 0.0)?;
        let fault = PlaneFault::half_space(cells, dip, MEDIUM, POISSON)?.with_rake(90.0)?;
        let scale = MEDIUM.shear_modulus;
        let found = fault.normal_stiffness().entry(0, 0)[0] / scale;
        assert!((found - normal).abs() < 1e-5, "{dip}: {found}");
        if let Some(shear) = shear {
            let own = fault.stiffness().diagonal_block(0)[(0, 0)] / scale / cells.area();
            assert!((own - shear).abs() < 1e-4, "{dip}: {own}");
        }
        // Normal slip has the other sign, of the normal stress alone.
        let reverse = PlaneFault::half_space(cells, dip, MEDIUM, POISSON)?.with_rake(-90.0)?;
        assert_eq!(
            reverse.normal_stiffness().entry(0, 0),
            -fault.normal_stiffness().entry(0, 0)
        );
        assert_eq!(dense(&reverse.stiffness()), dense(&fault.stiffness()));
    }
    Ok(())
}

/// `tau = (mu/(2 pi (1 - nu))) [-1/(s - c) + 1/(s + c) + 2c/(s + c)^2 - 4c^2/(s + c)^3]` of an end at `c`, upper less
/// lower, of dip slip on a vertical line; antiplane images along strike.
#[test]
fn long_vertical_cells_are_lines() -> Outcome {
    let rows = 6;
    let cells = cells([1, rows], [1e5, 1.0], 0.0)?;
    let fault = PlaneFault::half_space(cells, 90.0, MEDIUM, POISSON)?;
    let matrix = dense(&fault.stiffness()) / (cells.area() * MEDIUM.shear_modulus / (2.0 * PI));
    let in_plane = |s: f64, c: f64| {
        let sum = s + c;
        -1.0 / (s - c) + 1.0 / sum + 2.0 * c / sum.powi(2) - 4.0 * c * c / sum.powi(3)
    };
    let antiplane = |s: f64, c: f64| -1.0 / (s - c) + -1.0 / (-s - c);
    for (i, j) in (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let (s, upper, lower) = (i as f64 + 0.5, j as f64, j as f64 + 1.0);
        let exact = -(in_plane(s, upper) - in_plane(s, lower)) / (1.0 - POISSON);
        let found = matrix[(2 * i + 1, 2 * j + 1)];
        assert!((found - exact).abs() < 1e-8, "{i} {j}: {found} {exact}");
        let exact = antiplane(s, lower) - antiplane(s, upper);
        let found = matrix[(2 * i, 2 * j)];
        assert!((found - exact).abs() < 1e-8, "{i} {j}: {found} {exact}");
    }
    Ok(())
}

/// Cells that slip alike are one rectangle, which plate loading is the stress of, with the other sign: what creeps
/// beyond is all the plane, which causes no stress.
#[test]
fn plates_load_what_does_not_follow() -> Outcome {
    let (rate, time) = (1e-9, 1e7);
    for dip in [90.0, 45.0] {
        let rectangles = cells([9, 7], [300.0, 200.0], 0.0)?;
        let fault = PlaneFault::half_space(rectangles, dip, MEDIUM, POISSON)?.with_rake(0.0)?;
        let mut load = vec![Vector1::zeros(); rectangles.count()];
        fault.plate_loading(Vector1::new(rate))?(time, &mut load);
        let whole = Rectangles::new(
            Cells::new(rectangles.along_strike().ends(), 1)?,
            Cells::new(rectangles.down_dip().ends(), 1)?,
        );
        let all = PlaneFault::half_space(whole, dip, MEDIUM, POISSON)?;
        let all = all.dislocation(0).ok_or("no rectangle")?;
        let (sin, cos) = if dip == 90.0 {
            (1.0, 0.0)
        } else {
            45f64.to_radians().sin_cos()
        };
        for (i, load) in load.iter().enumerate() {
            let [x, y] = rectangles.center(i);
            let stress = all.stress([rate * time, 0.0], [x, -y * cos, -y * sin]);
            let shear = -sin * stress[(0, 1)] + cos * stress[(0, 2)];
            let error = load[0] / rectangles.area() + shear;
            assert!(
                error.abs() < 1e-12 * MEDIUM.shear_modulus * rate * time,
                "{i}: {error:e}"
            );
        }
        // Creep with the plate.
        let moved = vec![Vector1::new(rate * time); rectangles.count()];
        fault.stiffness().multiply_add(-1.0, &moved, &mut load);
        let largest = MEDIUM.shear_modulus * rate * time * rectangles.area() / 200.0;
        assert!(load.iter().all(|load| load[0].abs() < 1e-13 * largest));
    }
    Ok(())
}

/// The larger the plane that slips alike, the less its middle is stressed: as the inverse of its size.
#[test]
fn large_planes_that_slip_alike_are_not_stressed() -> Outcome {
    for dip in [90.0, 30.0] {
        let mut stresses = Vec::new();
        for scale in [1.0, 1e3] {
            let one = cells([1, 1], [2e3 * scale, 1e3 * scale], 0.0)?;
            let fault = PlaneFault::half_space(one, dip, MEDIUM, POISSON)?;
            let all = fault.dislocation(0).ok_or("no rectangle")?;
            let stress = all.stress([1.0, 1.0], [1e3 * scale, -3.0, -500.0 * scale]);
            stresses.push(stress.amax());
            let loading = fault.back_slip(&[Vector2::new(1.0, 1.0)])?;
            let mut load = [Vector2::zeros()];
            loading(1.0, &mut load);
            assert!(load[0][0] > 0.0 && load[0][1] > 0.0);
        }
        assert!(stresses[1] < 1.2e-3 * stresses[0], "{stresses:?}");
    }
    Ok(())
}

/// Vertical planes by sums and differences of rows are those by pairs of rows.
#[test]
fn transformed_planes_have_the_same_entries() -> Outcome {
    for (begin, counts) in [
        (0.0, [4, 30]),
        (150.0, [4, 30]),
        (0.0, [5, 1]),
        (0.0, [1, 6]),
    ] {
        let rectangles = cells(counts, [300.0, 200.0], begin)?;
        let fault = PlaneFault::half_space(rectangles, 90.0, MEDIUM, POISSON)?;
        let transformed = fault.clone().transformed_down_dip()?;
        let (pairs, sums) = (dense(&fault.stiffness()), dense(&transformed.stiffness()));
        assert!((&pairs - &sums).amax() < 1e-12 * pairs.amax(), "{counts:?}");
        let (pairs, sums) = (
            dense(&fault.with_rake(30.0)?.stiffness()),
            dense(&transformed.with_rake(30.0)?.stiffness()),
        );
        assert!((&pairs - &sums).amax() < 1e-12 * pairs.amax(), "{counts:?}");
    }
    Ok(())
}
