//! Stress and displacement off the fault.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector1};
use proptest::prelude::*;
use stickslip_bie::{Mode, SegmentFault, Segments, Sense};

use super::UNIT;
use crate::{IN_PLANE, Outcome, field};

/// `(D/pi) [atan(x/d) - atan(x/w)]` at the surface, of slip from `d` to `w`: the side towards `x` moves along `y`.
#[test]
fn a_screw_dislocation_moves_the_surface() -> Outcome {
    let (upper, lower, slip) = (15e3, 80e3, 2.5);
    let segments = Segments::polyline(&[[0.0, -upper], [0.0, -lower]])?.divided(5e3)?;
    let count = segments.count();
    let fault = SegmentFault::half_space(segments, UNIT, Mode::Antiplane)?;
    let places = [-300e3, -20e3, -1.0, 0.0, 7e3, 15e3, 1e6];
    let found = fault.displacement_at(&places.map(|x| [x, 0.0]), &field(&vec![slip; count]))?;
    for (x, found) in places.into_iter().zip(found) {
        let exact = slip / PI * ((x / upper).atan() - (x / lower).atan());
        assert!((found[1] - exact).abs() < 1e-13 * slip && found[0] == 0.0 && found[2] == 0.0);
    }
    Ok(())
}

/// A rough fault that dips to the left, and a branch.
fn faults(mode: Mode, free_surface: bool) -> Outcome<SegmentFault> {
    let main: Vec<_> = (0..=12)
        .map(f64::from)
        .map(|k| [-0.6 * k + 0.1 * (1.3 * k).sin(), -0.9 * k])
        .collect();
    let branch: Vec<_> = (0..=4)
        .map(|k| [main[6][0] - 1.1 * f64::from(k), main[6][1]])
        .collect();
    let segments = Segments::polylines([main, branch])?;
    Ok(if free_surface {
        SegmentFault::half_space(segments, UNIT, mode)?
    } else {
        SegmentFault::whole_space(segments, UNIT, mode)?
    })
}

fn slips() -> Vec<Vector1<f64>> {
    let numbers = (1..=16).map(|k| f64::from(k) * 0.618_033_988_749_895);
    field(&numbers.map(|x| x.fract() - 0.3).collect::<Vec<_>>())
}

/// From the footwall to the hanging wall, displacement grows by slip up dip; antiplane, the side towards `x` moves along `y`.
#[test]
fn displacement_jumps_by_slip() -> Outcome {
    let slip = slips();
    for free_surface in [false, true] {
        for mode in [IN_PLANE, Mode::Antiplane] {
            for sense in [Sense::Thrust, Sense::Normal] {
                let fault = faults(mode, free_surface)?.with_sense(sense);
                for cell in 0..16 {
                    let ([x, z], [normal, up]) = (fault.cells().center(cell), fault.axes(cell));
                    let aside =
                        |distance: f64| [x + distance * normal[0], z + distance * normal[1]];
                    let moved = fault.displacement_at(&[aside(1e-12), aside(-1e-12)], &slip)?;
                    let jump = [0, 1, 2].map(|c| moved[0][c] - moved[1][c]);
                    let sign = if sense == Sense::Thrust { 1.0 } else { -1.0 };
                    let exact = match mode {
                        // Both dip to the left, or lie level above the rest.
                        Mode::Antiplane => [0.0, -slip[cell][0], 0.0],
                        _ => [
                            sign * up[0] * slip[cell][0],
                            0.0,
                            sign * up[1] * slip[cell][0],
                        ],
                    };
                    for (jump, exact) in jump.into_iter().zip(exact) {
                        let level = mode == Mode::Antiplane && cell >= 12;
                        let exact = if level { -exact } else { exact };
                        assert!((jump - exact).abs() < 1e-10, "{cell} {jump} {exact}");
                    }
                }
            }
        }
    }
    Ok(())
}

