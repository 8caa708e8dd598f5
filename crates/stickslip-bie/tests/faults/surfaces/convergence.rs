//! Surfaces of triangles against exact solutions.

use std::f64::consts::PI;

use nalgebra::{DMatrix, Matrix3, Vector1, Vector2, Vector3};
use stickslip_bie::{Medium, RectangularDislocation, SurfaceFault, Triangles};
use stickslip_solvers::{Matrix, Operator};

use super::meshes::{disc, equilateral, grid, sphere};
use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 1.0,
    shear_wave_speed: 1.0,
};

/// The traction along x, by its sign, of slip `exp(-r^2)` along x, of a length of sqrt(1/2), on a plane, `mu = 1`: Hankel transforms, by midpoints.
fn of_gaussian(x: f64, y: f64, poisson_ratio: f64) -> f64 {
    let (r2, stiff) = (x * x + y * y, 1.0 / (1.0 - poisson_ratio));
    let (r, double) = (r2.sqrt(), if r2 > 0.0 { (x * x - y * y) / r2 } else { 0.0 });
    let (steps, turns) = (60, 24);
    let mut sum = 0.0;
    for n in 0..steps {
        let k = 10.0 * (n as f64 + 0.5) / steps as f64;
        let (mut j0, mut j2) = (0.0, 0.0);
        for m in 0..turns {
            let angle = PI * (m as f64 + 0.5) / turns as f64;
            let phase = k * r * angle.sin();
            j0 += phase.cos() / turns as f64;
            j2 += (2.0 * angle - phase).cos() / turns as f64;
        }
        let factor = 0.5 * (stiff + 1.0) * j0 - 0.5 * (stiff - 1.0) * double * j2;
        sum += k * k * (-0.25 * k * k).exp() * factor * 10.0 / steps as f64;
    }
    0.25 * sum
}

/// The root mean square of the error of the traction of a smooth slip by its peak.
fn error_of_gaussian(side: f64, is_corrected: bool) -> Outcome<f64> {
    let (points, triangles) = equilateral(2.3, side);
    let fault = SurfaceFault::whole_space(Triangles::new(&points, &triangles)?, ROCK, 0.25)?;
    let mut fault = fault.with_rake(0.0)?;
    if !is_corrected {
        fault = fault.without_correction();
    }
    let cells = fault.cells();
    let slip = cells.map(|[x, y, _]| Vector1::new((-x * x - y * y).exp()));
    let mut forces = vec![Vector1::new(0.0); slip.len()];
    fault.stiffness().multiply_add(1.0, &slip, &mut forces);
    let (mut sum, mut count) = (0.0, 0.0);
    for cell in 0..cells.count() {
        let [x, y, _] = cells.centroid(cell);
        if x.hypot(y) < 1.3 {
            let error = forces[cell][0] / cells.area(cell) - of_gaussian(x, y, 0.25);
            sum += error * error;
            count += 1.0;
        }
    }
    Ok((sum / count).sqrt() / of_gaussian(0.0, 0.0, 0.25))
}

#[test]
fn tractions_of_smooth_slip_converge() -> Outcome {
    for (side, most) in [(0.5, 0.010), (0.25, 0.004), (0.18, 0.002)] {
        let error = error_of_gaussian(side / 2f64.sqrt(), true)?;
        assert!(error < most, "{side}: {error}");
    }
    Ok(())
}

/// The reason for the correction.
#[test]
fn without_correction_they_do_not() -> Outcome {
    for side in [0.5, 0.25] {
        let error = error_of_gaussian(side / 2f64.sqrt(), false)?;
        assert!(error > 0.02, "{side}: {error}");
    }
    Ok(())
}

/// The traction along a direction of slip `exp(-r^2)` along it about a point of the surface, 0 along strike and 1 up dip:
/// by small rectangles, each with its centre at the receiver's distance along strike and down dip.
fn of_gaussian_at_surface(dip: f64, [x, down]: [f64; 2], along: usize) -> Outcome<f64> {
    let (sin, cos) = dip.to_radians().sin_cos();
    // The receiver is in the middle of a row.
    let side = down / ((down / 0.06).floor() + 0.5);
    let at = [x, -down * cos, -down * sin];
    let mut stress = Matrix3::zeros();
    for row in 0..(2.5 / side) as i32 {
        let columns = (2.5 / side) as i32;
        for column in -columns..=columns {
            let [left, top] = [x + (f64::from(column) - 0.5) * side, f64::from(row) * side];
            let [u, v] = [left + 0.5 * side, top + 0.5 * side];
            let mut slip = [0.0; 2];
            slip[along] = (-u * u - v * v).exp();
            if slip[along] > 1e-3 {
                let (across, down) = ([left, left + side], [top, top + side]);
                let cell = RectangularDislocation::new(across, down, dip, 1.0, 0.25)?;
                stress += cell.stress(slip, at);
            }
        }
    }
    let traction = stress * Vector3::new(0.0, -sin, cos);
    Ok([traction.x, traction.y * cos + traction.z * sin][along])
}

