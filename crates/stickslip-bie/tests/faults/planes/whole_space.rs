//! Planes in a whole space against closed forms.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;
use stickslip_bie::{Fault, Mode, PlaneFault};
use stickslip_solvers::Matrix;

use super::{POISSON, cells, dense};
use crate::{IN_PLANE, MEDIUM, Outcome};

/// A cell `a x b` alone, slip along `a`: `-(2 mu/pi) [d/(a b) + (nu/(1 - nu)) b/(a d)]`, and the other way round.
fn alone([a, b]: [f64; 2]) -> f64 {
    let d = a.hypot(b);
    let ratio = POISSON / (1.0 - POISSON);
    2.0 * MEDIUM.shear_modulus / PI * (d / (a * b) + ratio * b / (a * d))
}

#[test]
fn a_cell_relieves_itself() -> Outcome {
    for size in [[1.0, 1.0], [300.0, 200.0], [1.0, 50.0]] {
        let fault = PlaneFault::whole_space(cells([1, 1], size, 0.0)?, MEDIUM, POISSON)?;
        let area = fault.cells().area();
        let block = fault.stiffness().diagonal_block(0) / area;
        for (found, exact) in [
            (block[(0, 0)], alone(size)),
            (block[(1, 1)], alone([size[1], size[0]])),
        ] {
            assert!((found / exact - 1.0).abs() < 1e-13, "{found:e} {exact:e}");
        }
        assert_eq!((block[(0, 1)], block[(1, 0)]), (0.0, 0.0));
    }
    // 10 km, 32.04 GPa, by an independent program.
    let rock = stickslip_bie::Medium {
        shear_modulus: 32.04e9,
        ..MEDIUM
    };
    let patch = PlaneFault::whole_space(cells([1, 1], [1e4, 1e4], 0.0)?, rock, POISSON)?;
    let stress = patch.stiffness().diagonal_block(0)[(0, 0)] / 1e8;
    assert!((stress / 3.365_382_39e6 - 1.0).abs() < 1e-8, "{stress:e}");
    Ok(())
}

/// Cells that slip alike are one cell of their size, also where the cross term is corrected.
#[test]
fn cells_that_slip_alike_are_one() -> Outcome {
    for n in [3, 7, 21] {
        let size = [300.0, 200.0];
        let fault = PlaneFault::whole_space(cells([n, n], size, 0.0)?, MEDIUM, POISSON)?;
        let middle = n * n / 2;
        for (slip, exact) in [
            (
                Vector2::new(1.0, 0.0),
                [alone(size.map(|s| s * n as f64)), 0.0],
            ),
            (
                Vector2::new(0.0, 1.0),
                [0.0, alone([size[1] * n as f64, size[0] * n as f64])],
            ),
        ] {
            let mut force = vec![Vector2::zeros(); n * n];
            let slip = vec![slip; n * n];
            fault.stiffness().multiply_add(1.0, &slip, &mut force);
            let stress = force[middle] / fault.cells().area();
            let error = (stress - Vector2::from(exact)).amax();
            assert!(error < 1e-12 * alone(size), "{n}: {error:e}");
        }
    }
    Ok(())
}

/// The factor of a wave in the middle of a plane whose slip ends smoothly.
fn symbol(wavenumber: [f64; 2], slip: usize, force: usize) -> Outcome<f64> {
    let n = 500;
    let fault = PlaneFault::whole_space(cells([n, n], [1.0, 1.0], 0.0)?, MEDIUM, POISSON)?;
    let middle = n / 2 * n + n / 2;
    let [x0, y0] = fault.cells().center(middle);
    let slips = fault.cells().map(|[x, y]| {
        let (x, y) = (x - x0, y - y0);
        // 1 up to 50, 0 from 249 on, with all derivatives.
        let place = ((x.hypot(y) - 50.0) / 199.0).clamp(0.0, 1.0);
        let end = |t: f64| if t > 0.0 { (-1.0 / t).exp() } else { 0.0 };
        let window = end(1.0 - place) / (end(1.0 - place) + end(place));
        let mut slips = Vector2::zeros();
        slips[slip] = window * (wavenumber[0] * x + wavenumber[1] * y).cos();
        slips
    });
    let mut forces = vec![Vector2::zeros(); n * n];
    fault.stiffness().multiply_add(1.0, &slips, &mut forces);
    Ok(forces[middle][force])
}

