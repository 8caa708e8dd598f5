//! Wrong input and lost iterations give an error that says what is wrong: no panic, no NaN.

use crate::common::{DENSITY, ELASTIC, Fallible, Problem, Regime, gives_up, slider};
use nalgebra::{SMatrix, SVector};
use stickslip_fem::{Elastic, P1, elasticity, mass};
use stickslip_solvers::{
    BlockGaussSeidel, BlockMatrix, Energy, NonsmoothSolver, SolveError, SolveReport, Tnnmg,
};

type Boxed = Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>;

fn solvers(problem: &Problem<2>) -> [Boxed; 2] {
    [
        Box::new(Tnnmg::new(&problem.transfers)),
        Box::new(BlockGaussSeidel::new()),
    ]
}

/// The errors of both solvers for an invalid problem.
fn answers(
    spoil: impl Fn(&mut Problem<2>),
) -> Result<[Result<SolveReport, SolveError>; 2], Box<dyn std::error::Error>> {
    let mut problem = slider(1, Regime::Mixed, 1)?;
    let mut v = problem.at_rest();
    let solvers = solvers(&problem);
    spoil(&mut problem);
    let start = v.clone();
    Ok(solvers.map(|mut solver| {
        v.copy_from_slice(&start);
        let result = problem.solve(&mut solver, 1e-9, &mut v);
        if result.is_ok() {
            assert!(v.iter().flatten().all(|value| value.is_finite()));
        }
        result
    }))
}

#[test]
fn lengths_that_do_not_fit() -> Fallible {
    let size = slider(1, Regime::Mixed, 1)?.load.len();
    let mismatch = |expected, found| Err(SolveError::SizeMismatch { expected, found });
    for answer in answers(|problem| problem.load.truncate(size - 1))? {
        assert_eq!(answer, mismatch(size, size - 1));
    }
    for answer in answers(|problem| problem.fixed.push([false; 2]))? {
        assert_eq!(answer, mismatch(size, size + 1));
    }
    for answer in answers(|problem| problem.potentials.truncate(3))? {
        assert_eq!(answer, mismatch(11, 3));
    }
    Ok(())
}

#[test]
fn frictional_vertices_out_of_order() -> Fallible {
    let unsorted = |vertex, position| Err(SolveError::UnsortedVertices { vertex, position });
    let problem = slider(1, Regime::Mixed, 1)?;
    let (size, vertices) = (problem.load.len(), problem.vertices);
    for answer in answers(|problem| problem.vertices.swap(3, 4))? {
        assert_eq!(answer, unsorted(vertices[3], 4));
    }
    for answer in answers(|problem| problem.vertices[6] = problem.vertices[5])? {
        assert_eq!(answer, unsorted(vertices[5], 6));
    }
    for answer in answers(|problem| problem.vertices[10] = size)? {
        assert_eq!(answer, unsorted(size, 10));
    }
    Ok(())
}

#[test]
fn transfers_of_another_mesh() -> Fallible {
    let (fine, coarse) = (slider(2, Regime::Mixed, 1)?, slider(1, Regime::Mixed, 1)?);
    let mut v = fine.at_rest();
    let answer = fine.solve(&mut Tnnmg::new(&coarse.transfers), 1e-9, &mut v);
    let (expected, found) = (coarse.load.len(), fine.load.len());
    assert_eq!(answer, Err(SolveError::SizeMismatch { expected, found }));
    Ok(())
}

#[test]
fn operators_that_are_not_definite() -> Fallible {
    // Negative at one vertex: the sweep would leave downwards for ever.
    let vertex = 7_usize;
    for answer in answers(|problem| {
        for (k, (_, (i, j))) in problem.operator.clone().iter().enumerate() {
            if i as usize == vertex && j as usize == vertex {
                problem.operator.data_mut()[k] = -SMatrix::identity();
            }
        }
    })? {
        assert_eq!(answer, Err(SolveError::IndefiniteBlock { vertex }));
    }
    // Blocks on the diagonal positive, the whole indefinite.
    for answer in answers(|problem| {
        for (k, (_, (i, j))) in problem.operator.clone().iter().enumerate() {
            if i != j {
                problem.operator.data_mut()[k] *= -20.0;
            }
        }
    })? {
        assert!(answer.is_err(), "{answer:?}");
    }
    // Nothing at all.
    for answer in answers(|problem| problem.operator.data_mut().fill(SMatrix::zeros()))? {
        assert!(
            matches!(answer, Err(SolveError::IndefiniteBlock { .. })),
            "{answer:?}"
        );
    }
    Ok(())
}

#[test]
fn numbers_that_are_none() -> Fallible {
    for value in [f64::NAN, f64::INFINITY] {
        // Frictional, free and held.
        for vertex in [0, 1, 2, 7, 30] {
            for answer in answers(|problem| problem.load[vertex] = SVector::from([value; 2]))? {
                let refused = matches!(answer, Err(SolveError::NotFinite { iteration: 1, .. }));
                assert!(refused, "{value} at {vertex}: {answer:?}");
            }
        }
    }
    for answer in answers(|problem| problem.operator.data_mut()[17].fill(f64::NAN))? {
        assert!(answer.is_err(), "{answer:?}");
    }
    Ok(())
}

#[test]
fn too_few_iterations() -> Fallible {
    let problem = slider(2, Regime::Slip, 1)?;
    for mut solver in solvers(&problem) {
        gives_up(&problem, &mut solver, 1e-12)?;
    }
    Ok(())
}

