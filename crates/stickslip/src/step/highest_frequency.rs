//! The step limit of an explicit scheme.

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{ConjugateGradients, LinearSolver, Operator, SolveError};

use super::{all_directions, sum};
use crate::numerics::NUMERICS;

/// The highest angular frequency of `M u'' + A u = 0` with the fixed components at rest [rad/s]: the
/// method of Lanczos in the inner product of `M`.
pub(crate) fn highest_frequency<Op: Operator<C>, const C: usize>(
    stiffness: &Op,
    mass: &Op::Mass,
    fixed: &[[bool; C]],
) -> Result<f64, SolveError> {
    let mut inverse = ConjugateGradients::default();
    inverse.prepare(mass, fixed)?;
    let size = stiffness.vertex_count();
    let zeros = || vec![SVector::<f64, C>::zeros(); size];
    let (mut image, mut weighted, mut next, mut last) = (zeros(), zeros(), zeros(), zeros());
    let mut q = zeros();
    all_directions(&mut q, fixed);
    let dot = |a: &[SVector<f64, C>], b: &[SVector<f64, C>]| -> f64 {
        sum(a.iter().zip(b).map(|(a, b)| a.dot(b)))
    };
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut norm = mass.norm(&q);
    let mut highest = 0.0;
    while norm > 0.0 && diagonal.len() < NUMERICS.lanczos_steps {
        for (q, last) in q.iter_mut().zip(&mut last) {
            *q /= norm;
            std::mem::swap(q, last);
        }
        // `last` is the new direction, `q` the one before.
        image.fill(SVector::zeros());
        stiffness.multiply_add(1.0, &last, &mut image);
        next.fill(SVector::zeros());
        inverse.solve(mass, &image, &mut next)?;
        let alpha = dot(&image, &last);
        let beta = beside.last().copied().unwrap_or(0.0);
        for ((next, last), before) in next.iter_mut().zip(&last).zip(&q) {
            *next -= last * alpha + before * beta;
        }
        diagonal.push(alpha);
        let eigenvalue = largest(&diagonal, &beside);
        if (eigenvalue - highest).abs() <= NUMERICS.eigenvalue_change * eigenvalue {
            highest = eigenvalue;
            break;
        }
        highest = eigenvalue;
        weighted.fill(SVector::zeros());
        mass.multiply_add(1.0, &next, &mut weighted);
        norm = dot(&next, &weighted).max(0.0).sqrt();
        beside.push(norm);
        std::mem::swap(&mut q, &mut next);
    }
    Ok(highest.max(0.0).sqrt())
}

/// The largest eigenvalue of a symmetric tridiagonal matrix.
fn largest(diagonal: &[f64], beside: &[f64]) -> f64 {
    let size = diagonal.len();
    let matrix = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    });
    matrix.symmetric_eigenvalues().max()
}
