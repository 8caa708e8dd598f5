//! The convergence rate of the multigrid solver, its error estimate, and its independence of truncation threshold and
//! mesh.

use crate::common::{
    DENSITY, ELASTIC, Fallible, Problem, REGIMES, Regime, TIME_STEP, block, cases, levels, slider,
};
use nalgebra::Vector3;
use proptest::prelude::*;
use stickslip_fem::{Elastic, P1, elasticity, mass};
use stickslip_solvers::{
    BlockGaussSeidel, BlockMatrix, Condensed, LinearStep, NonsmoothSolver, Operator, SolveError,
    Stopping, Tnnmg,
};

/// The asymptotic contraction in the norm `A + M`: the mean ratio of successive errors over the last
/// four of the iterations that reduce an error by eleven orders of magnitude. A single ratio would not
/// do, since corrections of optimal length take turns on either end of the spectrum.
fn contraction<const C: usize>(
    problem: &Problem<C>,
    solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
) -> Result<f64, Box<dyn std::error::Error>> {
    const LAST: usize = 4;
    let mut v = problem.nearby(1e-3, 7);
    solver.prepare(&problem.energy())?;
    let mut errors = vec![problem.error(&v)];
    for iteration in 1..=40 {
        problem.iterate(solver, &mut v)?;
        errors.push(problem.error(&v));
        // Below, rounding begins to show.
        if errors[iteration] < 1e-11 * errors[0] {
            let window = LAST.min(iteration);
            let ratio = errors[iteration] / errors[iteration - window];
            return Ok(ratio.powf(1.0 / window as f64));
        }
    }
    Err(format!("{errors:?}").into())
}

/// The mesh of each level halves the edges of the one before; a rate that did not settle would show.
#[test]
fn a_cycle_of_three_sweeps_contracts_on_every_mesh() -> Fallible {
    for level in 3..=7 {
        for regime in REGIMES {
            let problem = slider(level, regime, 1)?;
            let mut solver = Tnnmg::new(&problem.transfers)
                .with_cycle(3, 3)
                .with_linear_step(LinearStep::Cycle);
            let rate = contraction(&problem, &mut solver)?;
            assert!(rate <= 0.3, "level {level}, {regime:?}: {rate}");
        }
    }
    Ok(())
}

/// A body that can hardly be compressed takes thousands of cycles. After a few of them a factor takes their place, up to
/// the end of the minimisation: two exact solves reduce a linear error to rounding, whatever friction has truncated, and
/// tell how far from the solution the next linear problem is.
#[test]
fn a_factor_takes_the_place_of_slow_cycles() -> Fallible {
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(3)?;
    let elastic = Elastic {
        poisson_ratio: 0.4999,
        ..ELASTIC
    };
    for regime in [Regime::Stick, Regime::Slip, Regime::Creep, Regime::Fresh] {
        let operators = (elasticity(&space, &elastic)?, mass(&space, DENSITY)?);
        let parts = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
        let mut problem = Problem::new(&space, operators, parts, [false, true], regime, 5)?;
        problem.set_time_step(1.0);
        let mut solver = Tnnmg::new(&problem.transfers);
        let tolerance = 1e-9 * problem.size();
        for _ in 0..2 {
            let mut v = problem.at_rest();
            let report = problem.solve(&mut solver, tolerance, &mut v)?;
            let error = problem.error(&v);
            assert!(error <= tolerance, "{regime:?}: {error:e} {report:?}");
            let enough = 8 + 3 * report.iterations;
            assert!(report.cycles <= enough, "{regime:?}: {report:?}");
        }
    }
    Ok(())
}

