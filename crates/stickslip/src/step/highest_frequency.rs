//! The step limit of an explicit scheme.

use nalgebra::{DMatrix, SVector};
use stickslip_solvers::{ConjugateGradients, LinearSolver, Matrix, Ranks, SolveError};

use super::local_steps::{interval, weights_from};
use crate::body::Matrices;
use crate::numerics::NUMERICS;
use crate::sums::{all_directions, sum};

/// The largest stable step `tau` \[s\] of an explicit scheme with a largest `omega tau` of `bound`. With lagged
/// viscosities `C` it is that at which `bound^2 M - bound tau C - tau^2 A` loses its definiteness: for the quotients
/// `k`, `c` and `m` of a mode, central differences satisfy
///
/// ```text
/// m (z^2 - 2 z + 1) + tau c (z - 1) + tau^2 k z = 0
/// ```
///
/// whose roots are in the unit circle as long as `4 m - 2 tau c - tau^2 k > 0`. Viscosities in the matrix of the step add
/// `tau d (z^2 - 1)/2`, and change nothing at `z = -1`.
///
/// With levels of local steps it is the least over the levels: `2^l` steps are a step of the cells of level `l` and above.
pub(crate) fn step_limit<const C: usize>(
    matrices: &dyn Matrices<C>,
    mass: &dyn Matrix<C>,
    fixed: &[[bool; C]],
    bound: f64,
) -> Result<f64, SolveError> {
    let mut least = f64::INFINITY;
    for level in 0..matrices.stiffness().levels() {
        let limit = limit_from(level, matrices, mass, fixed, bound)?;
        least = least.min(limit / interval(level) as f64);
    }
    Ok(least)
}

/// The largest stable step of the cells of a level and above by themselves \[s\].
fn limit_from<const C: usize>(
    level: usize,
    matrices: &dyn Matrices<C>,
    mass: &dyn Matrix<C>,
    fixed: &[[bool; C]],
    bound: f64,
) -> Result<f64, SolveError> {
    let weights = weights_from(level);
    let eigenvalue = |slowness: f64| {
        largest_eigenvalue(mass, fixed, |x, image| {
            (matrices.stiffness()).multiply_add_levels(&weights, 1.0, x, image);
            if slowness > 0.0 {
                matrices.lagged_viscosities().for_each(|viscosity| {
                    viscosity.multiply_add_levels(&weights, slowness, x, image);
                });
            }
        })
    };
    let undamped = eigenvalue(0.0)?;
    let highest = undamped.sqrt();
    if matrices.lagged_viscosities().next().is_none() {
        return Ok(bound / highest);
    }
    // `h(s)`, the eigenvalue with `s C` added, is convex. `q = bound/tau` solves `q^2 = h(q)`, and a line through two
    // values of `h` lies below it beyond them: its solutions increase to that.
    let (mut before, mut q) = ((0.0, undamped), highest);
    if q == 0.0 {
        q = 1.0;
    }
    for _ in 0..NUMERICS.evaluations {
        let now = (q, eigenvalue(q)?);
        let slope = (now.1 - before.1) / (now.0 - before.0);
        let at_zero = now.1 - slope * now.0;
        let next = 0.5 * (slope + (slope * slope + 4.0 * at_zero).max(0.0).sqrt());
        let has_converged = (next - q).abs() <= NUMERICS.eigenvalue_change * next;
        (before, q) = (now, next);
        if has_converged {
            break;
        }
    }
    Ok(bound / q)
}

/// The largest eigenvalue of `A x = lambda M x` with the fixed components at rest, 0 or more, by products that add `A x`
/// to a field: the method of Lanczos in the inner product of `M`.
fn largest_eigenvalue<const C: usize>(
    mass: &dyn Matrix<C>,
    fixed: &[[bool; C]],
    add_product: impl Fn(&[SVector<f64, C>], &mut [SVector<f64, C>]),
) -> Result<f64, SolveError> {
    let mut inverse = ConjugateGradients::default();
    inverse.prepare(mass, fixed)?;
    let mut start = vec![SVector::zeros(); mass.vertex_count()];
    all_directions(&mut start, fixed);
    let solve = |image: &[_], next: &mut [_]| inverse.solve(mass, image, next).map(|_| ());
    let multiply = |field: &[_], product: &mut [_]| mass.multiply_add(1.0, field, product);
    let change = NUMERICS.eigenvalue_change;
    let ranks = mass.ranks();
    let highest = highest_eigenvalue(add_product, (start, &ranks), solve, multiply, change)?;
    Ok(highest.max(0.0))
}

/// The highest eigenvalue of `A x = lambda D x` by the method of Lanczos in the inner product of `D`: `add_product` adds
/// `A x` to a field, `solve` is the inverse of `D` and `multiply` its product; to a relative `change` of one step. The field
/// may be spread over processes.
pub(crate) fn highest_eigenvalue<E, const C: usize>(
    add_product: impl Fn(&[SVector<f64, C>], &mut [SVector<f64, C>]),
    (start, ranks): (Vec<SVector<f64, C>>, &Ranks),
    mut solve: impl FnMut(&[SVector<f64, C>], &mut [SVector<f64, C>]) -> Result<(), E>,
    multiply: impl Fn(&[SVector<f64, C>], &mut [SVector<f64, C>]),
    change: f64,
) -> Result<f64, E> {
    let size = start.len();
    let zeros = || vec![SVector::<f64, C>::zeros(); size];
    let (mut image, mut weighted, mut next, mut last) = (zeros(), zeros(), zeros(), zeros());
    let mut q = start;
    let dot = |a: &[SVector<f64, C>], b: &[SVector<f64, C>]| -> f64 {
        ranks.sum(sum(a.iter().zip(b).map(|(a, b)| a.dot(b))))
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
        add_product(&last, &mut image);
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
