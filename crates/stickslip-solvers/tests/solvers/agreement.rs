//! All solvers find the minimiser: the one that is known, the one that a dense bisection finds, and
//! the one that a bound from the gradient alone certifies.

use crate::common::coulomb::Coulomb;
use crate::common::{
    Fallible, Problem, REGIMES, antiplane, block, cases, coefficient, levels, slider,
};
use nalgebra::SVector;
use proptest::prelude::*;
use stickslip_friction::Radial;
use stickslip_solvers::{BlockGaussSeidel, LinearStep, NonsmoothSolver, Tnnmg};

/// Solves from rest by all means and compares with what is known.
fn all_agree<const C: usize>(problem: &Problem<C>) -> Result<(), TestCaseError> {
    let goal = 1e-11 * problem.size();
    let mut results = Vec::new();
    for kind in 0..3 {
        let mut v = problem.at_rest();
        let multigrid = Tnnmg::new(&problem.transfers);
        let report = match kind {
            0 => problem.solve(&mut BlockGaussSeidel::new(), goal, &mut v),
            1 => problem.solve(&mut { multigrid }, goal, &mut v),
            _ => problem.solve(
                &mut multigrid.with_linear_step(LinearStep::Cycle),
                goal,
                &mut v,
            ),
        }
        .map_err(|e| TestCaseError::fail(e.to_string()))?;
        // The last figure is Gauss-Seidel's, whose estimate is one.
        let error = problem.error(&v);
        // Where curvature is huge the gradient is as well: it is taken after one more sweep.
        let mut w = v.clone();
        let mut sweep = BlockGaussSeidel::new();
        sweep
            .prepare(&problem.energy())
            .and_then(|()| problem.iterate(&mut sweep, &mut w))
            .map_err(|e| TestCaseError::fail(e.to_string()))?;
        let certified = problem.certified_error(&w) + problem.distance(&v, &w);
        prop_assert!(
            error <= 10.0 * goal,
            "{kind}: {error:e}, {goal:e}, {report:?}"
        );
        prop_assert!(
            error <= certified + 0.1 * goal,
            "{error:e} above {certified:e}"
        );
        prop_assert!(certified <= 1e4 * goal, "{kind}: {certified:e}, {goal:e}");
        results.push(v);
    }
    let size = problem.size();
    for v in &results[1..] {
        let distance = problem.distance(&results[0], v);
        prop_assert!(distance <= 1e-9 * size, "{distance:e} of {size:e}");
    }
    Ok(())
}

/// Coordinate descent on the dense matrix: every scalar equation by bisection of `ln V`. Only the
/// law's formula and the definition of the minimiser are used.
fn by_bisection<const C: usize>(problem: &Problem<C>) -> Vec<SVector<f64, C>> {
    let (matrix, free) = problem.dense();
    let mut v = problem.at_rest();
    for _ in 0..400 {
        for &(i, c) in &free {
            let row = matrix.row(C * i + c);
            let stiffness = row[C * i + c];
            let product: f64 = (0..v.len() * C).map(|k| row[k] * v[k / C][k % C]).sum();
            let pull = problem.load[i][c] - product + stiffness * v[i][c];
            v[i][c] = match problem.vertices.binary_search(&i) {
                Ok(k) => {
                    let Radial { force, state, .. } = problem.potentials[k];
                    let (mut low, mut high) = (-700.0_f64, 10.0_f64);
                    for _ in 0..100 {
                        let middle = 0.5 * (low + high);
                        let rate = middle.exp();
                        if stiffness * rate + force * coefficient(rate, state.0) < pull.abs() {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    high.exp().copysign(pull)
                }
                Err(_) => pull / stiffness,
            };
        }
    }
    v
}

#[test]
fn a_dense_bisection_finds_the_same() -> Fallible {
    for regime in REGIMES {
        let plane = slider(1, regime, 3)?;
        let oracle = by_bisection(&plane);
        assert!(plane.error(&oracle) <= 1e-9 * plane.size(), "{regime:?}");
        let mut v = plane.at_rest();
        plane.solve(
            &mut Tnnmg::new(&plane.transfers),
            1e-11 * plane.size(),
            &mut v,
        )?;
        let distance = plane.distance(&v, &oracle) / plane.size();
        assert!(distance <= 1e-9, "{regime:?}: {distance:e}");

        let scalar = antiplane(1, regime, 3)?;
        let oracle = by_bisection(&scalar);
        let mut v = scalar.at_rest();
        scalar.solve(
            &mut Tnnmg::new(&scalar.transfers),
            1e-11 * scalar.size(),
            &mut v,
        )?;
        let distance = scalar.distance(&v, &oracle) / scalar.size();
        assert!(distance <= 1e-9, "{regime:?}: {distance:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn in_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..3), seed in any::<u64>(),
    ) {
        all_agree(&slider(level, regime, seed).expect("valid"))?;
    }

    #[test]
    fn out_of_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..3), seed in any::<u64>(),
    ) {
        all_agree(&antiplane(level, regime, seed).expect("valid"))?;
    }

    #[test]
    fn in_space_with_two_slip_components(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..2), seed in any::<u64>(),
    ) {
        all_agree(&block(level, regime, seed).expect("valid"))?;
    }

    /// A true kink: vertices with a force inside Coulomb's cone do not move at all.
    #[test]
    fn tresca_sticks_where_the_force_is_small(level in levels(0..3), seed in any::<u64>()) {
        let coulomb = Coulomb::block(level, seed).expect("valid");
        let (problem, energy) = (&coulomb.problem, coulomb.energy());
        let stopping = problem.stopping(1e-11 * problem.size());
        let mut solver = Tnnmg::new(&problem.transfers);
        let mut oracle = BlockGaussSeidel::new();
        solver.prepare(&energy).expect("solvable");
        oracle.prepare(&energy).expect("solvable");
        let (mut v, mut w) = (problem.nearby(1e-3, seed), problem.at_rest());
        solver.minimize(&energy, &stopping, &mut v).expect("solvable");
        oracle.minimize(&energy, &stopping, &mut w).expect("solvable");
        for found in [&v, &w] {
            prop_assert!(problem.error(found) <= 1e-10 * problem.size());
            for p in coulomb.sticking() {
                prop_assert!(found[p].iter().all(|&value| value == 0.0));
            }
        }
    }
}
