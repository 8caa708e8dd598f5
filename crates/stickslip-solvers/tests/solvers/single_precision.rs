//! Blocks in single precision change neither the solution nor the work.

use crate::common::{
    DENSITY, ELASTIC, Fallible, Problem, REGIMES, Regime, TIME_STEP, block, cases, levels, slider,
};
use nalgebra::SVector;
use proptest::prelude::*;
use stickslip_fem::{Elastic, P1, elasticity, elasticity_by_cell, mass};
use stickslip_solvers::{BlockMatrix, NonsmoothSolver, Operator, SolveError, Stopping, Tnnmg};

/// Both have reached a tolerance far below 1e-10 of the solution.
fn agree<const C: usize>(problem: &Problem<C>, start: &[SVector<f64, C>]) -> [usize; 2] {
    let tolerance = 1e-12 * problem.size();
    let [double, single] = [
        Tnnmg::new(&problem.transfers),
        Tnnmg::new(&problem.transfers).in_single_precision(),
    ]
    .map(|mut solver| {
        let mut v = start.to_vec();
        let report = problem.solve(&mut solver, tolerance, &mut v);
        (v, report.expect("the step is solvable"))
    });
    let distance = problem.distance(&double.0, &single.0);
    assert!(
        distance <= 1e-10 * problem.size(),
        "{distance:e} of {:e}: {:?}, {:?}",
        problem.size(),
        double.1,
        single.1
    );
    [double.1.cycles, single.1.cycles]
}

/// A linear step by rounded blocks reduces an error by no more than some six orders of magnitude: where linear steps in
/// double precision reduce it by more at once, one iteration more may be needed, of few cycles.
#[test]
fn cycles_are_as_many() -> Fallible {
    for regime in REGIMES {
        for level in 1..=3 {
            for tau in [TIME_STEP, 1.0] {
                let mut problem = block(level, regime, 2)?;
                problem.set_time_step(tau);
                let goal = 1e-10 * problem.error(&problem.nearby(1e-4, 3));
                let [double, single] = [
                    Tnnmg::new(&problem.transfers),
                    Tnnmg::new(&problem.transfers).in_single_precision(),
                ]
                .map(|mut solver| {
                    let mut v = problem.nearby(1e-4, 3);
                    let report = problem.solve(&mut solver, goal, &mut v);
                    report.map(|report| (report.iterations, report.cycles, problem.error(&v)))
                });
                let (double, single) = (double?, single?);
                assert!(single.2 <= goal, "{single:?}, {goal:e}");
                let most = (double.0 + 1, double.1 + 2);
                assert!(
                    single.0 <= most.0 && single.1 <= most.1,
                    "{regime:?} {level} {tau}: {single:?}, {double:?}"
                );
            }
        }
    }
    Ok(())
}

/// A power of two as the unit of all forces changes no bit, far beyond the range of single precision.
#[test]
fn the_unit_of_stiffness_is_free() -> Fallible {
    let run = |exponent: i32| -> Result<_, Box<dyn std::error::Error>> {
        let unit = 2f64.powi(exponent);
        let mut problem = block(2, Regime::Mixed, 4)?;
        problem.operator = BlockMatrix::combination(&[(unit, &problem.operator)]);
        problem.potentials.iter_mut().for_each(|p| p.force *= unit);
        problem.load.iter_mut().for_each(|load| *load *= unit);
        problem.equivalence /= unit;
        let mut solver = Tnnmg::new(&problem.transfers).in_single_precision();
        let mut v = problem.at_rest();
        let report = problem.solve(&mut solver, 1e-10 * problem.size(), &mut v)?;
        Ok((report.iterations, report.cycles, v))
    };
    let expected = run(0)?;
    for exponent in [-400, -150, 150, 400] {
        assert_eq!(run(exponent)?, expected, "2^{exponent}");
    }
    Ok(())
}

