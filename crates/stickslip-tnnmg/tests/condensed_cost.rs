//! What condensation costs, beside the two triangular solves it cannot do without.
#![cfg(all(feature = "multigrid", feature = "condensed"))]

mod common;

use std::time::Instant;

use common::{Fallible, Problem, Regime, block, slider};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltParams;
use faer::sparse::linalg::cholesky::{LltRef, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side, Spec};
use stickslip_tnnmg::{Condensed, NonsmoothSolver, SolveReport};

/// Seconds of the two triangular solves with faer's factor of the same operator in an order of
/// minimum degree without any constraint, and the entries of that factor.
fn triangular_solves<const C: usize>(
    problem: &Problem<C>,
) -> Result<(f64, usize), Box<dyn std::error::Error>> {
    let mut number = vec![[usize::MAX; C]; problem.fixed.len()];
    let mut count = 0;
    for (number, fixed) in number.iter_mut().zip(&problem.fixed) {
        for c in (0..C).filter(|&c| !fixed[c]) {
            number[c] = count;
            count += 1;
        }
    }
    let mut entries = Vec::new();
    for (block, (i, j)) in problem.operator.iter() {
        for (r, &row) in number[i as usize].iter().enumerate() {
            for (c, &column) in number[j as usize].iter().enumerate() {
                if row != usize::MAX && column != usize::MAX && row >= column {
                    entries.push(Triplet::new(row, column, block[(r, c)]));
                }
            }
        }
    }
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(count, count, &entries)
        .map_err(|e| format!("{e:?}"))?;
    let symbolic = factorize_symbolic_cholesky(
        matrix.symbolic(),
        Side::Lower,
        SymmetricOrdering::Amd,
        Default::default(),
    )
    .map_err(|e| format!("{e:?}"))?;
    let spec = Spec::<LltParams, f64>::default();
    let mut memory = MemBuffer::new(
        symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, spec)
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq)),
    );
    let stack = MemStack::new(&mut memory);
    let mut values = vec![0.0; symbolic.len_val()];
    symbolic
        .factorize_numeric_llt(
            &mut values,
            matrix.as_ref(),
            Side::Lower,
            Default::default(),
            Par::Seq,
            stack,
            spec,
        )
        .map_err(|e| format!("{e:?}"))?;
    let factor = LltRef::new(&symbolic, &values);
    let mut x = vec![1.0; count];
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let begin = Instant::now();
        let x = MatMut::from_column_major_slice_mut(&mut x, count, 1);
        factor.solve_in_place_with_conj(Conj::No, x, Par::Seq, stack);
        best = best.min(begin.elapsed().as_secs_f64());
    }
    Ok((best, symbolic.len_val()))
}

/// Prints what one problem costs.
fn report<const C: usize>(name: &str, problem: &Problem<C>) -> Fallible {
    let (baseline, unconstrained) = triangular_solves(problem)?;
    let free = problem.fixed.iter().flatten().filter(|&&fixed| !fixed);
    let mut solver = Condensed::<C>::new().with_memory_limit(12 << 30);
    let begin = Instant::now();
    solver.prepare(&problem.energy())?;
    let prepared = begin.elapsed();
    let stopping = problem.stopping(1e-10 * problem.size());
    let mut times = Vec::new();
    let mut cost = SolveReport::default();
    for k in 0..7 {
        let mut v = problem.nearby(1e-5, k);
        let begin = Instant::now();
        cost = solver.minimize(&problem.energy(), &stopping, &mut v)?;
        times.push(begin.elapsed().as_secs_f64());
        assert!(problem.error(&v) <= stopping.tolerance);
    }
    let best = times.iter().fold(f64::INFINITY, |a, &b| a.min(b));
    println!(
        "{name}: {} unknowns, {} entries ({:.2} of unconstrained), preparation {:.2} s, \
         {:.2} ms = {:.2} of two triangular solves ({:.2} ms), {} iterations",
        free.count(),
        solver.factor_entries(),
        solver.factor_entries() as f64 / unconstrained as f64,
        prepared.as_secs_f64(),
        1e3 * best,
        best / baseline,
        1e3 * baseline,
        cost.iterations,
    );
    Ok(())
}

/// Milliseconds of a minimisation; run with `--release -- --ignored --nocapture`.
#[test]
#[ignore = "measures for minutes"]
fn in_milliseconds() -> Fallible {
    for regime in [Regime::Slip, Regime::Mixed, Regime::Stick] {
        for level in [4, 6, 8] {
            report(
                &format!("plane {level} {regime:?}"),
                &slider(level, regime, 1)?,
            )?;
        }
        for level in [2, 3] {
            report(
                &format!("space {level} {regime:?}"),
                &block(level, regime, 1)?,
            )?;
        }
    }
    Ok(())
}
