//! Minimisation takes no memory: all of it is taken in `new` and `prepare`.

use crate::common::{Fallible, Problem, REGIMES, antiplane, block, slider};
use allocation_counter::measure;
use nalgebra::SVector;
use stickslip_solvers::{
    BlockGaussSeidel, BlockMatrix, LinearStep, NonsmoothSolver, Operator, Tnnmg,
};

fn allocates_nothing<const C: usize>(
    problem: &Problem<C>,
    solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
) -> Fallible {
    solver.prepare(&problem.energy())?;
    // Wild starts, so that truncation, projection and line search all have something to do.
    let starts: [Vec<SVector<f64, C>>; 3] = [
        problem.at_rest(),
        problem.nearby(1e-6, 1),
        problem.nearby(1.0, 2),
    ];
    let mut v = problem.at_rest();
    let mut reports = Vec::with_capacity(starts.len());
    let info = measure(|| {
        for start in &starts {
            v.copy_from_slice(start);
            let stopping = problem.stopping(1e-9);
            reports.push(solver.minimize(&problem.energy(), &stopping, &mut v));
        }
    });
    assert_eq!(info.count_total, 0, "{info:?}");
    for report in reports {
        report?;
    }
    Ok(())
}

#[test]
fn no_solver_allocates() -> Fallible {
    for regime in REGIMES {
        let problem = slider(2, regime, 1)?;
        allocates_nothing(&problem, &mut Tnnmg::new(&problem.transfers))?;
        let cycle = Tnnmg::new(&problem.transfers).with_cycle(3, 3);
        allocates_nothing(&problem, &mut cycle.with_linear_step(LinearStep::Cycle))?;
        allocates_nothing(&problem, &mut BlockGaussSeidel::new())?;
        let problem = antiplane(2, regime, 1)?;
        allocates_nothing(&problem, &mut Tnnmg::new(&problem.transfers))?;
        let problem = block(1, regime, 1)?;
        allocates_nothing(&problem, &mut Tnnmg::new(&problem.transfers))?;
        let single = Tnnmg::new(&problem.transfers).in_single_precision();
        allocates_nothing(&problem, &mut { single })?;
        allocates_nothing(&problem, &mut BlockGaussSeidel::new())?;
    }
    Ok(())
}

/// A new time step costs arithmetic only: operator, Galerkin products, factors.
#[test]
fn another_time_step_allocates_nothing() -> Fallible {
    let problem = slider(2, REGIMES[0], 1)?;
    let mut operator = BlockMatrix::combination(&[(1.0, &problem.stiffness), (1.0, &problem.mass)]);
    let mut solver = Tnnmg::new(&problem.transfers);
    solver.prepare(&problem.energy())?;
    let mut result = Ok(());
    let info = measure(|| {
        for tau in [1e-4, 1e-3] {
            operator
                .set_combination(&[(0.5 * tau, &problem.stiffness), (2.0 / tau, &problem.mass)]);
            let energy = stickslip_solvers::Energy {
                operator: &operator,
                ..problem.energy()
            };
            result = solver.prepare(&energy);
        }
    });
    assert_eq!(info.count_total, 0, "{info:?}");
    result?;
    // The counter counts: a solver takes its memory when it is first prepared.
    let mut solver = Tnnmg::new(&problem.transfers);
    let mut first = Ok(());
    let info = measure(|| first = solver.prepare(&problem.energy()));
    assert!(info.count_total > 0);
    Ok(first?)
}