/// The stopping criterion counts what rounding has changed: on bodies whose energy a rounded matrix changes most, long
/// ones, nearly incompressible ones, or slow ones, the error is within a tolerance near rounding.
#[test]
fn the_error_is_within_the_tolerance_on_hard_bodies() -> Fallible {
    for (length, poisson_ratio, tau) in [
        (40.0, 0.3, 1.0),
        (40.0, 0.3, 100.0),
        (5.0, 0.499, 1.0),
        (5.0, 0.3, TIME_STEP),
    ] {
        let elastic = Elastic {
            poisson_ratio,
            ..ELASTIC
        };
        let space = P1::grid([length, 1.0], [length as usize, 1])?.refined(3)?;
        let operators = (elasticity(&space, &elastic)?, mass(&space, DENSITY)?);
        for regime in REGIMES {
            let sides = (
                space.trace(|x| x[0] == length)?,
                space.trace(|x| x[1] == 0.0)?,
            );
            let mut problem =
                Problem::new(&space, operators.clone(), sides, [false, false], regime, 7)?;
            problem.set_time_step(tau);
            let tolerance = 1e-10 * problem.size();
            let mut v = problem.nearby(1e-3, 3);
            let mut solver = Tnnmg::new(&problem.transfers).in_single_precision();
            let report = problem.solve(&mut solver, tolerance, &mut v)?;
            let error = problem.error(&v);
            assert!(
                error <= tolerance,
                "{length} {poisson_ratio} {tau} {regime:?}: {error:e} {tolerance:e} {report:?}"
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn blocks_have_the_same_velocity(
        level in levels(0..3),
        regime in prop::sample::select(&REGIMES[..]),
        exponent in -4.0..0.5_f64,
        seed in any::<u64>(),
    ) {
        let mut problem = block(level, regime, seed).expect("the grid is valid");
        problem.set_time_step(10f64.powf(exponent));
        agree(&problem, &problem.at_rest());
    }

    #[test]
    fn sliders_have_the_same_velocity(
        level in levels(1..5),
        regime in prop::sample::select(&REGIMES[..]),
        seed in any::<u64>(),
    ) {
        let problem = slider(level, regime, seed).expect("the grid is valid");
        agree(&problem, &problem.nearby(1e-3, seed ^ 1));
    }

    /// Stiffnesses of cells that differ by up to eight orders of magnitude.
    #[test]
    fn cells_of_any_stiffness_have_the_same_velocity(
        exponents in prop::collection::vec(-8.0..0.0_f64, 8),
        regime in prop::sample::select(&REGIMES[..]),
        seed in any::<u64>(),
    ) {
        let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 1]).and_then(|space| space.refined(1));
        let space = space.expect("a grid");
        let material = |x: &nalgebra::Vector3<f64>, _: usize| {
            let octant = usize::from(x[0] > 1.0) + 2 * usize::from(x[1] > 0.5) + 4 * usize::from(x[2] > 0.5);
            let young_modulus = ELASTIC.young_modulus * 10f64.powf(exponents[octant]);
            Elastic { young_modulus, ..ELASTIC }
        };
        let operators = (
            elasticity_by_cell(&space, material).expect("materials"),
            mass(&space, DENSITY).expect("a density"),
        );
        let sides = (
            space.trace(|x| x[2] == 1.0).expect("top"),
            space.trace(|x| x[2] == 0.0).expect("base"),
        );
        let problem = Problem::new(&space, operators, sides, [false, false, true], regime, seed);
        let problem = problem.expect("a problem");
        let stopping = Stopping { relative: 0.0, ..problem.stopping(1e-11 * problem.size()) };
        let [double, single] = [
            Tnnmg::new(&problem.transfers),
            Tnnmg::new(&problem.transfers).in_single_precision(),
        ]
        .map(|mut solver| {
            let mut v = problem.at_rest();
            solver.prepare(&problem.energy())?;
            solver.minimize(&problem.energy(), &stopping, &mut v)?;
            Ok::<_, SolveError>(v)
        });
        let (double, single) = (double.expect("double"), single.expect("single"));
        prop_assert!(problem.distance(&double, &single) <= 1e-10 * problem.size());
    }
}
