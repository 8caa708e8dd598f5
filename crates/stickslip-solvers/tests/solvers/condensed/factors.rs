//! The factors a solver stores: one for each step size, within bounds of memory, and none of earlier operators.

use allocation_counter::measure;
use stickslip_solvers::{Condensed, NonsmoothSolver, SolveError, Stopping};

use crate::common::{Fallible, Problem, REGIMES, Regime, TIME_STEP, antiplane, block, slider};

#[test]
fn a_step_size_that_returns_is_not_factorised_again() -> Fallible {
    let mut problem = slider(2, Regime::Mixed, 1)?;
    let run = |problem: &Problem<2>, solver: &mut Condensed<2>| -> Fallible {
        let mut v = problem.at_rest();
        problem.solve(solver, 1e-10 * problem.size(), &mut v)?;
        assert!(problem.error(&v) <= 1e-10 * problem.size());
        Ok(())
    };
    let mut solver = Condensed::new();
    let steps = [1.0, 0.5, 0.25, 0.125].map(|part| part * TIME_STEP);
    for round in 0..3 {
        for (k, tau) in steps.into_iter().enumerate() {
            problem.set_time_step(tau);
            run(&problem, &mut solver)?;
            assert_eq!(
                solver.counters().factorizations,
                if round == 0 { k + 1 } else { 4 }
            );
        }
    }
    // A fifth takes the place of the one unused for longest.
    problem.set_time_step(2.0 * TIME_STEP);
    run(&problem, &mut solver)?;
    problem.set_time_step(steps[3]);
    run(&problem, &mut solver)?;
    assert_eq!(solver.counters().factorizations, 5);
    problem.set_time_step(steps[0]);
    run(&problem, &mut solver)?;
    assert_eq!(solver.counters().factorizations, 6);
    // A step that differs in its last bit is another one.
    problem.set_time_step(steps[0].next_up());
    run(&problem, &mut solver)?;
    assert_eq!(solver.counters().factorizations, 7);
    // With one place, two steps in turn are factorised each time.
    let mut solver = Condensed::new().with_cached_factors(1);
    for k in 0..4 {
        problem.set_time_step(steps[k % 2]);
        run(&problem, &mut solver)?;
        assert_eq!(solver.counters().factorizations, k + 1);
    }
    Ok(())
}

#[test]
fn nothing_is_allocated_once_factors_are_there() -> Fallible {
    fn check<const C: usize>(problem: &mut Problem<C>) -> Fallible {
        let mut solver = Condensed::new();
        for tau in [TIME_STEP, 0.5 * TIME_STEP] {
            problem.set_time_step(tau);
            solver.prepare(&problem.energy())?;
        }
        let starts = [
            problem.at_rest(),
            problem.nearby(1e-6, 1),
            problem.nearby(1.0, 2),
        ];
        let mut v = problem.at_rest();
        for equivalence in [problem.equivalence, f64::INFINITY] {
            let stopping = Stopping {
                equivalence,
                ..problem.stopping(1e-9)
            };
            let mut result = Ok(Default::default());
            let info = measure(|| {
                for start in &starts {
                    v.copy_from_slice(start);
                    result = (result.clone())
                        .and_then(|_| solver.prepare(&problem.energy()))
                        .and_then(|()| solver.minimize(&problem.energy(), &stopping, &mut v));
                }
            });
            assert_eq!(info.count_total, 0, "{info:?}");
            result?;
        }
        // Alternation, too.
        for tau in [TIME_STEP, 0.5 * TIME_STEP] {
            problem.set_time_step(tau);
            let mut result = Ok(());
            let info = measure(|| result = solver.prepare(&problem.energy()));
            assert_eq!(info.count_total, 0, "{info:?}");
            result?;
        }
        assert_eq!(solver.counters().factorizations, 2);
        Ok(())
    }
    for regime in REGIMES {
        check(&mut slider(2, regime, 1)?)?;
        check(&mut antiplane(2, regime, 1)?)?;
        check(&mut block(1, regime, 1)?)?;
    }
    Ok(())
}

