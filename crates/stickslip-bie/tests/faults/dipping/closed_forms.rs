//! Stresses that are known.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use stickslip_bie::{Cells, DippingFault, Fault, Sense};
use stickslip_solvers::Matrix;

use super::{POISSON_RATIO, thrust, traction};
use crate::{IN_PLANE, MEDIUM, Outcome, dense, field, flat};

/// Deep below the surface it is far away: slip of a fault in a whole space, at constant normal stress. The images are
/// of second order in the length over the depth.
#[test]
fn deep_faults_are_in_a_whole_space() -> Outcome {
    let whole = Fault::whole_space(Cells::new([0.0, 1.0], 24)?, MEDIUM, IN_PLANE)?;
    let whole = dense(&whole.stiffness());
    for dip in [90.0, 60.0, 30.0] {
        for depth in [1e2, 1e3] {
            let fault = thrust(Cells::new([depth, depth + 1.0], 24)?, dip)?;
            // Entries are forces of cells of 1/24: the difference of ends over a distance of twice the depth.
            let bound = whole.amax() / (24.0 * depth * dip.to_radians().sin()).powi(2);
            let images = (DMatrix::from(&fault.stiffness()) - &whole).amax();
            assert!(
                images > 0.0 && images < bound,
                "{dip} {depth}: {images:e} of {bound:e}"
            );
            let normal = DMatrix::from(&fault.normal_stiffness()).amax() / 24.0;
            assert!(normal < bound, "{dip} {depth}: {normal:e} of {bound:e}");
        }
    }
    Ok(())
}

/// `tau = (mu/(2 pi (1 - nu))) [-1/(s - c) + 1/(s + c) + 2 c/(s + c)^2 - 4 c^2/(s + c)^3]`, upper minus lower end.
#[test]
fn vertical_faults_have_the_closed_form_and_no_normal_stress() -> Outcome {
    for begin in [0.0, 300.0] {
        let cells = Cells::new([begin, 4e3], 90)?;
        let fault = thrust(cells, 90.0)?;
        let modulus = MEDIUM.shear_modulus / (2.0 * PI * (1.0 - POISSON_RATIO));
        let of_end = |s: f64, c: f64| {
            let sum = s + c;
            let images = 1.0 / sum + 2.0 * c / sum.powi(2) - 4.0 * c.powi(2) / sum.powi(3);
            modulus * (images - 1.0 / (s - c))
        };
        let length = cells.length();
        let exact = DMatrix::from_fn(90, 90, |i, j| {
            let (s, upper) = (cells.center(i), begin + j as f64 * length);
            -length * (of_end(s, upper) - of_end(s, upper + length))
        });
        let error = DMatrix::from(&fault.stiffness()) - &exact;
        assert!(error.amax() < 1e-10 * exact.amax(), "{:e}", error.amax());
        let normal = DMatrix::from(&fault.normal_stiffness()) * length;
        assert!(normal.amax() < 1e-14 * exact.amax(), "{:e}", normal.amax());
    }
    Ok(())
}

