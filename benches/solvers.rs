//! The cost of one iteration of an iterative solver: linear in the unknowns, if the throughput does not fall from level
//! to level.

mod common;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use stickslip::solvers::LinearStep;
use stickslip::{BlockGaussSeidel, BlockMatrix, NonsmoothSolver, SceneError, Tnnmg};

use common::velocity::{Problem, REGIMES, Regime};
use common::{LEVELS, components};

/// One iteration from a field that is not the solution.
fn iteration<S>(criterion: &mut Criterion, name: &str, solver: impl Fn(&Problem) -> S)
where
    S: NonsmoothSolver<BlockMatrix<2>, 2>,
{
    let prepared = |level, regime| -> Result<_, SceneError> {
        let problem = Problem::new(level, regime)?;
        let mut solver = solver(&problem);
        solver.prepare(&problem.energy())?;
        Ok((problem, solver))
    };
    let mut group = criterion.benchmark_group(name);
    for level in LEVELS {
        group.throughput(Throughput::Elements(components(level)));
        for (name, regime) in REGIMES {
            let mut begun = None;
            group.bench_function(BenchmarkId::new(name, level), |bencher| {
                let (problem, solver) = begun
                    .get_or_insert_with(|| prepared(level, regime).expect("the slider is valid"));
                let (energy, stopping) = (problem.energy(), problem.one_iteration());
                bencher.iter_batched_ref(
                    || problem.start.clone(),
                    |v| solver.minimize(&energy, &stopping, v),
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

fn multigrid(problem: &Problem) -> Tnnmg<2> {
    Tnnmg::new(problem.space.transfers())
}

/// A sweep over all vertices, each local problem solved exactly, and the stopping norm.
fn sweep(criterion: &mut Criterion) {
    iteration(criterion, "block Gauss-Seidel", |_| BlockGaussSeidel::new());
}

/// Sweep, truncation, one cycle, projection, line search and the stopping norm.
fn cycle(criterion: &mut Criterion) {
    iteration(criterion, "TNNMG, V(1,1)", |problem| {
        multigrid(problem).with_linear_step(LinearStep::Cycle)
    });
    iteration(criterion, "TNNMG, V(3,3)", |problem| {
        let solver = multigrid(problem).with_cycle(3, 3);
        solver.with_linear_step(LinearStep::Cycle)
    });
}

/// The cost of a new step size: the operators of all levels.
fn preparation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("TNNMG, preparation");
    for level in LEVELS {
        group.throughput(Throughput::Elements(components(level)));
        let mut begun = None;
        group.bench_function(BenchmarkId::from_parameter(level), |bencher| {
            let (problem, solver) = begun.get_or_insert_with(|| {
                let problem = Problem::new(level, Regime::Stick).expect("the slider is valid");
                let solver = multigrid(&problem);
                (problem, solver)
            });
            bencher.iter(|| solver.prepare(&problem.energy()));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = common::config(0.8);
    targets = sweep, cycle, preparation
}
criterion_main!(benches);
