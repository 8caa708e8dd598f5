//! One load for several problems: what moves on the boundary, and the body that follows.

use std::f64::consts::PI;

use allocation_counter::measure;
use nalgebra::SVector;
use stickslip_solvers::{
    BlockMatrix, Condensed, Energy, FrictionalSolver, Matrix, NonsmoothSolver, Operator, SolveError,
};

use crate::common::{Fallible, Numbers, Problem, REGIMES, Regime, antiplane, block, slider};

/// Changes of the frictional vertices: all alike, smooth, at random, of one vertex.
fn changes<const C: usize>(problem: &Problem<C>) -> Vec<Vec<SVector<f64, C>>> {
    let mut numbers = Numbers(7);
    let count = problem.vertices.len();
    let field = |f: &mut dyn FnMut(usize) -> f64| {
        let mut change = problem.at_rest();
        change.fill(SVector::zeros());
        for (k, &vertex) in problem.vertices.iter().enumerate() {
            for c in (0..C).filter(|&c| !problem.fixed[vertex][c]) {
                change[vertex][c] = f(k);
            }
        }
        change
    };
    vec![
        field(&mut |_| 1e-3),
        field(&mut |k| 1e-6 * (PI * k as f64 / count as f64).sin()),
        field(&mut |_| 1e-9 * numbers.next()),
        field(&mut |k| f64::from(u8::from(k == count / 2))),
    ]
}

/// `sum abs(x_i) abs(A_ij) abs(x_j)`: what the rounding errors of `x . A x` are relative to.
fn terms<const C: usize>(matrix: &BlockMatrix<C>, x: &[SVector<f64, C>]) -> f64 {
    let entries = matrix.iter();
    entries
        .map(|(block, (i, j))| {
            x[i as usize]
                .abs()
                .dot(&(block.abs() * x[j as usize].abs()))
        })
        .sum()
}

/// Measured on the boundary and by extending, a change has the same norm.
///
/// A backward stable elimination solves with `B + F`, `abs(F) <= u abs(B)` up to a moderate factor: relative to
/// `x . B x`, that is `u` times the terms of the energy over it. The norm is at most `equivalence` times the energy, so
/// that a change of the extension by the share `s` of its energy moves the square of its norm by no more than
/// `2 sqrt(s equivalence x.Bx / x.Nx)` of it; the two products add the rounding errors of their own terms.
fn measures_as_it_extends<const C: usize>(
    problem: &Problem<C>,
    norm: &BlockMatrix<C>,
    equivalence: f64,
) -> Fallible {
    let (mut zero, load) = (
        problem.at_rest(),
        vec![SVector::zeros(); problem.load.len()],
    );
    zero.fill(SVector::zeros());
    let energy = Energy {
        load: &load,
        ..problem.energy()
    };
    let mut solver = Condensed::new();
    solver.prepare(&energy)?;
    for change in changes(problem) {
        solver.condense(&energy, &zero)?;
        let extended = solver.change_norm(&energy, norm, &change)?;
        let mut x = change.clone();
        solver.extend(&mut x)?;
        assert_eq!(extended.to_bits(), norm.norm(&x).to_bits());
        let before = solver.counters();
        solver.measure(&energy, norm);
        let measured = solver.change_norm(&energy, norm, &change)?;
        assert_eq!(solver.counters(), before, "a substitution");
        let (own, square) = (energy.operator.quadratic(&x), norm.quadratic(&x));
        let unknowns = problem.fixed.len() as f64 * C as f64;
        let unit = unknowns.sqrt() * f64::EPSILON;
        let share = unit * terms(energy.operator, &x) / own;
        let moved = 2.0 * share * (equivalence * own / square).sqrt();
        let bound = moved + unit * terms(norm, &x) / square;
        let off = (measured / extended - 1.0).abs();
        assert!(
            off <= bound && bound < 1e-6,
            "{measured:e}, {extended:e}: {off:e} > {bound:e}"
        );
        // The operator's own norm is the Schur complement's.
        let by_schur = solver.change_norm(&energy, energy.operator, &change)?;
        let off = (by_schur / own.sqrt() - 1.0).abs();
        assert!(off <= share, "{off:e} > {share:e}");
        assert_eq!(solver.counters(), before, "a substitution");
    }
    assert_eq!(solver.counters().factorizations, 1);
    Ok(())
}

/// Steps from a millionth to a thousand seconds, with and without viscosity, in the plane and in space.
#[test]
fn a_change_is_measured_on_the_boundary() -> Fallible {
    fn check<const C: usize>(mut problem: Problem<C>) -> Fallible {
        for tau in [1e-6, 1e-4, 1e-2, 1.0, 30.0, 1e3] {
            problem.set_time_step(tau);
            let (norm, equivalence) = (problem.norm.clone(), problem.equivalence);
            measures_as_it_extends(&problem, &norm, equivalence)?;
            // Kelvin's damping of a hundredth of a second, which the norm knows nothing of.
            problem.operator.set_combination(&[
                (0.5 * tau + 1e-2, &problem.stiffness),
                (2.0 / tau, &problem.mass),
            ]);
            measures_as_it_extends(&problem, &norm, equivalence)?;
        }
        // Without inertia.
        problem
            .operator
            .set_combination(&[(0.5, &problem.stiffness)]);
        let norm = problem.stiffness.clone();
        measures_as_it_extends(&problem, &norm, 2.0)
    }
    check(slider(2, Regime::Mixed, 1)?)?;
    check(slider(4, Regime::Mixed, 1)?)?;
    check(antiplane(3, Regime::Mixed, 1)?)?;
    check(block(2, Regime::Mixed, 1)?)
}

