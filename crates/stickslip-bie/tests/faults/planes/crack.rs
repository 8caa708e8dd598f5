//! A penny-shaped crack.

use std::f64::consts::PI;

use nalgebra::{DVector, Vector1};
use stickslip_bie::{Cells, PlaneFault, Rectangles};
use stickslip_solvers::Matrix;

use super::POISSON;
use crate::{MEDIUM, Outcome};

/// Slip in the middle for a stress drop of 1 Pa, by conjugate gradients on the cells inside the circle.
fn slip_of_the_middle(per_radius: usize, rake: f64) -> Outcome<f64> {
    let n = 2 * per_radius;
    let line = Cells::new([-1.0, 1.0], n)?;
    let cells = Rectangles::new(line, line);
    let fault = PlaneFault::whole_space(cells, MEDIUM, POISSON)?.with_rake(rake)?;
    let stiffness = fault.stiffness();
    let crack = fault.section(|[x, y]| x.hypot(y) < 1.0)?;
    let product = |x: &DVector<f64>| {
        let mut slip = vec![Vector1::zeros(); n * n];
        let mut force = slip.clone();
        for (&cell, &x) in crack.vertices().iter().zip(x) {
            slip[cell][0] = x;
        }
        stiffness.multiply_add(1.0, &slip, &mut force);
        let forces = crack.vertices().iter().map(|&cell| force[cell][0]);
        DVector::from_iterator(x.len(), forces)
    };
    let load = DVector::from_element(crack.vertices().len(), cells.area());
    let (mut slip, mut residual) = (load.clone() * 0.0, load.clone());
    let mut direction = residual.clone();
    for _ in 0..200 {
        let square = residual.norm_squared();
        let force = product(&direction);
        let step = square / direction.dot(&force);
        slip.axpy(step, &direction, 1.0);
        residual.axpy(-step, &force, 1.0);
        if residual.norm() < 1e-10 * load.norm() {
            let place = crack
                .vertices()
                .binary_search(&cells.index([per_radius; 2]));
            return Ok(slip[place.map_err(|_| "no middle")?]);
        }
        direction = &residual + direction * (residual.norm_squared() / square);
    }
    Err("conjugate gradients do not converge".into())
}

/// `8 (1 - nu)/(pi (2 - nu)) (drop R/mu) sqrt(1 - r^2/R^2)` in a crack of radius `R` (J. Eshelby, Proc. R. Soc. A 241
/// (1957)); too large on cells inside the circle by 2.4, 1.3, .50 % for 10, 20, 40 cells per radius, as found by an
/// independent program.
#[test]
fn a_penny_slips_as_an_ellipsoid() -> Outcome {
    let factor = 8.0 * (1.0 - POISSON) / (PI * (2.0 - POISSON)) / MEDIUM.shear_modulus;
    for (per_radius, too_large) in [(10, 0.024), (20, 0.013), (40, 0.005)] {
        for rake in [0.0, 90.0] {
            let r = (0.5 / per_radius as f64) * 2.0_f64.sqrt();
            let exact = factor * (1.0 - r * r).sqrt();
            let error = slip_of_the_middle(per_radius, rake)? / exact - 1.0;
            assert!(
                (error - too_large).abs() < 1.5e-3,
                "{per_radius} {rake}: {error}"
            );
        }
    }
    Ok(())
}
