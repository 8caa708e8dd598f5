//! The step limit of an explicit scheme.

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{ConjugateGradients, LinearSolver, Operator, SolveError};

use super::{all_directions, sum};
use crate::numerics::NUMERICS;

/// The highest angular frequency of `M u'' + A u = 0` with the fixed components at rest [rad/s].
pub(crate) fn highest_frequency<Op: Operator<C>, const C: usize>(
    stiffness: &Op,
    mass: &Op::Mass,
    fixed: &[[bool; C]],
) -> Result<f64, SolveError> {
    let mut inverse = ConjugateGradients::default();
    inverse.prepare(mass, fixed)?;
    let mut start = vec![SVector::zeros(); stiffness.vertex_count()];
    all_directions(&mut start, fixed);
    let solve = |image: &[_], next: &mut [_]| inverse.solve(mass, image, next).map(|_| ());
    let multiply = |field: &[_], product: &mut [_]| mass.multiply_add(1.0, field, product);
    let change = NUMERICS.eigenvalue_change;
    let highest = highest_eigenvalue(stiffness, start, solve, multiply, change)?;
    Ok(highest.max(0.0).sqrt())
}

/// The highest eigenvalue of `A x = lambda D x` by the method of Lanczos in the inner product of `D`, of which `solve` is
/// the inverse and `multiply` the product; to a relative `change` of one step.
pub(crate) fn highest_eigenvalue<Op: Operator<C>, E, const C: usize>(
    stiffness: &Op,
    start: Vec<SVector<f64, C>>,
    mut solve: impl FnMut(&[SVector<f64, C>], &mut [SVector<f64, C>]) -> Result<(), E>,
    multiply: impl Fn(&[SVector<f64, C>], &mut [SVector<f64, C>]),
    change: f64,
) -> Result<f64, E> {
    let size = stiffness.vertex_count();
    let zeros = || vec![SVector::<f64, C>::zeros(); size];
    let (mut image, mut weighted, mut next, mut last) = (zeros(), zeros(), zeros(), zeros());
    let mut q = start;
    let dot = |a: &[SVector<f64, C>], b: &[SVector<f64, C>]| -> f64 {
        sum(a.iter().zip(b).map(|(a, b)| a.dot(b)))
    };
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    multiply(&q, &mut weighted);
    let mut norm = dot(&q, &weighted).max(0.0).sqrt();
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
        solve(&image, &mut next)?;
        let alpha = dot(&image, &last);
        let beta = beside.last().copied().unwrap_or(0.0);
        for ((next, last), before) in next.iter_mut().zip(&last).zip(&q) {
            *next -= last * alpha + before * beta;
        }
        diagonal.push(alpha);
        let eigenvalue = largest(&diagonal, &beside);
        if (eigenvalue - highest).abs() <= change * eigenvalue {
            highest = eigenvalue;
            break;
        }
        highest = eigenvalue;
        weighted.fill(SVector::zeros());
        multiply(&next, &mut weighted);
        norm = dot(&next, &weighted).max(0.0).sqrt();
        beside.push(norm);
        std::mem::swap(&mut q, &mut next);
    }
    Ok(highest)
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
