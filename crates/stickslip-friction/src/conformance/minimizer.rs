//! Minimisation against positive definite blocks.

use nalgebra::{SMatrix, SVector};

use super::{FrictionViolation, samples::directions};
use crate::ConvexPotential;

/// Blocks with condition numbers 1 and 1000, along the axes and rotated.
fn blocks<const C: usize>() -> Vec<SMatrix<f64, C, C>> {
    let graded = SMatrix::from_diagonal(&SVector::<f64, C>::from_fn(|i, _| match i {
        0 => 1.0,
        1 => 1e3,
        _ => 30.0,
    }));
    // A reflection.
    let normal = SVector::<f64, C>::from_fn(|i, _| if i == 0 { 1.0 } else { 0.6 });
    let q = SMatrix::identity() - normal * normal.transpose() * (2.0 / normal.norm_squared());
    let turned = q * graded * q.transpose();
    vec![
        SMatrix::identity(),
        graded,
        (turned + turned.transpose()) * 0.5,
    ]
}

pub(super) fn check<P: ConvexPotential<C> + ?Sized, const C: usize>(
    potential: &P,
    speed: f64,
    force: f64,
) -> Result<(), FrictionViolation> {
    for block in blocks::<C>() {
        for stiffness in [-12, -6, -2, 0, 2, 6, 12].map(|e| force / speed * 10f64.powi(e)) {
            for pull in [-6, -3, -1, 0, 1, 3, 6].map(|e| force * 10f64.powi(e)) {
                for direction in directions::<C>() {
                    check_problem(potential, &(block * stiffness), &(direction * pull))?;
                }
            }
        }
    }
    Ok(())
}

fn check_problem<P: ConvexPotential<C> + ?Sized, const C: usize>(
    potential: &P,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> Result<(), FrictionViolation> {
    let v = potential.minimize(block, force);
    let speed = v.norm();
    let left = force - block * v;
    let model = potential.local_model(&v);
    let smooth = model.smooth.iter().all(|&smooth| smooth);
    // A gradient is known as well as the logarithm of the speed is.
    let curvature = if smooth {
        model.hessian.amax() * speed
    } else {
        0.0
    };
    let size = force.norm() + block.norm() * speed + curvature;
    for d in directions::<C>() {
        let slopes = potential.slope_along(&v, &d);
        let along = left.dot(&d);
        let excess = (along - slopes.upper).max(slopes.lower - along);
        let bound = 1e-12 * size;
        if excess.is_nan() || excess > bound {
            return Err(FrictionViolation::Minimizer {
                what: "force [N] outside of the subdifferential",
                speed,
                force: force.norm(),
                found: excess,
                bound,
            });
        }
    }
    let energy_at =
        |v: &SVector<f64, C>| 0.5 * v.dot(&(block * v)) - force.dot(v) + potential.value(v);
    let terms_at = |v: &SVector<f64, C>| {
        (force.norm() + block.norm() * v.norm()) * v.norm() + potential.value(v).abs()
    };
    let energy = energy_at(&v);
    let free = force.norm() / block.norm();
    for d in directions::<C>() {
        for length in [
            1e-3 * speed,
            -1e-3 * speed,
            speed,
            -speed,
            1e-3 * free,
            -1e-3 * free,
        ] {
            let other = v + d * length;
            let lower = energy_at(&other);
            let terms = terms_at(&v) + terms_at(&other);
            if energy > lower + 1e-12 * terms + f64::MIN_POSITIVE {
                return Err(FrictionViolation::Minimizer {
                    what: "energy [W]",
                    speed,
                    force: force.norm(),
                    found: energy,
                    bound: lower,
                });
            }
        }
    }
    Ok(())
}
