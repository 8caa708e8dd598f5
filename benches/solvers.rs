//! One iteration of each solver on the slider's velocity problem: the cost is linear in the unknowns
//! if the throughput does not fall from level to level.

use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::SVector;
use stickslip::fem::{Constraints, FemError, P1, elasticity, mass};
use stickslip::friction::{DieterichRuina, Radial};
use stickslip::problems::{FRICTION, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::tnnmg::{Energy, Stopping};
use stickslip::{
    BlockGaussSeidel, BlockMatrix, LinearStep, NonsmoothSolver, Operator, SceneError, Tnnmg,
};

const TIME_STEP: f64 = 1.5e-3;

/// The velocity problem of one step of Newmark's scheme.
struct Problem {
    space: P1<2>,
    operator: BlockMatrix<2>,
    norm: BlockMatrix<2>,
    load: Vec<SVector<f64, 2>>,
    potentials: Vec<Radial<DieterichRuina>>,
    vertices: Vec<usize>,
    fixed: Vec<[bool; 2]>,
    start: Vec<SVector<f64, 2>>,
}

impl Problem {
    /// Old contacts stick to the ground, young ones slide at about 1e-3 m/s.
    fn new(refinements: usize, slips: bool) -> Result<Self, SceneError> {
        let slider = Slider {
            refinements,
            ..Slider::default()
        };
        let space = slider.space()?;
        let (bottom, top) = (Slider::bottom(&space)?, space.trace(|x| x[1] == 1.0)?);
        let (stiffness, mass) = (
            elasticity(&space, &slider.elastic)?,
            mass(&space, slider.density)?,
        );
        let fixed = held(&space).map(|held| held.as_slice().to_vec())?;
        let operator =
            BlockMatrix::combination(&[(0.5 * TIME_STEP, &stiffness), (2.0 / TIME_STEP, &mass)]);
        let rate = if slips { 1e-3 } else { 0.0 };
        let mut start =
            space.interpolate(|x| SVector::from([rate * (1.0 - x[1]) + 2e-4 * x[1], 0.0]));
        for &p in top.vertices() {
            start[p] = SVector::from([2e-4, 0.0]);
        }
        // The force of the steady field, and of friction 0.6 where it slides.
        let mut load = vec![SVector::zeros(); start.len()];
        operator.multiply_add(1.0, &start, &mut load);
        let mut potentials = Vec::new();
        for (&p, weight) in bottom.vertices().iter().zip(bottom.weights()) {
            let force = weight * NORMAL_STRESS;
            let alpha = if slips {
                (FRICTION.slip_distance / rate).ln()
            } else {
                2.0
            };
            potentials.push(Radial {
                law: FRICTION,
                force,
                state: LogTheta(alpha),
            });
            load[p][0] += force * if slips { 0.6 } else { 0.2 };
        }
        Ok(Self {
            norm: BlockMatrix::combination(&[(1.0, &stiffness), (1.0, &mass)]),
            operator,
            load,
            potentials,
            vertices: bottom.vertices().to_vec(),
            fixed,
            start,
            space,
        })
    }

    fn energy(&self) -> Energy<'_, BlockMatrix<2>, Radial<DieterichRuina>, 2> {
        Energy {
            operator: &self.operator,
            load: &self.load,
            potentials: &self.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        }
    }
}

fn held(space: &P1<2>) -> Result<Constraints<2>, FemError> {
    let mut held = Constraints::none(space.vertex_count());
    held.hold(&space.trace(|x| x[1] == 1.0)?, [true, true])?;
    held.hold(&space.trace(|x| x[1] == 0.0)?, [false, true])?;
    Ok(held)
}

/// One iteration from a start that is not the solution, which no tolerance ends.
fn iteration<S>(
    criterion: &mut Criterion,
    name: &str,
    levels: std::ops::RangeInclusive<usize>,
    solver: impl Fn(&Problem) -> S,
) -> Result<(), SceneError>
where
    S: NonsmoothSolver<BlockMatrix<2>, Radial<DieterichRuina>, 2>,
{
    let mut group = criterion.benchmark_group(name);
    for level in levels {
        for (regime, slips) in [("stick", false), ("slip", true)] {
            let problem = Problem::new(level, slips)?;
            let mut solver = solver(&problem);
            solver.prepare(&problem.energy())?;
            let stopping = Stopping {
                norm: &problem.norm,
                tolerance: f64::MIN_POSITIVE,
                relative: 0.0,
                equivalence: f64::INFINITY,
                max_iterations: 1,
            };
            // Moved off the solution, so that friction is linearised anew.
            let mut start = problem.start.clone();
            for (i, v) in start.iter_mut().enumerate() {
                for c in (0..2).filter(|&c| !problem.fixed[i][c]) {
                    v[c] += 1e-4 * ((i % 17) as f64 / 17.0 - 0.5);
                }
            }
            group.throughput(Throughput::Elements(2 * start.len() as u64));
            group.bench_function(BenchmarkId::new(regime, level), |bencher| {
                bencher.iter_batched_ref(
                    || start.clone(),
                    |v| solver.minimize(&problem.energy(), &stopping, v),
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
    Ok(())
}

fn all(criterion: &mut Criterion) -> Result<(), SceneError> {
    iteration(criterion, "TNNMG, V(1,1)", 5..=8, |problem| {
        Tnnmg::new(problem.space.hierarchy().prolongations()).with_linear_step(LinearStep::Cycle)
    })?;
    iteration(criterion, "TNNMG, V(3,3)", 5..=8, |problem| {
        Tnnmg::new(problem.space.hierarchy().prolongations())
            .with_cycle(3, 3)
            .with_linear_step(LinearStep::Cycle)
    })?;
    iteration(criterion, "block Gauss-Seidel", 5..=8, |_| {
        BlockGaussSeidel::new()
    })
}

fn solvers(criterion: &mut Criterion) {
    all(criterion).expect("the slider is a valid scene");
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800));
    targets = solvers
}
criterion_main!(benches);