/// Root mean squares of errors by the largest traction: in the cells that have an edge at a free surface, and in the
/// others of the first two rows below it.
fn errors_at_surface(fault: &SurfaceFault, dip: f64, along: usize) -> Outcome<[f64; 2]> {
    let cells = fault.cells();
    // Slip is up dip, or along x.
    let sign = if along == 0 {
        cells.axes(0).strike[0]
    } else {
        1.0
    };
    let down = |[_, y, z]: [f64; 3]| y.hypot(z);
    let slip = cells.map(|at| {
        let mut slip = Vector2::zeros();
        slip[along] = sign * (-at[0] * at[0] - down(at).powi(2)).exp();
        slip
    });
    let mut forces = vec![Vector2::zeros(); slip.len()];
    fault.stiffness().multiply_add(1.0, &slip, &mut forces);
    let mut largest = 0.0_f64;
    let (mut sums, mut counts) = ([0.0; 2], [0.0; 2]);
    for cell in 0..cells.count() {
        let at = cells.centroid(cell);
        if at[0].abs() < 0.4 && down(at) < 0.25 {
            let traction = -sign * forces[cell][along] / cells.area(cell);
            let exact = of_gaussian_at_surface(dip, [at[0], down(at)], along)?;
            largest = largest.max(exact.abs());
            let at_surface = cells.corners(cell).map(|corner| corner[2] == 0.0);
            let part = usize::from(at_surface.iter().filter(|&&at| at).count() < 2);
            sums[part] += (traction - exact).powi(2);
            counts[part] += 1.0;
        }
    }
    Ok([0, 1].map(|part| f64::sqrt(sums[part] / counts[part]) / largest))
}

/// The correction is that of a plane that goes on above the free surface.
#[test]
fn tractions_below_a_free_surface_are_corrected() -> Outcome {
    for dip in [90.0_f64, 50.0] {
        let (sin, cos) = dip.to_radians().sin_cos();
        let (points, triangles) = grid([36, 18], |[x, y]| {
            let (x, down) = (0.125 * (x - 18.0), 0.125 * y);
            [x, -down * cos, -down * sin]
        });
        let cells = Triangles::new(&points, &triangles)?;
        let corrected = SurfaceFault::half_space(cells, ROCK, 0.25)?;
        let raw = corrected.clone().without_correction();
        for along in [0, 1] {
            let with = errors_at_surface(&corrected, dip, along)?;
            let without = errors_at_surface(&raw, dip, along)?;
            let context = format!("dip {dip}, {along}: {with:?} {without:?}");
            assert!(with[0] < 0.75 * without[0], "{context}");
            assert!(with[1] < 0.4 * without[1], "{context}");
        }
    }
    Ok(())
}