/// With inertia and, at a step of 1 s, next to none; tetrahedra of three shapes on every mesh.
#[test]
fn in_space_a_cycle_of_three_sweeps_contracts_on_every_mesh() -> Fallible {
    for level in 1..=3 {
        for regime in [Regime::Stick, Regime::Slip] {
            let mut problem = block(level, regime, 1)?;
            for tau in [TIME_STEP, 1.0] {
                problem.set_time_step(tau);
                let mut solver = Tnnmg::new(&problem.transfers)
                    .with_cycle(3, 3)
                    .with_linear_step(LinearStep::Cycle);
                let rate = contraction(&problem, &mut solver)?;
                assert!(rate <= 0.4, "level {level}, {regime:?}, {tau:e}: {rate}");
            }
        }
    }
    Ok(())
}

/// A guard against a slow-down, not a law: at a rate of 0.23 a cycle ten orders of magnitude would be
/// 16 cycles, and the solver spends more, since it knows the error in the energy norm alone and
/// has to be sure in the norm `A + M`. The bound is what the finest of these meshes needs today.
#[test]
fn conjugate_gradients_need_few_cycles_on_every_mesh() -> Fallible {
    for regime in REGIMES {
        for level in 2..=7 {
            let problem = slider(level, regime, 2)?;
            let mut solver = Tnnmg::new(&problem.transfers);
            let mut v = problem.nearby(1e-4, 3);
            let goal = 1e-10 * problem.error(&v);
            let report = problem.solve(&mut solver, goal, &mut v)?;
            assert!(problem.error(&v) <= goal, "level {level}, {regime:?}");
            assert!(report.cycles <= 22, "level {level}, {regime:?}: {report:?}");
        }
    }
    Ok(())
}

#[test]
fn a_solid_needs_few_cycles_too() -> Fallible {
    for regime in REGIMES {
        for level in 1..=3 {
            let problem = block(level, regime, 2)?;
            let mut solver = Tnnmg::new(&problem.transfers);
            let mut v = problem.nearby(1e-4, 3);
            let goal = 1e-10 * problem.error(&v);
            let report = problem.solve(&mut solver, goal, &mut v)?;
            assert!(problem.error(&v) <= goal, "level {level}, {regime:?}");
            assert!(report.cycles <= 24, "level {level}, {regime:?}: {report:?}");
        }
    }
    Ok(())
}

/// Where no force has arrived yet, a vertex is slower than the cut-off and feels no friction, which holds it as soon as it
/// moves. A linear step that takes such vertices for free ones is as good as none, and leaves all to the sweeps.
#[test]
fn vertices_below_the_cut_off_are_held() -> Fallible {
    for level in 1..=2 {
        let mut problem = block(level, Regime::Stick, 3)?;
        // All that moves the body is its top.
        problem.load.fill(Vector3::zeros());
        let mut solver = Tnnmg::new(&problem.transfers);
        let mut v = problem.at_rest();
        let tolerance = 1e-10 * problem.size();
        let report = problem.solve(&mut solver, tolerance, &mut v)?;
        let mut oracle = problem.at_rest();
        problem.solve(&mut BlockGaussSeidel::new(), 1e-3 * tolerance, &mut oracle)?;
        let distance = problem.distance(&v, &oracle);
        assert!(distance <= 2.0 * tolerance, "level {level}: {distance:e}");
        assert!(report.iterations <= 3, "level {level}: {report:?}");
    }
    Ok(())
}

