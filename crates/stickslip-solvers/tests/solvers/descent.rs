//! The energy does not rise in any iteration, from wherever it starts.

use crate::common::{Numbers, Problem, REGIMES, antiplane, block, cases, levels, slider};
use nalgebra::SVector;
use proptest::prelude::*;
use stickslip_friction::ConvexPotential;
use stickslip_solvers::{BlockGaussSeidel, BlockMatrix, LinearStep, NonsmoothSolver, Tnnmg};

const ITERATIONS: usize = 8;

/// The sum of the moduli of the terms of the energy, which its rounding errors are relative to.
fn magnitude<const C: usize>(problem: &Problem<C>, v: &[SVector<f64, C>]) -> f64 {
    let quadratic: f64 = problem
        .operator
        .iter()
        .map(|(block, (i, j))| {
            let (v, w) = (v[i as usize].abs(), v[j as usize].abs());
            0.5 * v.dot(&(block.abs() * w))
        })
        .sum();
    let linear: f64 = problem
        .load
        .iter()
        .zip(v)
        .map(|(r, v)| r.abs().dot(&v.abs()))
        .sum();
    let nonlinear: f64 = problem
        .potentials
        .iter()
        .zip(&problem.vertices)
        .map(|(potential, &p)| potential.value(&v[p]))
        .sum();
    quadratic + linear + nonlinear
}

/// Runs some iterations; the first rise of the energy beyond rounding, and the total decrease.
fn descend<const C: usize>(
    problem: &Problem<C>,
    mut solver: impl NonsmoothSolver<BlockMatrix<C>, C>,
    start: &[SVector<f64, C>],
) -> Result<(), TestCaseError> {
    let energy = problem.energy();
    solver
        .prepare(&energy)
        .map_err(|e| TestCaseError::fail(e.to_string()))?;
    let mut v = start.to_vec();
    let (mut before, mut scale) = (energy.value(&v), magnitude(problem, &v));
    let first = before;
    for iteration in 1..=ITERATIONS {
        problem
            .iterate(&mut solver, &mut v)
            .map_err(|e| TestCaseError::fail(e.to_string()))?;
        let (after, new_scale) = (energy.value(&v), magnitude(problem, &v));
        let rounding = 16.0 * f64::EPSILON * scale.max(new_scale);
        prop_assert!(
            after <= before + rounding,
            "iteration {iteration}: {before:e} + {:e}, rounding {rounding:e}",
            after - before
        );
        (before, scale) = (after, new_scale);
    }
    // Every start is far away: an iteration that does nothing is no descent.
    prop_assert!(before < first);
    for (i, fixed) in problem.fixed.iter().enumerate() {
        for c in (0..C).filter(|&c| fixed[c]) {
            prop_assert_eq!(v[i][c], start[i][c]);
        }
    }
    Ok(())
}

fn all_solvers<const C: usize>(
    mut problem: Problem<C>,
    seed: u64,
    lowest: f64,
) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    // Between a body dominated by inertia and one by stiffness, friction strong or weak.
    let pressure = numbers.logarithmic(1e-2, 1e4).abs();
    for potential in &mut problem.potentials {
        potential.force *= pressure;
    }
    problem.set_time_step(numbers.logarithmic(1e-4, 1.0).abs());
    let problem = &problem;
    // The fastest vertex of the start is anywhere between the slowest one and 1 m/s.
    let highest = numbers.between(lowest, 0.0);
    let (low, high) = (10f64.powf(lowest), 10f64.powf(highest));
    let start = problem.field(|| numbers.logarithmic(low, high));
    descend(problem, BlockGaussSeidel::new(), &start)?;
    descend(problem, Tnnmg::new(&problem.transfers), &start)?;
    for truncation in [1e2, 1e4, 1e10] {
        let cycle = Tnnmg::new(&problem.transfers)
            .with_linear_step(LinearStep::Cycle)
            .with_truncation(truncation);
        descend(problem, cycle, &start)?;
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(160))]

    #[test]
    fn in_the_plane(
        regime in prop::sample::select(&REGIMES[..]),
        level in levels(0..4),
        lowest in -12.0..-1.0_f64,
        seed in any::<u64>(),
    ) {
        all_solvers(slider(level, regime, seed).expect("valid"), seed ^ 1, lowest)?;
    }

    #[test]
    fn out_of_the_plane(
        regime in prop::sample::select(&REGIMES[..]),
        level in levels(0..4),
        lowest in -12.0..-1.0_f64,
        seed in any::<u64>(),
    ) {
        all_solvers(antiplane(level, regime, seed).expect("valid"), seed ^ 1, lowest)?;
    }

    #[test]
    fn in_space_with_two_slip_components(
        regime in prop::sample::select(&REGIMES[..]),
        level in levels(0..3),
        lowest in -12.0..-1.0_f64,
        seed in any::<u64>(),
    ) {
        all_solvers(block(level, regime, seed).expect("valid"), seed ^ 1, lowest)?;
    }
}

proptest! {
    #![proptest_config(cases(160))]

    /// One sweep more never ends higher, also where sweeps are accelerated.
    #[test]
    fn in_accelerated_sweeps(
        regime in prop::sample::select(&REGIMES[..]),
        level in levels(1..4),
        lowest in -12.0..-1.0_f64,
        tau in 1e-2..1e2_f64,
        sweeps in 4..60_usize,
        seed in any::<u64>(),
    ) {
        let mut problem = slider(level, regime, seed).expect("valid");
        problem.set_time_step(tau);
        let mut numbers = Numbers(seed ^ 2);
        let start = problem.field(|| numbers.logarithmic(10f64.powf(lowest), 1.0));
        let energy = problem.energy();
        let mut solver = BlockGaussSeidel::new();
        solver.prepare(&energy).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let mut after = |sweeps: usize| {
            let mut v = start.clone();
            let swept = problem.iterate_often(&mut solver, sweeps, &mut v);
            swept.map_err(|e| TestCaseError::fail(e.to_string()))?;
            Ok::<_, TestCaseError>((energy.value(&v), magnitude(&problem, &v)))
        };
        let ((before, scale), (after, new_scale)) = (after(sweeps)?, after(sweeps + 1)?);
        let rounding = 16.0 * f64::EPSILON * scale.max(new_scale);
        prop_assert!(after <= before + rounding, "{:e}, {rounding:e}", after - before);
    }
}