/// Solves `K D = f` by stabilised biconjugate gradients.
fn solve(stiffness: &impl Operator<1>, force: &[f64]) -> Vec<f64> {
    let product = |x: &[f64]| {
        let x: Vec<_> = x.iter().map(|&x| Vector1::new(x)).collect();
        let mut y = vec![Vector1::new(0.0); x.len()];
        stiffness.multiply_add(1.0, &x, &mut y);
        y.iter().map(|y| y[0]).collect::<Vec<_>>()
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut x = vec![0.0; force.len()];
    let (mut r, shadow, mut p) = (force.to_vec(), force.to_vec(), force.to_vec());
    while dot(&r, &r) > 1e-16 * dot(force, force) {
        let rho = dot(&shadow, &r);
        let v = product(&p);
        let alpha = rho / dot(&shadow, &v);
        let s: Vec<_> = r.iter().zip(&v).map(|(r, v)| r - alpha * v).collect();
        let t = product(&s);
        let omega = dot(&t, &s) / dot(&t, &t);
        for i in 0..x.len() {
            x[i] += alpha * p[i] + omega * s[i];
            r[i] = s[i] - omega * t[i];
        }
        let beta = dot(&shadow, &r) / rho * alpha / omega;
        for i in 0..x.len() {
            p[i] = r[i] + beta * (p[i] - omega * v[i]);
        }
    }
    x
}

/// A circular shear crack slips by `D = 8 (1 - nu)/(pi (2 - nu)) (stress drop/mu) sqrt(a^2 - r^2)`: at its centre, and
/// summed over cells.
#[test]
fn a_circular_crack_slips_as_it_should() -> Outcome {
    let nu = 0.25;
    for (rings, most) in [(11, [7e-3, 22e-3]), (22, [3.5e-3, 11e-3])] {
        let (points, triangles) = disc(rings);
        let cells = Triangles::new(&points, &triangles)?;
        let areas: Vec<_> = (0..cells.count()).map(|cell| cells.area(cell)).collect();
        let radii = cells.map(|[x, y, _]| x.hypot(y));
        let fault = SurfaceFault::whole_space(cells, ROCK, nu)?.with_rake(0.0)?;
        let slip = solve(&fault.stiffness(), &areas);
        let factor = 8.0 * (1.0 - nu) / (PI * (2.0 - nu));
        let exact = radii.iter().map(|r| factor * (1.0 - r * r).sqrt());
        let exact: Vec<_> = exact.collect();
        let moment = |slip: &[f64]| slip.iter().zip(&areas).map(|(s, a)| s * a).sum::<f64>();
        let near = (0..slip.len()).filter(|&cell| radii[cell] < 0.25);
        let ratios: Vec<_> = near.map(|cell| slip[cell] / exact[cell]).collect();
        let errors = [
            ratios.iter().sum::<f64>() / ratios.len() as f64 - 1.0,
            moment(&slip) / moment(&exact) - 1.0,
        ];
        for (error, most) in errors.into_iter().zip(most) {
            assert!(error.abs() < most, "{rings}: {errors:?}");
        }
    }
    Ok(())
}

/// Stress per slip has eigenvalues with negative real parts, with the correction and without.
#[test]
fn slip_is_stable() -> Outcome {
    let (points, triangles) = disc(4);
    let cells = Triangles::new(&points, &triangles)?;
    let fault = SurfaceFault::whole_space(cells, ROCK, 0.25)?;
    for fault in [fault.clone(), fault.without_correction()] {
        let mut matrix = DMatrix::from(&fault.stiffness());
        for (row, mut values) in matrix.row_iter_mut().enumerate() {
            values /= -fault.cells().area(row / 2);
        }
        let largest = matrix
            .complex_eigenvalues()
            .iter()
            .map(|value| value.re)
            .fold(f64::NEG_INFINITY, f64::max);
        assert!(largest < -1.0, "{largest}");
    }
    Ok(())
}

/// A sphere that turns inside stresses nothing: what is left is the error.
#[test]
fn a_sphere_that_turns_stresses_little() -> Outcome {
    for (parts, is_averaged, within) in [(12, true, [0.0, 0.008]), (12, false, [0.02, 0.1])] {
        let (points, triangles) = sphere(parts);
        let cells = Triangles::new(&points, &triangles)?;
        assert_eq!(cells.count(), 20 * parts * parts);
        // About an axis that is none of the mesh.
        let axis = Vector3::new(0.3, 0.5, 0.8).normalize();
        let turn = |at: [f64; 3]| axis.cross(&Vector3::from(at));
        let slip: Vec<_> = cells.map(|at| Vector1::new(turn(at).norm()));
        let rakes = (0..cells.count()).map(|cell| {
            let (axes, turn) = (cells.axes(cell), turn(cells.centroid(cell)));
            let part = |axis: [f64; 3]| Vector3::from(axis).dot(&turn);
            part(axes.up_dip).atan2(part(axes.strike)).to_degrees()
        });
        let rakes: Vec<_> = rakes.collect();
        let mut fault = SurfaceFault::whole_space(cells, ROCK, 0.25)?.with_rakes(&rakes)?;
        if !is_averaged {
            fault = fault.without_averaging();
        }
        let mut stress = vec![0.0; slip.len()];
        fault
            .normal_stiffness()
            .multiply_add(1.0, &slip, &mut stress);
        let rms = (stress.iter().map(|x| x * x).sum::<f64>() / slip.len() as f64).sqrt();
        assert!(within[0] < rms && rms < within[1], "{rms}");
    }
    Ok(())
}
