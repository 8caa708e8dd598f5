//! The dense nonsmooth Newton method: the contract, the known minimiser, no memory.

use allocation_counter::measure;
use nalgebra::{DMatrix, SVector};
use proptest::prelude::*;
use stickslip_solvers::{
    BlockMatrix, DenseNewton, Energy, NonsmoothSolver, Operator, SolveError, SolveReport,
    SolverViolation, Stopping, Symmetric, check_nonsmooth_solver,
};

use crate::common::{
    Fallible, Problem, REGIMES, Regime, antiplane, block, cases, dense, levels, slider,
};

/// The dense solver for sparse problems: every entry copied.
struct Copied<Op, const C: usize> {
    solver: DenseNewton<C>,
    copy: fn(&BlockMatrix<C>, &Energy<'_, BlockMatrix<C>, C>) -> Op,
    matrix: Option<Op>,
}

impl<const C: usize> Copied<DMatrix<f64>, C> {
    fn new() -> Self {
        Self {
            solver: DenseNewton::new(),
            copy: |matrix, _| dense(matrix),
            matrix: None,
        }
    }
}

impl<const C: usize> Copied<Symmetric<C>, C> {
    /// Half of every entry.
    fn by_halves() -> Self {
        Self {
            solver: DenseNewton::new(),
            copy: |matrix, _| {
                let full = dense(matrix);
                Symmetric::new(&vec![[true; C]; full.nrows() / C], |i, j| full[(i, j)])
            },
            matrix: None,
        }
    }

    /// Half of every entry, and no row for what contacts close: it stays zero.
    fn without_normals() -> Self {
        Self {
            solver: DenseNewton::new(),
            copy: |matrix, energy| {
                let full = dense(matrix);
                let mut moves = vec![[true; C]; energy.fixed.len()];
                for &vertex in energy.vertices {
                    moves[vertex] = energy.fixed[vertex].map(|fixed| !fixed);
                }
                let rows: Vec<usize> = (0..full.nrows()).filter(|&i| moves[i / C][i % C]).collect();
                Symmetric::new(&moves, |i, j| full[(rows[i], rows[j])])
            },
            matrix: None,
        }
    }
}

fn with_operator<'a, Op, const C: usize>(
    energy: &Energy<'a, BlockMatrix<C>, C>,
    operator: &'a Op,
) -> Energy<'a, Op, C> {
    Energy {
        operator,
        load: energy.load,
        potentials: energy.potentials,
        vertices: energy.vertices,
        fixed: energy.fixed,
    }
}

impl<Op: Operator<C>, const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Copied<Op, C>
where
    DenseNewton<C>: NonsmoothSolver<Op, C>,
{
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        let matrix = self.matrix.insert((self.copy)(energy.operator, energy));
        self.solver.prepare(&with_operator(energy, matrix))
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let norm = (self.copy)(stopping.norm, energy);
        let stopping = Stopping {
            norm: &norm,
            tolerance: stopping.tolerance,
            relative: stopping.relative,
            equivalence: stopping.equivalence,
            max_iterations: stopping.max_iterations,
        };
        let matrix = (self.matrix).get_or_insert_with(|| (self.copy)(energy.operator, energy));
        (self.solver).minimize(&with_operator(energy, matrix), &stopping, v)
    }
}

#[test]
fn it_obeys_the_contract() -> Result<(), SolverViolation> {
    check_nonsmooth_solver::<1, _>(|_| Copied::new())?;
    check_nonsmooth_solver::<2, _>(|_| Copied::new())?;
    check_nonsmooth_solver::<3, _>(|_| Copied::new())
}

#[test]
fn by_halves_it_obeys_the_contract() -> Result<(), SolverViolation> {
    check_nonsmooth_solver::<1, _>(|_| Copied::by_halves())?;
    check_nonsmooth_solver::<2, _>(|_| Copied::by_halves())?;
    check_nonsmooth_solver::<3, _>(|_| Copied::by_halves())
}

fn finds<const C: usize>(
    problem: &Problem<C>,
    seed: u64,
    mut solver: impl NonsmoothSolver<BlockMatrix<C>, C>,
) -> Result<(), TestCaseError> {
    let goal = 1e-11 * problem.size();
    for mut v in [problem.at_rest(), problem.nearby(1e-2, seed)] {
        let report = problem
            .solve(&mut solver, goal, &mut v)
            .map_err(|e| TestCaseError::fail(e.to_string()))?;
        let error = problem.error(&v);
        prop_assert!(error <= goal, "{error:e} of {goal:e}, {report:?}");
        prop_assert!(report.iterations <= 40, "{report:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(48))]

    /// Most vertices are without friction here: they are unknowns of the Newton system like others.
    #[test]
    fn it_finds_the_minimiser(
        regime in prop::sample::select(&REGIMES[..]), level in levels(0..2), seed in any::<u64>(),
    ) {
        let problem = slider(level, regime, seed).expect("valid");
        finds(&problem, seed, Copied::new())?;
        finds(&problem, seed, Copied::by_halves())?;
        finds(&problem, seed, Copied::without_normals())?;
        let problem = antiplane(level, regime, seed).expect("valid");
        finds(&problem, seed, Copied::new())?;
        finds(&problem, seed, Copied::by_halves())?;
        finds(&problem, seed, Copied::without_normals())?;
        let problem = block(0, regime, seed).expect("valid");
        finds(&problem, seed, Copied::new())?;
        finds(&problem, seed, Copied::by_halves())?;
        finds(&problem, seed, Copied::without_normals())?;
    }
}

#[test]
fn it_allocates_nothing_once_prepared() -> Fallible {
    for regime in REGIMES {
        let problem = slider(1, regime, 1)?;
        let (matrix, norm) = (dense(&problem.operator), dense(&problem.norm));
        let sparse = problem.energy();
        let energy = with_operator(&sparse, &matrix);
        let mut solver = DenseNewton::new();
        solver.prepare(&energy)?;
        let starts = [
            problem.at_rest(),
            problem.nearby(1e-6, 1),
            problem.nearby(1.0, 2),
        ];
        let mut v = problem.at_rest();
        let mut result = Ok(SolveReport::default());
        let info = measure(|| {
            for start in &starts {
                v.copy_from_slice(start);
                let stopping = Stopping {
                    norm: &norm,
                    tolerance: 1e-9,
                    relative: 1e-14,
                    equivalence: problem.equivalence,
                    max_iterations: 1000,
                };
                result = (result.clone())
                    .and_then(|_| solver.prepare(&energy))
                    .and_then(|()| solver.minimize(&energy, &stopping, &mut v));
            }
        });
        assert_eq!(info.count_total, 0, "{info:?}");
        result?;
    }
    Ok(())
}

#[test]
fn lengths_and_definiteness_are_checked() -> Fallible {
    let problem = slider(1, Regime::Slip, 1)?;
    let (sparse, mut matrix) = (problem.energy(), dense(&problem.operator));
    let size = problem.exact.len();
    let mut solver = DenseNewton::new();
    let shorter = DMatrix::zeros(2 * size - 2, 2 * size - 2);
    assert_eq!(
        solver.prepare(&with_operator(&sparse, &shorter)),
        Err(SolveError::SizeMismatch {
            expected: size - 1,
            found: size
        })
    );
    matrix[(2 * 7, 2 * 7)] = -1.0;
    assert_eq!(
        solver.prepare(&with_operator(&sparse, &matrix)),
        Err(SolveError::IndefiniteBlock { vertex: 7 })
    );
    Ok(())
}