/// A fault that slips by the same everywhere, its plate included, is a rigid motion: slip of all cells of a fault from
/// the surface down stresses as the plate beyond the lower end does, with the opposite sign. To rounding with dense
/// images, those of few cells.
#[test]
fn a_plate_beyond_the_lower_end_is_a_dislocation_there() -> Outcome {
    let (rate, time) = (1e-9, 1e7);
    for (count, rounding) in [(20, 1e-14), (150, 1e-10)] {
        for dip in [90.0, 60.0, 30.0, 12.0] {
            for sense in [Sense::Thrust, Sense::Normal] {
                let cells = Cells::new([0.0, 40e3], count)?;
                let fault = DippingFault::new(cells, MEDIUM, POISSON_RATIO, dip, sense)?;
                let (mut shear, mut clamped) = (field(&vec![0.0; count]), vec![0.0; count]);
                fault.plate_loading(rate)(time, &mut shear);
                let moved = field(&vec![rate * time; count]);
                fault
                    .normal_stiffness()
                    .multiply_add(-1.0, &moved, &mut clamped);
                let unit = MEDIUM.shear_modulus / (4.0 * PI * (1.0 - POISSON_RATIO));
                let sign = if sense == Sense::Thrust { 1.0 } else { -1.0 };
                let bound = rounding * MEDIUM.shear_modulus * rate * time;
                for i in 0..count {
                    let [tau, sigma] = traction(dip, cells.center(i), 40e3);
                    let (stress, length) = (unit * rate * time, cells.length());
                    assert!(
                        (shear[i][0] - length * stress * tau).abs() < bound,
                        "{dip} {i}"
                    );
                    let clamping = sign * stress * sigma;
                    assert!(length * (clamped[i] - clamping).abs() < bound, "{dip} {i}");
                }
                // Cells that creep with the plate are not stressed.
                let loaded = shear[count - 1][0];
                fault.stiffness().multiply_add(-1.0, &moved, &mut shear);
                assert!(flat(&shear).amax() < 1e-12 * loaded.abs());
            }
        }
    }
    Ok(())
}

/// Shallow slip of a thrust unclamps its own cell, most at small dips; slip at depth clamps what is deeper.
///
/// The two values are of an independent computation, which agreed with the stress of long rectangles by Y. Okada (Bull.
/// Seismol. Soc. Am. 82 (1992)).
#[test]
fn shallow_slip_of_a_thrust_unclamps_and_of_a_normal_fault_clamps() -> Outcome {
    for (dip, known) in [(60.0, -0.01286), (30.0, -0.16336)] {
        let cells = Cells::new([0.0, 10e3], 100)?;
        let (own, other) = (
            thrust(cells, dip)?,
            DippingFault::new(cells, MEDIUM, POISSON_RATIO, dip, Sense::Normal)?,
        );
        let normal = DMatrix::from(&own.normal_stiffness());
        assert!((normal[(0, 0)] * cells.length() / MEDIUM.shear_modulus - known).abs() < 0.6e-5);
        assert_eq!(DMatrix::from(&other.normal_stiffness()), -normal);
        assert_eq!(
            DMatrix::from(&other.stiffness()),
            DMatrix::from(&own.stiffness())
        );
    }
    Ok(())
}

/// The energy of slip is positive up to the asymmetry of the matrix, which falls below the surface.
#[test]
fn asymmetry_is_that_of_the_first_rows() -> Outcome {
    for dip in [90.0, 60.0, 30.0] {
        let matrix = DMatrix::from(&thrust(Cells::new([0.0, 10e3], 60)?, dip)?.stiffness());
        let skew = (&matrix - matrix.transpose()) / matrix[(30, 30)];
        assert!(
            skew.amax() > 1e-3 && skew.amax() < 0.1,
            "{dip}: {:e}",
            skew.amax()
        );
        let deep = skew.view((10, 10), (50, 50)).amax();
        assert!(deep < 1e-4, "{dip}: {deep:e}");
        let eigenvalues = ((&matrix + matrix.transpose()) * 0.5).symmetric_eigenvalues();
        assert!(eigenvalues.min() > 0.0, "{dip}: {:e}", eigenvalues.min());
    }
    Ok(())
}

/// `mu/(2 c_s)` on a cell, whatever the dip.
#[test]
fn radiation_damps_each_cell_alone() -> Outcome {
    let fault = thrust(Cells::new([0.0, 1e3], 5)?, 40.0)?;
    let damping = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * 200.0;
    let exact = DMatrix::from_diagonal(&DVector::from_element(5, damping));
    assert!((DMatrix::from(&fault.radiation_damping()) - exact).amax() < 1e-14 * damping);
    assert_eq!(fault.section([200.0, 600.0])?.vertices(), [1, 2]);
    Ok(())
}