/// Every message is one line that carries the numbers.
#[test]
fn messages_carry_their_numbers() {
    let error = SolveError::NotConverged {
        iterations: 17,
        change: 2.5e-3,
        tolerance: 1e-9,
    };
    let text = error.to_string();
    assert!(
        ["17", "2.500e-3", "1.000e-9"]
            .iter()
            .all(|part| text.contains(part)),
        "{text}"
    );
    assert!(!text.contains('\n'));
}

/// Fields of another length than the operator's, and a solver that was never prepared.
#[test]
fn minimisation_of_another_problem() -> Fallible {
    let (problem, other) = (slider(1, Regime::Mixed, 1)?, slider(0, Regime::Mixed, 1)?);
    let (expected, found) = (problem.load.len(), other.load.len());
    let mismatch = Err(SolveError::SizeMismatch { expected, found });
    for mut solver in solvers(&problem) {
        solver.prepare(&problem.energy())?;
        let (mut v, mut w) = (problem.at_rest(), other.at_rest());
        let (energy, stopping) = (problem.energy(), problem.stopping(1e-9));
        let answer = solver.minimize(&energy, &stopping, &mut w);
        assert_eq!(answer, mismatch, "start");
        let answer = solver.minimize(&energy, &other.stopping(1e-9), &mut v);
        assert_eq!(answer, mismatch, "norm");
        let shorter = Energy {
            load: &other.load,
            ..problem.energy()
        };
        assert_eq!(
            solver.minimize(&shorter, &stopping, &mut v),
            mismatch,
            "load"
        );
        assert_eq!(
            solver.minimize(&other.energy(), &other.stopping(1e-9), &mut w),
            mismatch
        );
        let fewer = Energy {
            potentials: &&problem.potentials[..4],
            vertices: &problem.vertices[..4],
            ..problem.energy()
        };
        let answer = solver.minimize(&fewer, &stopping, &mut v);
        assert_eq!(
            answer,
            Err(SolveError::SizeMismatch {
                expected: 11,
                found: 4
            })
        );
    }
    for mut solver in solvers(&problem) {
        let mut v = problem.at_rest();
        let answer = solver.minimize(&problem.energy(), &problem.stopping(1e-9), &mut v);
        assert_eq!(
            answer,
            Err(SolveError::SizeMismatch {
                expected: 0,
                found: expected
            })
        );
    }
    Ok(())
}

/// A slider of 105 vertices that can hardly be compressed, in steps of 1 s.
fn nearly_incompressible(poisson_ratio: f64) -> Result<Problem<2>, Box<dyn std::error::Error>> {
    let space = P1::grid([5.0, 1.0], [20, 4])?;
    let elastic = Elastic {
        poisson_ratio,
        ..ELASTIC
    };
    let operators = (elasticity(&space, &elastic)?, mass(&space, DENSITY)?);
    let parts = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
    let mut problem = Problem::new(&space, operators, parts, [false, true], Regime::Stick, 2)?;
    problem.set_time_step(1.0);
    Ok(problem)
}

/// Plain sweeps are above a hundredth of the tolerance after 1000 and 100 a vertex; accelerated ones are below it after
/// a thirtieth of them.
#[test]
fn sweeps_are_accelerated_where_they_are_slow() -> Fallible {
    let problem = nearly_incompressible(0.4999)?;
    let enough = 1000 + 100 * problem.exact.len();
    let tolerance = 1e-11 * problem.size();
    let (mut solver, start) = (BlockGaussSeidel::new(), problem.at_rest());
    let mut v = start.clone();
    let report = problem.solve(&mut solver, tolerance, &mut v)?;
    let error = problem.error(&v);
    assert!(error <= tolerance, "{error:e} {tolerance:e} {report:?}");
    assert!(30 * report.iterations <= enough, "{report:?}");
    let mut plain = start;
    for _ in 0..enough {
        problem.iterate(&mut solver, &mut plain)?;
    }
    let error = problem.error(&plain);
    assert!(error > 1e-2 * tolerance, "{error:e}");
    Ok(())
}

/// Below their rounding errors forces say nothing, and sweeps end, however small the tolerance.
#[test]
fn accelerated_sweeps_end_at_rounding_errors() -> Fallible {
    let problem = nearly_incompressible(0.4999)?;
    let (mut solver, mut v) = (BlockGaussSeidel::new(), problem.at_rest());
    let tolerance = 1e-20 * problem.size();
    let first = problem.solve(&mut solver, tolerance, &mut v)?;
    assert!(first.iterations <= 500, "{first:?}");
    let error = problem.error(&v);
    assert!(error <= 1e-10 * problem.size(), "{error:e} {first:?}");
    let again = problem.solve(&mut solver, tolerance, &mut v)?;
    assert!(again.iterations <= 50, "{again:?}");
    Ok(())
}

/// A problem that accelerated sweeps will not solve either is given up after a few of them.
#[test]
fn what_sweeps_will_not_solve_is_given_up_early() -> Fallible {
    let problem = nearly_incompressible(0.4999999)?;
    let tolerance = 1e-11 * problem.size();
    let (mut solver, mut v) = (BlockGaussSeidel::new(), problem.at_rest());
    let answer = problem.solve(&mut solver, tolerance, &mut v);
    let Err(SolveError::NotConverged { iterations, .. }) = answer else {
        return Err(format!("{answer:?}").into());
    };
    assert!(iterations <= 1000, "{iterations}");
    Ok(())
}
