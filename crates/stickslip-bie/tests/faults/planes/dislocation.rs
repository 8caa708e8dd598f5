//! Okada's stress against the equations of elasticity.

use nalgebra::{Matrix3, Vector3};
use stickslip_bie::RectangularDislocation;

use super::POISSON;
use crate::{MEDIUM, Outcome};

const DIPS: [f64; 6] = [90.0, 89.9999, 89.0, 60.0, 30.0, 5.0];

fn patch(dip: f64, top: f64) -> Outcome<RectangularDislocation> {
    Ok(RectangularDislocation::new(
        [-2.0, 3.0],
        [top, top + 4.0],
        dip,
        MEDIUM.shear_modulus,
        POISSON,
    )?)
}

#[test]
fn the_surface_is_free() -> Outcome {
    for dip in DIPS {
        for slip in [[1.0, 0.0], [0.0, 1.0]] {
            let patch = patch(dip, 0.7)?;
            for at in [
                [0.3, 0.4, 0.0],
                [-4.0, -1.0, 0.0],
                [7.0, -3.0, 0.0],
                [30.0, 2.0, 0.0],
            ] {
                let stress = patch.stress(slip, at);
                let traction = stress.column(2).amax();
                assert!(
                    traction < 1e-12 * MEDIUM.shear_modulus,
                    "{dip}: {traction:e}"
                );
                assert!((stress - stress.transpose()).amax() <= 1e-15 * stress.amax());
            }
        }
    }
    Ok(())
}

/// `div sigma = 0`, by central differences of fourth order.
#[test]
fn stress_is_in_equilibrium() -> Outcome {
    let step = 1e-2;
    for dip in DIPS {
        for slip in [[1.0, 0.0], [0.0, 1.0]] {
            let patch = patch(dip, 0.7)?;
            for at in [
                [0.3, 1.4, -2.0],
                [-4.0, -1.0, -0.5],
                [7.0, -3.0, -6.0],
                [1.0, -6.0, -1.5],
            ] {
                let mut divergence = Vector3::zeros();
                let mut largest = 0.0_f64;
                for axis in 0..3 {
                    let stress = |steps: f64| -> Matrix3<f64> {
                        let mut moved = at;
                        moved[axis] += steps * step;
                        patch.stress(slip, moved)
                    };
                    let derivative = (8.0 * (stress(1.0) - stress(-1.0)) - stress(2.0)
                        + stress(-2.0))
                        / (12.0 * step);
                    divergence += derivative.column(axis);
                    largest = largest.max(derivative.amax());
                }
                let error = divergence.amax() / largest;
                assert!(error < 1e-6, "{dip} {at:?}: {error:e}");
            }
        }
    }
    Ok(())
}

/// The strain is compatible: the incompatibility of a stress that solves Beltrami and Michell's equation for the trace,
/// `laplace(trace) = 0`.
#[test]
fn the_pressure_is_harmonic() -> Outcome {
    let step = 2e-2;
    for dip in DIPS {
        for slip in [[1.0, 0.0], [0.0, 1.0]] {
            let patch = patch(dip, 0.7)?;
            for at in [[0.3, 1.4, -2.0], [-4.0, -1.0, -0.5], [7.0, -3.0, -6.0]] {
                let (mut sum, mut largest) = (0.0, 0.0_f64);
                for axis in 0..3 {
                    let trace = |steps: f64| {
                        let mut moved = at;
                        moved[axis] += steps * step;
                        patch.stress(slip, moved).trace()
                    };
                    let near = trace(1.0) + trace(-1.0);
                    let far = trace(2.0) + trace(-2.0);
                    let second = (16.0 * near - far - 30.0 * trace(0.0)) / 12.0;
                    sum += second;
                    largest = largest.max(second.abs());
                }
                assert!(
                    sum.abs() < 1e-4 * largest,
                    "{dip} {at:?}: {:e}",
                    sum / largest
                );
            }
        }
    }
    Ok(())
}

/// Dips that hardly differ have stresses that hardly differ: nothing is divided by the cosine.
#[test]
fn nearly_vertical_planes_are_vertical() -> Outcome {
    let at = [1.0, -2.0, -1.5];
    for slip in [[1.0, 0.0], [0.0, 1.0]] {
        let exact = patch(90.0, 0.7)?.stress(slip, at);
        for tilt in [1e-12, 1e-9, 1e-7, 1e-5] {
            let found = patch(90.0 - tilt, 0.7)?.stress(slip, at);
            let error = (found - exact).amax() / exact.amax();
            assert!(error < 0.2 * tilt + 1e-13, "{tilt:e}: {error:e}");
        }
    }
    Ok(())
}

/// On the continuations of its edges the stress is that beside them, and rounding does not grow.
#[test]
fn edges_go_on_without_a_mark() -> Outcome {
    for dip in DIPS {
        let (patch, angle) = (patch(dip, 1.0)?, dip.to_radians());
        for (x, down) in [
            (5.0, 1.0),
            (-5.0, 1.0),
            (5.0, 5.0),
            (-5.0, 5.0),
            (3.0, 0.4),
            (3.0, 7.0),
            (-2.0, 0.4),
            (-2.0, 7.0),
        ] {
            let at = [x, -down * angle.cos(), -down * angle.sin()];
            let on = patch.stress([1.0, 0.5], at);
            for off in [1e-13, 1e-10, 1e-8] {
                let beside = patch.stress([1.0, 0.5], at.map(|x| x + off));
                let error = (on - beside).amax() / beside.amax();
                assert!(
                    error < 30.0 * off + 1e-12,
                    "{dip} {x} {down} {off}: {error:e}"
                );
            }
        }
    }
    Ok(())
}