/// The unit of the stopping norm decides nothing: by a power of four, not a bit changes.
#[test]
fn the_stopping_norm_has_units_of_its_own() -> Fallible {
    let mut problem = block(1, Regime::Stick, 3)?;
    problem.load.fill(Vector3::zeros());
    let given = problem.stopping(1e-10 * problem.size());
    let run = |solver: &mut dyn NonsmoothSolver<BlockMatrix<3>, 3>, exponent: i32| {
        let scale = 2f64.powi(exponent);
        let norm = BlockMatrix::combination(&[(scale * scale, &problem.norm)]);
        let stopping = Stopping {
            norm: &norm,
            tolerance: scale * given.tolerance,
            relative: given.relative,
            equivalence: scale * scale * given.equivalence,
            max_iterations: given.max_iterations,
        };
        let mut v = problem.at_rest();
        solver.prepare(&problem.energy())?;
        let report = solver.minimize(&problem.energy(), &stopping, &mut v)?;
        Ok::<_, SolveError>((report.iterations, report.cycles, v))
    };
    let solvers: [Box<dyn NonsmoothSolver<BlockMatrix<3>, 3>>; 2] = [
        Box::new(Tnnmg::new(&problem.transfers)),
        Box::new(Condensed::new()),
    ];
    for mut solver in solvers {
        let expected = run(&mut *solver, 0)?;
        for exponent in [-20, 20] {
            assert_eq!(run(&mut *solver, exponent)?, expected, "2^{exponent}");
        }
    }
    Ok(())
}

#[test]
fn the_truncation_threshold_changes_neither_result_nor_work() -> Fallible {
    const TOLERANCE: f64 = 1e-9;
    for regime in REGIMES {
        let problem = slider(4, regime, 5)?;
        let mut cycles = Vec::new();
        for threshold in [1e2, 1e4, 1e8] {
            for step in [None, Some(LinearStep::Cycle)] {
                let mut solver = Tnnmg::new(&problem.transfers).with_truncation(threshold);
                if let Some(step) = step {
                    solver = solver.with_cycle(3, 3).with_linear_step(step);
                }
                let mut v = problem.at_rest();
                let report = problem.solve(&mut solver, TOLERANCE, &mut v)?;
                let error = problem.error(&v);
                assert!(error <= TOLERANCE, "{regime:?}, {threshold:e}: {error:e}");
                if step.is_none() {
                    cycles.push(report.cycles);
                }
            }
        }
        let (least, most) = (cycles.iter().min(), cycles.iter().max());
        assert!(
            least
                .zip(most)
                .is_some_and(|(least, most)| most - least <= 6),
            "{regime:?}: {cycles:?}"
        );
    }
    Ok(())
}

/// The tolerance is a bound of the error where the norms are equivalent by a known number.
fn check_error(
    (level, regime): (usize, Regime),
    [exponent, distance]: [f64; 2],
    seed: u64,
) -> Result<(), TestCaseError> {
    let problem = slider(level, regime, seed).expect("the grid is valid");
    // Rounding of the load alone moves the minimiser by about 1e-14 of its size.
    let tolerance = 10f64.powf(exponent).max(1e-12 * problem.size());
    let mut v = problem.nearby(10f64.powf(distance), seed ^ 1);
    let mut solver = Tnnmg::new(&problem.transfers);
    let stopping = Stopping {
        relative: 0.0,
        ..problem.stopping(tolerance)
    };
    let energy = problem.energy();
    solver.prepare(&energy).expect("the step is solvable");
    let report = solver.minimize(&energy, &stopping, &mut v);
    let report = report.expect("the tolerance is above rounding");
    let error = problem.error(&v);
    prop_assert!(
        error <= tolerance,
        "error {error:e}, tolerance {tolerance:e}, {report:?}"
    );
    prop_assert!(report.error <= tolerance);
    Ok(())
}

/// One step of conjugate gradients may by chance do far better than those before and behind it.
#[test]
fn a_lucky_step_promises_nothing() -> Result<(), TestCaseError> {
    let exponents = [-9.780520367308647, -1.1659855540672452];
    check_error((1, Regime::Stick), exponents, 6326834570613623858)
}

proptest! {
    #![proptest_config(cases(96))]

    #[test]
    fn the_error_is_within_the_tolerance(
        level in levels(1..5),
        regime in prop::sample::select(&REGIMES[..]),
        exponent in -12.0..-4.0_f64,
        distance in -8.0..0.0_f64,
        seed in any::<u64>(),
    ) {
        check_error((level, regime), [exponent, distance], seed)?;
    }
}
