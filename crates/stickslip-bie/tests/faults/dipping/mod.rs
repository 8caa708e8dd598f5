//! Thrust and normal faults below a free surface.

mod closed_forms;
mod operators;

use std::f64::consts::PI;

use nalgebra::{Complex, DMatrix};
use stickslip_bie::{Cells, DippingFault, KernelError, Sense};

use crate::{MEDIUM, Outcome};

const POISSON_RATIO: f64 = 0.25;

fn thrust(cells: Cells, dip: f64) -> Result<DippingFault, KernelError> {
    DippingFault::new(cells, MEDIUM, POISSON_RATIO, dip, Sense::Thrust)
}

/// Shear and normal stress (compression positive) per `mu/(4 pi (1 - nu))` at the distance `s` down dip of a dislocation
/// at `c`, by Kolosov's and Muskhelishvili's potentials as sums, with derivatives by the rule of the quotient.
///
/// The components are resolved by vectors, not by turned axes.
fn traction(dip: f64, s: f64, c: f64) -> [f64; 2] {
    let i = Complex::new(0.0, 1.0);
    let down = Complex::from_polar(1.0, -dip.to_radians());
    let (z, z0) = (down * s, down * c);
    let b = i * -down;
    let (d, e) = (z - z0, z - z0.conj());
    let (phi0, slope0) = (b / d, -b / (d * d));
    let psi0 = b.conj() / d + b * z0.conj() / (d * d);
    let reflected = [
        b.conj() / e,
        -b.conj() / (e * e),
        b.conj() * 2.0 / (e * e * e),
    ];
    let [psi, psi_slope] = [
        b / e + b.conj() * z0 / (e * e),
        -b / (e * e) - b.conj() * z0 * 2.0 / (e * e * e),
    ];
    let phi1 = -(reflected[0] + z * reflected[1] + psi);
    let slope1 = -(reflected[1] * 2.0 + z * reflected[2] + psi_slope);
    let psi1 = -reflected[0] - phi1 - z * slope1;
    let sum = 4.0 * (phi0 + phi1).re;
    let difference = (z.conj() * (slope0 + slope1) + psi0 + psi1) * 2.0;
    let (sxx, syy, sxy) = (
        0.5 * (sum - difference.re),
        0.5 * (sum + difference.re),
        0.5 * difference.im,
    );
    let (sine, cosine) = dip.to_radians().sin_cos();
    // Up dip, and into the hanging wall.
    let (up, normal) = ([-cosine, sine], [sine, cosine]);
    let force = [
        sxx * normal[0] + sxy * normal[1],
        sxy * normal[0] + syy * normal[1],
    ];
    [
        up[0] * force[0] + up[1] * force[1],
        -(normal[0] * force[0] + normal[1] * force[1]),
    ]
}

/// `K` and `N`, entry by entry.
fn matrices(fault: &DippingFault) -> [DMatrix<f64>; 2] {
    let (cells, unit) = (
        fault.cells(),
        MEDIUM.shear_modulus / (4.0 * PI * (1.0 - POISSON_RATIO)),
    );
    let edge = |j: usize| cells.ends()[0] + j as f64 * cells.length();
    let entry = |i: usize, j: usize, part: usize| {
        let at = |c: f64| traction(fault.dip(), cells.center(i), c)[part];
        unit * cells.length() * (at(edge(j)) - at(edge(j + 1)))
    };
    let matrix = |part| DMatrix::from_fn(cells.count(), cells.count(), |i, j| entry(i, j, part));
    [-matrix(0), matrix(1)]
}

#[test]
fn faults_that_are_none_are_refused() -> Outcome {
    let cells = Cells::new([0.0, 1.0], 2)?;
    let refused = |cells, rock, nu, dip, what: &str, value: f64| {
        let error = DippingFault::new(cells, rock, nu, dip, Sense::Normal).expect_err("accepted");
        assert_eq!((error.what, error.value.to_bits()), (what, value.to_bits()));
        error
    };
    for dip in [0.0, -30.0, 90.1, f64::NAN, f64::INFINITY] {
        let error = refused(cells, MEDIUM, 0.25, dip, "dip [degrees]", dip);
        assert_eq!(error.bound, Some(90.0));
    }
    let error = refused(cells, MEDIUM, 0.25, 120.0, "dip [degrees]", 120.0);
    assert_eq!(
        error.to_string(),
        "dip [degrees] must be above 0 and at most 90, is 120"
    );
    for nu in [-1.0, 0.5, f64::NAN] {
        refused(cells, MEDIUM, nu, 30.0, "Poisson's ratio", nu);
    }
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (mut soft, mut slow) = (MEDIUM, MEDIUM);
        soft.shear_modulus = wrong;
        slow.shear_wave_speed = wrong;
        refused(cells, soft, 0.25, 30.0, "shear modulus", wrong);
        refused(cells, slow, 0.25, 30.0, "shear wave speed", wrong);
    }
    let above = Cells::new([-0.5, 1.0], 2)?;
    let what = "distance [m] down dip of the fault's upper end";
    refused(above, MEDIUM, 0.25, 30.0, what, -0.5);
    Ok(())
}
