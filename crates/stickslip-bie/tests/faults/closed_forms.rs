//! Stresses that are known.

use std::f64::consts::PI;

use nalgebra::Vector1;
use stickslip_bie::{Cells, Fault, Kernel, Mode};
use stickslip_solvers::Matrix;

use crate::{IN_PLANE, MEDIUM, Outcome, dense, field, flat, kinds};

/// The stress at each centre.
fn stress(fault: &Fault, slip: &[f64]) -> Vec<f64> {
    let mut force = field(&vec![0.0; slip.len()]);
    fault
        .stiffness()
        .multiply_add(-1.0, &field(slip), &mut force);
    force
        .iter()
        .map(|force| force[0] / fault.cells().length())
        .collect()
}

/// A stress drop `d` of an infinite surface: `v = d/(rho c_s)` on one side, twice that across.
#[test]
fn a_sudden_stress_drop_is_radiated() -> Outcome {
    let drop = 1e6;
    let density = MEDIUM.shear_modulus / MEDIUM.shear_wave_speed.powi(2);
    for (fault, share) in kinds(8)?.iter().map(|fault| (fault, fault.share_of_slip())) {
        let length = fault.cells().length();
        let damping = fault.radiation_damping().diagonal_block(3)[(0, 0)];
        let across = drop * length / damping / share;
        let exact = 2.0 * drop / (density * MEDIUM.shear_wave_speed);
        assert!((across / exact - 1.0).abs() < 1e-14);
    }
    Ok(())
}

/// Slip of 1 m on `[s1, s2]`, without and with a free surface, in three shapes of stiffness.
#[test]
fn slip_on_a_part_stresses_the_rest() -> Outcome {
    let (slipping, count) = (3..9, 24);
    let slip: Vec<f64> = (0..count)
        .map(|i| f64::from(u8::from(slipping.contains(&i))))
        .collect();
    let of_slip = |[s1, s2]: [f64; 2], z: f64| {
        MEDIUM.shear_modulus / (2.0 * PI) * (1.0 / (z - s2) - 1.0 / (z - s1))
    };
    let (around, below) = (
        Cells::new([-3e3, 2e3], count)?,
        Cells::new([500.0, 5e3], count)?,
    );
    for (fault, factor, images) in [
        (
            Fault::whole_space(around, MEDIUM, Mode::Antiplane)?,
            1.0,
            false,
        ),
        (
            Fault::whole_space(around, MEDIUM, IN_PLANE)?,
            1.0 / 0.75,
            false,
        ),
        (Fault::half_space(below, MEDIUM)?, 1.0, true),
    ] {
        let cells = *fault.cells();
        let half = 0.5 * cells.length();
        let [s1, s2] = [cells.center(3) - half, cells.center(8) + half];
        let stress = stress(&fault, &slip);
        let largest = stress
            .iter()
            .fold(0.0_f64, |most, stress| most.max(stress.abs()));
        for (i, stress) in stress.iter().enumerate() {
            let z = cells.center(i);
            let mut exact = of_slip([s1, s2], z);
            if images {
                exact += of_slip([-s2, -s1], z);
            }
            assert!((stress - factor * exact).abs() < 1e-12 * largest, "{i}");
        }
    }
    Ok(())
}

/// Creep at `V_p` below a depth `W`, locked above: `(mu V_p/pi) W/(W^2 - z^2)`; nothing where all moves together.
#[test]
fn a_plate_stresses_what_does_not_follow() -> Outcome {
    let (rate, depth, time) = (1e-9, 40e3, 1e6);
    let fault = Fault::half_space(Cells::new([0.0, depth], 400)?, MEDIUM)?;
    let mut load = field(&[0.0; 400]);
    fault.plate_loading(rate)(time, &mut load);
    for i in 0..400 {
        let z = fault.cells().center(i);
        let exact = MEDIUM.shear_modulus * rate / PI * depth / (depth * depth - z * z) * time;
        let stress = load[i][0] / fault.cells().length();
        assert!((stress / exact - 1.0).abs() < 1e-9, "{i}");
    }
    let moved = vec![Vector1::new(rate * time); 400];
    fault.stiffness().multiply_add(-1.0, &moved, &mut load);
    let largest = MEDIUM.shear_modulus * rate * time;
    assert!(load.iter().all(|force| force[0].abs() < 1e-12 * largest));
    Ok(())
}

/// A crack of half length `c` with a stress drop `d`: `(2 d/mu) sqrt(c^2 - x^2)`. Cells of constant slip know its tips
/// to a cell, and slip in its middle to the share of a cell in `c`: of first order.
#[test]
fn a_crack_slips_as_an_ellipse() -> Outcome {
    let (drop, half) = (1e6, 1e3);
    let error = |count: usize| -> Outcome<f64> {
        let fault = Fault::whole_space(Cells::new([-half, half], count)?, MEDIUM, Mode::Antiplane)?;
        let load = flat(&field(&vec![drop * fault.cells().length(); count]));
        let factor = dense(&fault.stiffness()).cholesky().ok_or("indefinite")?;
        let (slip, middle) = (factor.solve(&load), count / 2);
        let x = fault.cells().center(middle);
        let exact = 2.0 * drop / MEDIUM.shear_modulus * (half * half - x * x).sqrt();
        let error = (slip[middle] / exact - 1.0).abs();
        assert!(error < 2.0 / count as f64, "{count}: {error:e}");
        Ok(error)
    };
    let errors = [error(50)?, error(100)?, error(200)?];
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1]).log2() > 0.95, "{errors:?}");
    }
    Ok(())
}

/// `mu abs(k)/2` across the fault, `mu abs(k)` of one body, and `1/(1 - nu)` of that in plane strain.
#[test]
fn modes_of_a_periodic_fault_have_their_stiffness() -> Outcome {
    let (count, length) = (64, 5e3);
    let cells = Cells::new([0.0, length], count)?;
    for (fault, factor) in [
        (Fault::periodic(cells, MEDIUM, Mode::Antiplane)?, 0.5),
        (
            Fault::periodic(cells, MEDIUM, Mode::Antiplane)?.one_sided(),
            1.0,
        ),
        (
            Fault::periodic(cells, MEDIUM, IN_PLANE)?.one_sided(),
            1.0 / 0.75,
        ),
    ] {
        for waves in [0, 1, 7, 31, 32] {
            let k = 2.0 * PI * f64::from(waves) / length;
            let mode = cells.map(|x| (k * (x - cells.center(0))).cos());
            let stress = stress(&fault, &mode);
            for (stress, slip) in stress.iter().zip(&mode) {
                let exact = -factor * MEDIUM.shear_modulus * k * slip;
                let largest = MEDIUM.shear_modulus * 2.0 * PI * 32.0 / length;
                assert!((stress - exact).abs() < 1e-13 * largest, "{waves}");
            }
        }
    }
    Ok(())
}

/// A displacement of half the slip takes the same stress.
#[test]
fn one_body_is_twice_as_stiff_and_damped() -> Outcome {
    let cells = Cells::new([0.0, 5e3], 16)?;
    let (both, one) = (
        Fault::half_space(cells, MEDIUM)?,
        Fault::half_space(cells, MEDIUM)?.one_sided(),
    );
    let operators: [fn(&Fault) -> Kernel; 2] = [Fault::stiffness, Fault::radiation_damping];
    for operator in operators {
        assert_eq!(dense(&operator(&both)) * 2.0, dense(&operator(&one)));
    }
    assert_eq!((both.share_of_slip(), one.share_of_slip()), (1.0, 0.5));
    Ok(())
}
