//! A solver that is prepared again knows nothing of what it was prepared for before.

use crate::common::{Fallible, Problem, Regime, slider};
use nalgebra::SVector;
use stickslip_solvers::{
    BlockGaussSeidel, BlockMatrix, LinearStep, NonsmoothSolver, SolveReport, Tnnmg,
};

type Outcome = Result<(SolveReport, Vec<SVector<f64, 2>>), Box<dyn std::error::Error>>;
type Boxed = Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>;

fn fresh(kind: usize, problem: &Problem<2>) -> Boxed {
    match kind {
        0 => Box::new(Tnnmg::new(&problem.transfers)),
        1 => Box::new(Tnnmg::new(&problem.transfers).with_linear_step(LinearStep::Cycle)),
        _ => Box::new(BlockGaussSeidel::new()),
    }
}

/// Bit for bit what a fresh solver does.
fn same_as_fresh(
    used: &mut Boxed,
    kind: usize,
    problem: &Problem<2>,
) -> Result<Vec<SVector<f64, 2>>, Box<dyn std::error::Error>> {
    let run = |solver: &mut Boxed| -> Outcome {
        let mut v = problem.nearby(1e-3, 5);
        let report = problem.solve(solver, 1e-9 * problem.size(), &mut v)?;
        Ok((report, v))
    };
    let (used, fresh) = (run(used)?, run(&mut fresh(kind, problem))?);
    assert_eq!(used, fresh);
    Ok(fresh.1)
}

#[test]
fn other_time_steps_vertices_and_masks_leave_no_trace() -> Fallible {
    for kind in 0..3 {
        let mut problem = slider(2, Regime::Mixed, 1)?;
        let mut solver = fresh(kind, &problem);
        let mut check = |problem: &Problem<2>| -> Result<_, Box<dyn std::error::Error>> {
            let v = same_as_fresh(&mut solver, kind, problem)?;
            let error = problem.error(&v) / problem.size();
            assert!(error <= 1e-8, "solver {kind}: {error:e}");
            Ok(v)
        };

        // No friction at first, as for an initial equilibrium.
        let (potentials, vertices) = (problem.potentials.clone(), problem.vertices.clone());
        problem.potentials.clear();
        problem.vertices.clear();
        problem.set_load();
        check(&problem)?;
        // Then friction, and other time steps with it.
        problem.potentials = potentials;
        problem.vertices = vertices;
        for tau in [crate::common::TIME_STEP, 1e-5, 1e-2] {
            problem.set_time_step(tau);
            check(&problem)?;
        }
        // Friction on a part of the boundary.
        problem.drop_every_third_friction();
        check(&problem)?;
        // Another component of another vertex is held.
        problem.hold_one_more()?;
        check(&problem)?;
        // Another body: other pattern, other values.
        let coarser = slider(2, Regime::Slip, 9)?;
        check(&coarser)?;
    }
    Ok(())
}

/// A state that changes between solves needs no new preparation.
#[test]
fn potentials_may_change_without_preparation() -> Fallible {
    for kind in 0..3 {
        let stick = slider(2, Regime::Stick, 1)?;
        let slip = slider(2, Regime::Slip, 1)?;
        let mut solver = fresh(kind, &stick);
        solver.prepare(&stick.energy())?;
        for problem in [&stick, &slip, &stick, &slip] {
            let mut v = problem.at_rest();
            let goal = 1e-10 * problem.size();
            solver.minimize(&problem.energy(), &problem.stopping(goal), &mut v)?;
            let error = problem.error(&v) / problem.size();
            assert!(error <= 1e-9, "solver {kind}: {error:e}");
        }
    }
    Ok(())
}
