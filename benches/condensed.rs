//! The cost of condensation beside the two triangular solves it cannot do without.
//!
//! `two triangular solves` are those of faer with its factor of the same operator, in an order of
//! minimum degree that nothing constrains; `minimisation` is all that [`Condensed`] does in a step.
//! A whole step, beside them, with prediction, load and state:
//!
//! ```text
//! cargo bench --bench condensed --bench step -- 'Condensed'
//! ```

mod common;

use std::error::Error;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltParams;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side, Spec};
use stickslip::solvers::Energy;
use stickslip::{Condensed, NonsmoothSolver};

use common::velocity::{Problem, REGIMES, Regime};
use common::{LEVELS, TIME_STEP};

/// faer's factor of the operator on the free components.
struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
    size: usize,
}

impl Factor {
    fn new(problem: &Problem) -> Result<Self, Box<dyn Error>> {
        let matrix = free_part(problem)?;
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let order = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, order, params)
            .map_err(|error| format!("{error:?}"))?;
        let spec = Spec::<LltParams, f64>::default();
        let numeric = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, spec);
        let solve = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::new(numeric.or(solve));
        let mut values = vec![0.0; symbolic.len_val()];
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_ref(),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                spec,
            )
            .map_err(|error| format!("{error:?}"))?;
        Ok(Self {
            size: matrix.nrows(),
            symbolic,
            values,
            memory,
        })
    }

    fn solve(&mut self, x: &mut [f64]) {
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, self.size, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}

/// The lower triangle of the rows and columns that are unknowns.
fn free_part(problem: &Problem) -> Result<SparseColMat<usize, f64>, Box<dyn Error>> {
    let mut count = 0;
    let number = problem.fixed.iter().map(|fixed| {
        fixed.map(|fixed| {
            (!fixed).then(|| {
                count += 1;
                count - 1
            })
        })
    });
    let number: Vec<[Option<usize>; 2]> = number.collect();
    let mut entries = Vec::new();
    for (block, (i, j)) in problem.operator.iter() {
        for (r, row) in number[i as usize].into_iter().enumerate() {
            for (c, column) in number[j as usize].into_iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column)
                    && row >= column
                {
                    entries.push(Triplet::new(row, column, block[(r, c)]));
                }
            }
        }
    }
    let matrix = SparseColMat::try_new_from_triplets(count, count, &entries);
    Ok(matrix.map_err(|error| format!("{error:?}"))?)
}

fn slider(level: usize, regime: Regime) -> Problem {
    Problem::new(level, regime).expect("the slider is valid")
}

fn triangular_solves(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("Condensed");
    for level in LEVELS {
        let mut begun = None;
        group.bench_function(
            BenchmarkId::new("two triangular solves", level),
            |bencher| {
                let factor = begun.get_or_insert_with(|| {
                    Factor::new(&slider(level, Regime::Stick)).expect("the operator has a factor")
                });
                let size = factor.size;
                bencher.iter_batched_ref(
                    || vec![1.0; size],
                    |x| factor.solve(x),
                    BatchSize::LargeInput,
                );
            },
        );
    }
    group.finish();
}

/// One velocity problem, from a field that is not the solution.
fn minimisation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("Condensed");
    for level in LEVELS {
        for (name, regime) in REGIMES {
            let mut begun = None;
            let id = BenchmarkId::new(format!("minimisation, {name}"), level);
            group.bench_function(id, |bencher| {
                let (problem, solver) = begun.get_or_insert_with(|| {
                    let (problem, mut solver) = (slider(level, regime), Condensed::new());
                    let prepared = solver.prepare(&problem.energy());
                    prepared.expect("the operator has a factor");
                    (problem, solver)
                });
                let (energy, stopping) = (problem.energy(), problem.to_tolerance());
                bencher.iter_batched_ref(
                    || problem.start.clone(),
                    |v| {
                        solver
                            .minimize(&energy, &stopping, v)
                            .expect("it is convex")
                    },
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

/// The cost of a new step size: the numeric factor and its Schur complement. Two step sizes alternate,
/// and only one factor is kept.
fn factorisation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("Condensed");
    for level in LEVELS {
        let mut begun = None;
        group.bench_function(BenchmarkId::new("factorisation", level), |bencher| {
            let (problem, operators, solver) = begun.get_or_insert_with(|| {
                let problem = slider(level, Regime::Stick);
                let operators = [TIME_STEP, 2.0 * TIME_STEP].map(|dt| problem.operator_of(dt));
                (problem, operators, Condensed::new().with_cached_factors(1))
            });
            bencher.iter(|| {
                operators.rotate_left(1);
                let energy = Energy {
                    operator: &operators[0],
                    ..problem.energy()
                };
                solver.prepare(&energy).expect("the operator has a factor");
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = common::config(1.0);
    targets = triangular_solves, minimisation, factorisation
}
criterion_main!(benches);