/// Hooke's law by central differences.
fn hooke(fault: &SegmentFault, [x, z]: [f64; 2], poisson_ratio: f64) -> Outcome<Matrix3<f64>> {
    let h = 1e-3;
    let slope = |dx: f64, dz: f64| -> Outcome<[f64; 3]> {
        let at = |n: f64| [x + n * h * dx, z + n * h * dz];
        let [a, b, c, d] =
            fault.displacement_at(&[at(1.0), at(-1.0), at(2.0), at(-2.0)], &slips())?[..]
        else {
            return Err("not four".into());
        };
        Ok([0, 1, 2].map(|k| (8.0 * (a[k] - b[k]) - (c[k] - d[k])) / (12.0 * h)))
    };
    let (by_x, by_z) = (slope(1.0, 0.0)?, slope(0.0, 1.0)?);
    let gradient = Matrix3::new(
        by_x[0], 0.0, by_z[0], by_x[1], 0.0, by_z[1], by_x[2], 0.0, by_z[2],
    );
    let lame = 2.0 * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
    let volume = Matrix3::identity() * (lame * gradient.trace());
    Ok(gradient + gradient.transpose() + volume)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Away from the faults.
    #[test]
    fn stress_is_that_of_the_displacement(
        x in prop_oneof![-30.0..-8.5, 2.0..20.0],
        z in -30.0..-0.1,
        poisson_ratio in -0.9..0.45,
        free_surface: bool,
    ) {
        for mode in [Mode::InPlane { poisson_ratio }, Mode::Antiplane] {
            let made = || -> Outcome<_> {
                let fault = faults(mode, free_surface)?;
                let stress = fault.stress_at(&[[x, z]], &slips())?[0];
                let nu = if mode == Mode::Antiplane { 0.0 } else { poisson_ratio };
                Ok((stress, hooke(&fault, [x, z], nu)?))
            };
            let (stress, known) = made().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let apart = (stress - known).amax();
            prop_assert!(apart < 1e-8 * (1.0 + known.amax()), "{apart:e}: {stress} {known}");
        }
    }

    #[test]
    fn the_surface_is_free(x in -40.0..40.0) {
        prop_assume!(f64::abs(x) > 0.05);
        for mode in [IN_PLANE, Mode::Antiplane] {
            let made = || -> Outcome<_> { Ok(faults(mode, true)?.stress_at(&[[x, 0.0]], &slips())?[0]) };
            let stress = made().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let bound = 1e-13 / f64::abs(x).min(1.0).powi(2);
            prop_assert!(stress.column(2).amax() < bound, "{stress}");
        }
    }
}

/// On the cells themselves the stress is that of the matrices.
#[test]
fn tractions_are_those_of_the_matrices() -> Outcome {
    let slip = slips();
    for mode in [IN_PLANE, Mode::Antiplane] {
        for sense in [Sense::Thrust, Sense::Normal] {
            let fault = faults(mode, true)?.with_sense(sense);
            let centers = fault.cells().map(|center| center);
            let stresses = fault.stress_at(&centers, &slip)?;
            let mut normal = vec![0.0; 16];
            fault
                .normal_stiffness()
                .multiply_add(1.0, &slip, &mut normal);
            let sign = if sense == Sense::Thrust { 1.0 } else { -1.0 };
            for (cell, stress) in stresses.iter().enumerate() {
                let [[nx, nz], [ux, uz]] = fault.axes(cell);
                let force = stress * nalgebra::Vector3::new(nx, 0.0, nz);
                let shear = match mode {
                    Mode::Antiplane => force[1] * if cell < 12 { -1.0 } else { 1.0 },
                    _ => sign * (force[0] * ux + force[2] * uz),
                };
                let stiffness = fault.stiffness();
                let own = stickslip_solvers::Matrix::product_at(&stiffness, cell, &slip)[0];
                assert!((shear + own / fault.cells().length(cell)).abs() < 1e-12);
                assert!((normal[cell] + force[0] * nx + force[2] * nz).abs() < 1e-12);
            }
        }
    }
    Ok(())
}