/// `(mu/2) (kx^2/(1 - nu) + ky^2)/k`, and `(nu/(1 - nu)) kx ky/k` with the other sign, since slip is up dip.
#[test]
fn waves_of_fifty_cells_have_their_stiffness() -> Outcome {
    let k = TAU / 50.0;
    let half = 0.5 * MEDIUM.shear_modulus * k;
    let along = 1.0 / (1.0 - POISSON);
    let diagonal = k / 2.0_f64.sqrt();
    for (wavenumber, slip, exact) in [
        ([k, 0.0], 0, half * along),
        ([0.0, k], 0, half),
        ([diagonal, diagonal], 0, half * 0.5 * (1.0 + along)),
        ([k, 0.0], 1, half),
        ([0.0, k], 1, half * along),
    ] {
        let found = symbol(wavenumber, slip, slip)?;
        assert!((found / exact - 1.0).abs() < 1e-3, "{}", found / exact);
    }
    let exact = -half * (along - 1.0) * 0.5;
    for (slip, force) in [(0, 1), (1, 0)] {
        let found = symbol([diagonal, diagonal], slip, force)?;
        assert!((found / exact - 1.0).abs() < 2e-3, "{}", found / exact);
        let found = symbol([diagonal, -diagonal], slip, force)?;
        assert!((found / exact + 1.0).abs() < 2e-3, "{}", found / exact);
    }
    Ok(())
}

/// The cross term of diagonal neighbours has the Madelung sum of the lattice: 1.6155426 h for squares, 2.787235 for
/// 1 x 2 and 1.386304 for 1 x 1/4, each summed by an independent program.
#[test]
fn cross_terms_are_corrected_by_the_lattice() -> Outcome {
    for (size, sum) in [
        ([1.0, 1.0], 1.615_542_6),
        ([3.0, 3.0], 3.0 * 1.615_542_6),
        ([1.0, 2.0], 2.787_235),
        ([1.0, 0.25], 1.386_304),
    ] {
        let fault = PlaneFault::whole_space(cells([2, 2], size, 0.0)?, MEDIUM, POISSON)?;
        let entry = dense(&fault.stiffness())[(6, 1)];
        let corner = |x: f64, y: f64| 1.0 / (x * size[0]).hypot(y * size[1]);
        let exact = corner(0.5, 0.5) + corner(1.5, 1.5) - corner(0.5, 1.5) - corner(1.5, 0.5);
        let (area, ratio) = (size[0] * size[1], POISSON / (1.0 - POISSON));
        let factor = MEDIUM.shear_modulus * ratio;
        let own = area * factor / (4.0 * PI) * exact;
        let found = (entry - own) / (factor / 16.0 / PI);
        assert!((found / sum - 1.0).abs() < 3e-7, "{found} {sum}");
    }
    Ok(())
}

/// Long cells are lines: off by `(d/l)^2` in plane strain, by `3.3 (d/l)^2` antiplane, for cells `d` apart.
#[test]
fn long_cells_are_lines() -> Outcome {
    let (rows, long) = (12, 1000.0);
    let fault = PlaneFault::whole_space(cells([1, rows], [long, 1.0], 0.0)?, MEDIUM, POISSON)?;
    for (rake, mode, factor) in [(0.0, Mode::Antiplane, 3.3), (90.0, IN_PLANE, 1.0)] {
        let line = Fault::whole_space(*fault.cells().down_dip(), MEDIUM, mode)?;
        let (plane, line) = (
            dense(&fault.clone().with_rake(rake)?.stiffness()) / long,
            crate::dense(&line.stiffness()),
        );
        for (i, j) in (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let apart = (i.abs_diff(j) as f64).max(1.0);
            let error = (plane[(i, j)] / line[(i, j)] - 1.0).abs();
            let bound = factor * (apart / long).powi(2) * 1.1 + 1e-7;
            assert!(error < bound, "{i} {j}: {error:e} {bound:e}");
        }
    }
    Ok(())
}

/// Oblique slip is a combination of both components.
#[test]
fn oblique_slip_is_strike_and_dip_slip() -> Outcome {
    for fault in super::planes([5, 4])? {
        let (both, rake) = (dense(&fault.stiffness()), 37.0_f64);
        let oblique = dense(&fault.clone().with_rake(rake)?.stiffness());
        let direction = [rake.to_radians().cos(), rake.to_radians().sin()];
        for (i, j) in (0..20).flat_map(|i| (0..20).map(move |j| (i, j))) {
            let mut sum = 0.0;
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                sum += direction[a] * direction[b] * both[(2 * i + a, 2 * j + b)];
            }
            assert!(
                (oblique[(i, j)] - sum).abs() < 1e-14 * both.amax(),
                "{fault:?}"
            );
        }
    }
    Ok(())
}

/// `n x n` squares that slip alike are stressed in their middle by `1.050 mu/(n h)`: nothing is left of large planes.
#[test]
fn large_planes_that_slip_alike_are_not_stressed() -> Outcome {
    for n in [1, 5, 45] {
        let fault = PlaneFault::whole_space(cells([n, n], [1.0, 1.0], 0.0)?, MEDIUM, POISSON)?;
        let mut load = vec![Vector2::zeros(); n * n];
        fault.plate_loading(Vector2::new(1.0, 1.0))?(1.0, &mut load);
        let exact = 1.050_369_0 * MEDIUM.shear_modulus / n as f64;
        let middle = load[n * n / 2];
        for component in 0..2 {
            assert!(
                (middle[component] / exact - 1.0).abs() < 1e-6,
                "{n}: {middle}"
            );
        }
    }
    Ok(())
}