#[test]
fn what_needs_more_memory_than_allowed_is_refused() -> Fallible {
    let problem = slider(3, Regime::Slip, 1)?;
    let unknowns = problem.dense().1.len();
    let mut needs = Vec::new();
    // Refused for its dense part, for its entries and for the whole.
    for allowed in [100, 100_000, 300_000] {
        let mut solver = Condensed::new().with_memory_limit(allowed);
        let mut result = Ok(());
        let info = measure(|| result = solver.prepare(&problem.energy()));
        let Err(SolveError::MemoryLimit {
            unknowns: found,
            needed,
            allowed: limit,
        }) = result
        else {
            panic!("{allowed}: {result:?}");
        };
        assert_eq!((found, limit), (unknowns, allowed));
        assert!(needed > allowed);
        assert!(info.bytes_max < 5_000_000, "{info:?}");
        needs.push(needed);
        let mut v = problem.at_rest();
        let answer = solver.minimize(&problem.energy(), &problem.stopping(1.0), &mut v);
        assert!(matches!(
            answer,
            Err(SolveError::SizeMismatch { expected: 0, .. })
        ));
    }
    assert!(needs.is_sorted());
    let mut solver = Condensed::new().with_memory_limit(20 * needs[2]);
    solver.prepare(&problem.energy())?;
    Ok(())
}

/// The memory that a refusal names suffices in the end, a byte less does not, and the refusal itself takes less.
#[test]
fn memory_is_counted_before_it_is_taken() -> Fallible {
    let problem = block(3, Regime::Mixed, 1)?;
    let prepare = |allowed| {
        let mut result = Ok(());
        let mut solver = Condensed::new().with_memory_limit(allowed);
        let info = measure(|| result = solver.prepare(&problem.energy()));
        (result, info.bytes_max as usize, solver)
    };
    let (mut allowed, mut refusals) = (0, 0);
    let taken = loop {
        match prepare(allowed) {
            (Err(SolveError::MemoryLimit { needed, .. }), taken, _) => {
                assert!(taken < needed, "{taken} for {needed}");
                (allowed, refusals) = (needed, refusals + 1);
            }
            (result, taken, _) => {
                result?;
                break taken;
            }
        }
    };
    // For the dense part, for the entries, and for the whole.
    assert_eq!(refusals, 3);
    let (result, ..) = prepare(allowed - 1);
    assert!(matches!(result, Err(SolveError::MemoryLimit { .. })));
    let entries = prepare(allowed).2.counters().factor_entries;
    assert!(
        8 * entries < allowed && allowed < 2 * taken,
        "{allowed}, {taken}"
    );
    Ok(())
}

/// Another body, other vertices, other masks: bit for bit what a fresh solver does.
#[test]
fn what_was_prepared_before_leaves_no_trace() -> Fallible {
    let mut solver = Condensed::new();
    let mut same = |problem: &Problem<2>| -> Fallible {
        let (mut v, mut w) = (problem.nearby(1e-3, 5), problem.nearby(1e-3, 5));
        let goal = 1e-10 * problem.size();
        let used = problem.solve(&mut solver, goal, &mut v)?;
        let fresh = problem.solve(&mut Condensed::new(), goal, &mut w)?;
        assert_eq!((used, v), (fresh, w));
        Ok(())
    };
    let mut problem = slider(2, Regime::Mixed, 1)?;
    same(&problem)?;
    for tau in [1e-5, TIME_STEP, 1e-2] {
        problem.set_time_step(tau);
        same(&problem)?;
    }
    problem.drop_every_third_friction();
    same(&problem)?;
    problem.hold_one_more()?;
    same(&problem)?;
    same(&slider(1, Regime::Slip, 9)?)
}
