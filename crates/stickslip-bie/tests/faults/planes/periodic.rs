//! Planes that repeat.

use std::f64::consts::TAU;

use nalgebra::{Vector1, Vector2};
use stickslip_bie::{Fault, Mode, PlaneFault};
use stickslip_solvers::Matrix;

use super::{POISSON, cells, dense};
use crate::{IN_PLANE, MEDIUM, Outcome};

/// `-(mu/2) [(kx^2/(1 - nu) + ky^2) Dx + (nu/(1 - nu)) kx ky Dy]/k`, with `ky` up dip.
#[test]
fn modes_have_their_stiffness() -> Outcome {
    let (counts, size) = ([24, 15], [300.0, 200.0]);
    let fault = PlaneFault::whole_space(cells(counts, size, 0.0)?, MEDIUM, POISSON)?
        .periodic_along_strike()?
        .periodic_down_dip()?;
    let (stiffness, area) = (fault.stiffness(), fault.cells().area());
    let largest = MEDIUM.shear_modulus * TAU / 400.0;
    for (along, down) in [
        (1, 0),
        (0, 1),
        (1, 1),
        (3, -2),
        (-11, 7),
        (12, 0),
        (5, -7),
        (0, 0),
    ] {
        let kx = TAU * f64::from(along) / (counts[0] as f64 * size[0]);
        let ky = TAU * f64::from(down) / (counts[1] as f64 * size[1]);
        let k = kx.hypot(ky).max(1e-30);
        let wave = |[x, y]: [f64; 2]| (kx * x - ky * y + 0.3).cos();
        let half = 0.5 * MEDIUM.shear_modulus / k;
        let stretched = 1.0 / (1.0 - POISSON);
        let cross = half * (stretched - 1.0) * kx * ky;
        for (slip, exact) in [
            (
                Vector2::new(1.0, 0.0),
                Vector2::new(half * (kx * kx * stretched + ky * ky), cross),
            ),
            (
                Vector2::new(0.0, 1.0),
                Vector2::new(cross, half * (kx * kx + ky * ky * stretched)),
            ),
        ] {
            let slips = fault.cells().map(|at| slip * wave(at));
            let mut forces = vec![Vector2::zeros(); slips.len()];
            stiffness.multiply_add(1.0, &slips, &mut forces);
            for (i, force) in forces.iter().enumerate() {
                let error = (force / area - exact * wave(fault.cells().center(i))).amax();
                assert!(error < 1e-10 * largest, "{along} {down}: {error:e}");
            }
        }
    }
    Ok(())
}

/// Slip that is uniform along the period is that of a line.
#[test]
fn planes_that_repeat_are_lines() -> Outcome {
    for columns in [1, 2, 9] {
        for (axis, counts) in [(0, [columns, 12]), (1, [12, columns])] {
            let fault =
                PlaneFault::whole_space(cells(counts, [30.0, 20.0], 0.0)?, MEDIUM, POISSON)?;
            let fault = match axis {
                0 => fault.periodic_along_strike()?,
                _ => fault.periodic_down_dip()?,
            };
            let of_line = match axis {
                0 => *fault.cells().down_dip(),
                _ => *fault.cells().along_strike(),
            };
            for (rake, along) in [(0.0, 0), (90.0, 1)] {
                let mode = if along == axis {
                    Mode::Antiplane
                } else {
                    IN_PLANE
                };
                let line = Fault::whole_space(of_line, MEDIUM, mode)?;
                let slip: Vec<_> = (0..12)
                    .map(|i| Vector1::new(f64::from(i * i % 5)))
                    .collect();
                let of = |cell: usize| fault.cells().column_and_row(cell)[1 - axis];
                let slips: Vec<_> = (0..fault.cells().count()).map(|i| slip[of(i)]).collect();
                let mut forces = vec![Vector1::zeros(); slips.len()];
                let kernel = fault.clone().with_rake(rake)?.stiffness();
                kernel.multiply_add(1.0, &slips, &mut forces);
                let width = fault.cells().area() / of_line.length();
                for (i, force) in forces.iter().enumerate() {
                    let exact = line.stiffness().product_at(of(i), &slip)[0] * width;
                    let error = (force[0] - exact).abs() / (MEDIUM.shear_modulus * width);
                    assert!(error < 1e-9, "{columns} {axis} {rake} {i}: {error:e}");
                }
            }
        }
    }
    Ok(())
}

/// The images one by one, on a long plane; those beyond its `n` periods are missing, up to `1/n^2` and the sum's.
#[test]
fn images_are_the_plane_repeated() -> Outcome {
    let (columns, periods) = (4, 81);
    let size = [30.0, 20.0];
    let one = PlaneFault::whole_space(cells([columns, 3], size, 0.0)?, MEDIUM, POISSON)?;
    let long = PlaneFault::whole_space(cells([columns * periods, 3], size, 0.0)?, MEDIUM, POISSON)?;
    let (one, long) = (one.periodic_along_strike()?.stiffness(), long.stiffness());
    let slip = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns);
        Vector2::new(
            (column * column) as f64 - row as f64,
            1.0 + (column * row) as f64,
        )
    };
    let slips: Vec<_> = (0..3 * columns).map(slip).collect();
    let all: Vec<_> = (0..3 * columns * periods)
        .map(|cell| {
            let (column, row) = (cell % (columns * periods), cell / (columns * periods));
            slips[row * columns + column % columns]
        })
        .collect();
    for cell in 0..3 * columns {
        let (column, row) = (cell % columns, cell / columns);
        let middle = row * columns * periods + columns * (periods / 2) + column;
        let (found, exact) = (one.product_at(cell, &slips), long.product_at(middle, &all));
        let error = (found - exact).amax() / dense(&one).amax();
        assert!(error < 1e-4, "{cell}: {error:e}");
    }
    Ok(())
}

/// A plane is its own repetition: the sums over images are those of three times the period, with slip three times.
#[test]
fn sums_of_images_do_not_depend_on_the_period() -> Outcome {
    let (columns, rows) = (3, 4);
    let slip = |column: usize, row: usize| {
        Vector2::new(
            (column * column) as f64 - row as f64,
            1.0 + (column * row) as f64,
        )
    };
    for axis in [0, 1] {
        let forces = |periods: usize| -> Outcome<Vec<Vector2<f64>>> {
            let mut counts = [columns, rows];
            counts[axis] *= periods;
            let fault =
                PlaneFault::whole_space(cells(counts, [30.0, 20.0], 0.0)?, MEDIUM, POISSON)?;
            let fault = match axis {
                0 => fault.periodic_along_strike()?,
                _ => fault.periodic_down_dip()?,
            };
            let of = |cell: usize| fault.cells().column_and_row(cell);
            let slips: Vec<_> = (0..fault.cells().count())
                .map(|cell| slip(of(cell)[0] % columns, of(cell)[1] % rows))
                .collect();
            let mut forces = vec![Vector2::zeros(); slips.len()];
            fault.stiffness().multiply_add(1.0, &slips, &mut forces);
            let first = |&cell: &usize| of(cell)[0] < columns && of(cell)[1] < rows;
            let cells = (0..forces.len()).filter(first);
            Ok(cells.map(|cell| forces[cell]).collect())
        };
        let (once, thrice) = (forces(1)?, forces(3)?);
        let largest = once.iter().map(|force| force.amax()).fold(0.0, f64::max);
        for (once, thrice) in once.iter().zip(&thrice) {
            let error = (once - thrice).amax() / largest;
            assert!(error < 1e-10, "{axis}: {error:e}");
        }
    }
    Ok(())
}
