//! The minimiser: that of the other solvers, from every start, and of the problems at the edges.

use proptest::prelude::*;
use stickslip_solvers::{
    BlockGaussSeidel, Condensed, NonsmoothSolver, SolveError, Stopping, Tnnmg,
};

use crate::common::coulomb::Coulomb;
use crate::common::{Fallible, Problem, REGIMES, Regime, antiplane, block, cases, levels, slider};

fn agrees<const C: usize>(problem: &Problem<C>, seed: u64) -> Result<(), TestCaseError> {
    let fail = |e: SolveError| TestCaseError::fail(e.to_string());
    let size = problem.size();
    let goal = 1e-11 * size;
    let (mut v, mut w) = (problem.at_rest(), problem.at_rest());
    let mut solver = Condensed::new();
    let report = problem.solve(&mut solver, goal, &mut v).map_err(fail)?;
    prop_assert!(report.iterations >= 1 && report.error <= goal, "{report:?}");
    let error = problem.error(&v);
    prop_assert!(error <= goal, "{error:e} of {goal:e}, {report:?}");
    problem
        .solve(&mut Tnnmg::new(&problem.transfers), goal, &mut w)
        .map_err(fail)?;
    let distance = problem.distance(&v, &w);
    prop_assert!(
        distance <= 2.0 * goal,
        "multigrid: {distance:e} of {goal:e}"
    );
    // One more sweep, where the gradient is taken.
    let mut swept = v.clone();
    let mut sweep = BlockGaussSeidel::new();
    sweep
        .prepare(&problem.energy())
        .and_then(|()| problem.iterate(&mut sweep, &mut swept))
        .map_err(fail)?;
    let certified = problem.certified_error(&swept) + problem.distance(&v, &swept);
    prop_assert!(certified <= 1e4 * goal, "{certified:e}, {goal:e}");
    // The start is forgotten, and no step climbs.
    let energy = problem.energy();
    let mut start = problem.nearby(1e-2, seed);
    let mut before = energy.value(&start);
    for _ in 0..4 {
        problem.iterate(&mut solver, &mut start).map_err(fail)?;
        let after = energy.value(&start);
        prop_assert!(
            after <= before + 1e-13 * before.abs(),
            "{before:e} to {after:e}"
        );
        before = after;
    }
    problem.solve(&mut solver, goal, &mut start).map_err(fail)?;
    let distance = problem.distance(&v, &start);
    prop_assert!(
        distance <= 2.0 * goal,
        "other start: {distance:e} of {goal:e}"
    );
    prop_assert_eq!(solver.counters().factorizations, 1);
    Ok(())
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn in_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..3), seed in any::<u64>(),
    ) {
        agrees(&slider(level, regime, seed).expect("valid"), seed)?;
    }

    #[test]
    fn out_of_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..3), seed in any::<u64>(),
    ) {
        agrees(&antiplane(level, regime, seed).expect("valid"), seed)?;
    }

    #[test]
    fn in_space(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..2), seed in any::<u64>(),
    ) {
        agrees(&block(level, regime, seed).expect("valid"), seed)?;
    }
}

/// A true kink: what is inside Coulomb's cone stays exactly where it is.
#[test]
fn tresca_sticks_where_the_force_is_small() -> Fallible {
    for seed in 0..16 {
        let coulomb = Coulomb::block(1, seed)?;
        let (problem, energy) = (&coulomb.problem, coulomb.energy());
        let mut solver = Condensed::new();
        solver.prepare(&energy)?;
        let mut v = problem.nearby(1e-3, seed);
        solver.minimize(&energy, &problem.stopping(1e-11 * problem.size()), &mut v)?;
        assert!(problem.error(&v) <= 1e-11 * problem.size());
        for p in coulomb.sticking() {
            assert!(v[p].iter().all(|&value| value == 0.0));
        }
    }
    Ok(())
}

/// The norm of a change of the boundary is that of the change of the whole field: a solver that
/// knows no bound by the energy stops within the tolerance all the same.
#[test]
fn stops_on_the_norm_of_the_field() -> Fallible {
    for regime in REGIMES {
        let problem = slider(3, regime, 1)?;
        let mut solver = Condensed::new();
        solver.prepare(&problem.energy())?;
        for share in [1e-2, 1e-5, 1e-10] {
            let stopping = Stopping {
                equivalence: f64::INFINITY,
                ..problem.stopping(share * problem.size())
            };
            let mut v = problem.at_rest();
            let report = solver.minimize(&problem.energy(), &stopping, &mut v)?;
            let error = problem.error(&v);
            assert!(
                error <= stopping.tolerance,
                "{regime:?}: {error:e}, {report:?}"
            );
        }
    }
    Ok(())
}

/// A tolerance that no arithmetic meets ends where the rounding errors begin.
#[test]
fn tolerances_below_rounding_are_not_waited_for() -> Fallible {
    for regime in REGIMES {
        let problem = slider(2, regime, 1)?;
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-300, &mut v)?;
        assert!(report.iterations < 60, "{regime:?}: {report:?}");
        assert!(problem.error(&v) <= 1e-12 * problem.size());
    }
    Ok(())
}

#[test]
fn without_friction_it_is_a_linear_solver() -> Fallible {
    for kind in 0..2 {
        let mut problem = slider(2, Regime::Slip, 1)?;
        problem.potentials.clear();
        problem.vertices.clear();
        if kind == 1 {
            // All but one component of one vertex are held.
            problem.fixed.fill([true; 2]);
            problem.fixed[12][1] = false;
        }
        problem.set_load();
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-12 * problem.size(), &mut v)?;
        assert_eq!(report.iterations, 1);
        assert!(problem.error(&v) <= 1e-12 * problem.size());
    }
    Ok(())
}

#[test]
fn with_one_free_vertex_it_is_the_local_problem() -> Fallible {
    for regime in REGIMES {
        let mut problem = block(1, regime, 1)?;
        let vertex = problem.vertices[4];
        for (i, fixed) in problem.fixed.iter_mut().enumerate() {
            *fixed = if i == vertex {
                [false, false, true]
            } else {
                [true; 3]
            };
        }
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-12 * problem.size(), &mut v)?;
        assert!(report.iterations <= 2, "{report:?}");
        assert!(problem.error(&v) <= 1e-12 * problem.size(), "{regime:?}");
        // Nothing is free at all.
        problem.fixed.fill([true; 3]);
        let held = v.clone();
        problem.solve(&mut Condensed::new(), 1e-12, &mut v)?;
        assert_eq!(v, held);
    }
    Ok(())
}