/// Condensed, minimised and extended a problem is the one that is minimised at once, whatever came before; the interior
/// moves last.
#[test]
fn in_parts_the_same_as_at_once() -> Fallible {
    fn check<const C: usize>(problem: &Problem<C>) -> Fallible {
        let (energy, stopping) = (problem.energy(), problem.stopping(1e-10 * problem.size()));
        let mut solver = Condensed::new();
        solver.prepare(&energy)?;
        let mut at_once = problem.nearby(1e-3, 5);
        let mut v = at_once.clone();
        let start = v.clone();
        let report = solver.minimize(&energy, &stopping, &mut at_once)?;
        let load: Vec<_> = problem.load.iter().map(|load| load * 2.0).collect();
        let other = Energy {
            load: &load,
            ..energy
        };
        solver.condense(&other, &v)?;
        solver.minimize_condensed(&other, &stopping, &mut problem.at_rest())?;
        solver.condense(&energy, &v)?;
        let before = solver.counters();
        assert_eq!(
            solver.minimize_condensed(&energy, &stopping, &mut v)?,
            report
        );
        for (vertex, (v, start)) in v.iter().zip(&start).enumerate() {
            assert!(v == start || problem.vertices.contains(&vertex), "{vertex}");
        }
        // The potentials may change in between, and the body may follow more than once.
        let mut w = v.clone();
        solver.extend(&mut w)?;
        solver.minimize_condensed(&energy, &stopping, &mut w)?;
        solver.extend(&mut v)?;
        assert_eq!(v, at_once);
        let after = solver.counters();
        assert_eq!(after.forward_substitutions, before.forward_substitutions);
        assert_eq!(
            after.backward_substitutions,
            before.backward_substitutions + 2
        );
        Ok(())
    }
    for regime in REGIMES {
        check(&slider(2, regime, 1)?)?;
        check(&antiplane(2, regime, 1)?)?;
        check(&block(1, regime, 1)?)?;
    }
    Ok(())
}

/// Nothing is solved with a load that was not condensed, or no more.
#[test]
fn without_a_load_nothing_is_solved() -> Fallible {
    let problem = slider(1, Regime::Mixed, 1)?;
    let (energy, stopping) = (problem.energy(), problem.stopping(1e-9));
    let mut solver = Condensed::new();
    let mut v = problem.at_rest();
    let size = v.len();
    let refused = Err(SolveError::SizeMismatch {
        expected: 0,
        found: size,
    });
    assert_eq!(solver.condense(&energy, &v), refused);
    assert_eq!(
        solver.change_norm(&energy, &problem.norm, &v).map(|_| ()),
        refused
    );
    for case in 0..3 {
        solver.prepare(&energy)?;
        match case {
            1 => drop(solver.minimize(&energy, &stopping, &mut v)?),
            2 => {
                solver.condense(&energy, &v)?;
                let mut load = problem.load.clone();
                load[size / 2].fill(f64::NAN);
                let spoiled = Energy {
                    load: &load,
                    ..energy
                };
                assert!(solver.condense(&spoiled, &v).is_err());
            }
            _ => {}
        }
        let before = v.clone();
        let minimized = solver.minimize_condensed(&energy, &stopping, &mut v);
        assert_eq!(minimized.map(|_| ()), refused, "{case}");
        assert_eq!(solver.extend(&mut v), refused, "{case}");
        assert_eq!(v, before);
    }
    Ok(())
}

/// Memory is taken by the first measurement with an operator, kept with its factor, and within the limit; another norm
/// replaces what is derived from the first.
#[test]
fn what_measures_is_kept_with_the_factor() -> Fallible {
    let mut problem = slider(3, Regime::Mixed, 1)?;
    let change = changes(&problem).swap_remove(1);
    let measured = |solver: &mut Condensed<2>, problem: &Problem<2>, norm: &BlockMatrix<2>| {
        let energy = problem.energy();
        let mut length = Err(SolveError::SizeMismatch {
            expected: 0,
            found: 0,
        });
        let info = measure(|| {
            length = (solver.prepare(&energy))
                .and_then(|()| solver.condense(&energy, &problem.exact))
                .and_then(|()| {
                    solver.measure(&energy, norm);
                    solver.change_norm(&energy, norm, &change)
                });
        });
        length.map(|length| (length, info.count_total))
    };
    let mut solver = Condensed::new();
    let mut first = Vec::new();
    for round in 0..2 {
        for (k, tau) in [1e-3, 2e-3].into_iter().enumerate() {
            problem.set_time_step(tau);
            let (length, allocations) = measured(&mut solver, &problem, &problem.norm)?;
            if round == 0 {
                first.push(length);
            } else {
                assert_eq!((length, allocations), (first[k], 0));
            }
        }
    }
    let stiffness = problem.stiffness.clone();
    let fresh = measured(&mut Condensed::new(), &problem, &stiffness)?.0;
    assert_eq!(measured(&mut solver, &problem, &stiffness)?.0, fresh);
    assert_eq!(solver.counters().backward_substitutions, 0);
    // Where only the factor fits, a change is extended.
    let mut allowed = 100_000;
    let mut tight = loop {
        let mut solver = Condensed::new().with_memory_limit(allowed);
        if solver.prepare(&problem.energy()).is_ok() {
            break solver;
        }
        allowed += allowed / 50;
    };
    let length = measured(&mut tight, &problem, &stiffness)?.0;
    assert!((length / fresh - 1.0).abs() < 1e-9);
    assert_eq!(tight.counters().backward_substitutions, 1);
    Ok(())
}
