//! Condensation finds the minimiser that multigrid and sweeps find, never climbs, and factorises no
//! operator twice.
#![cfg(all(feature = "multigrid", feature = "condensed"))]

mod common;

use allocation_counter::measure;
use common::{
    Fallible, Numbers, Problem, REGIMES, Regime, TIME_STEP, antiplane, block, cases, slider,
};
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{ConvexPotential, Interval, LocalModel, Radial, Tresca};
use stickslip_tnnmg::{
    BlockGaussSeidel, Condensed, Energy, NonsmoothSolver, Operator, SolveError, Stopping, Tnnmg,
};

fn agrees<const C: usize>(problem: &Problem<C>, seed: u64) -> Result<(), TestCaseError> {
    let fail = |e: SolveError| TestCaseError::fail(e.to_string());
    let size = problem.size();
    let goal = 1e-11 * size;
    let (mut v, mut w) = (problem.at_rest(), problem.at_rest());
    let mut solver = Condensed::new();
    let report = problem.solve(&mut solver, goal, &mut v).map_err(fail)?;
    prop_assert!(report.iterations >= 1 && report.error <= goal, "{report:?}");
    let error = problem.error(&v);
    prop_assert!(error <= goal, "{error:e} of {goal:e}, {report:?}");
    problem
        .solve(&mut Tnnmg::new(&problem.transfers), goal, &mut w)
        .map_err(fail)?;
    let distance = problem.distance(&v, &w);
    prop_assert!(
        distance <= 2.0 * goal,
        "multigrid: {distance:e} of {goal:e}"
    );
    // One more sweep, where the gradient is taken.
    let mut swept = v.clone();
    let mut sweep = BlockGaussSeidel::new();
    sweep
        .prepare(&problem.energy())
        .and_then(|()| problem.iterate(&mut sweep, &mut swept))
        .map_err(fail)?;
    let certified = problem.certified_error(&swept) + problem.distance(&v, &swept);
    prop_assert!(certified <= 1e4 * goal, "{certified:e}, {goal:e}");
    // The start is forgotten, and no step climbs.
    let energy = problem.energy();
    let mut start = problem.nearby(1e-2, seed);
    let mut before = energy.value(&start);
    for _ in 0..4 {
        problem.iterate(&mut solver, &mut start).map_err(fail)?;
        let after = energy.value(&start);
        prop_assert!(
            after <= before + 1e-13 * before.abs(),
            "{before:e} to {after:e}"
        );
        before = after;
    }
    problem.solve(&mut solver, goal, &mut start).map_err(fail)?;
    let distance = problem.distance(&v, &start);
    prop_assert!(
        distance <= 2.0 * goal,
        "other start: {distance:e} of {goal:e}"
    );
    prop_assert_eq!(solver.factorizations(), 1);
    Ok(())
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn in_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in 0..3_usize, seed in any::<u64>(),
    ) {
        agrees(&slider(level, regime, seed).expect("valid"), seed)?;
    }

    #[test]
    fn out_of_the_plane(
        regime in prop::sample::select(&REGIMES[..]), level in 0..3_usize, seed in any::<u64>(),
    ) {
        agrees(&antiplane(level, regime, seed).expect("valid"), seed)?;
    }

    #[test]
    fn in_space(
        regime in prop::sample::select(&REGIMES[..]), level in 0..2_usize, seed in any::<u64>(),
    ) {
        agrees(&block(level, regime, seed).expect("valid"), seed)?;
    }
}

/// A true kink: what is inside Coulomb's cone stays exactly where it is.
#[test]
fn tresca_sticks_where_the_force_is_small() -> Fallible {
    for seed in 0..16 {
        let mut problem = block(1, Regime::Slip, seed)?;
        let mut numbers = Numbers(seed ^ 1);
        for &p in problem.vertices.iter().step_by(2) {
            problem.exact[p].fill(0.0);
        }
        let mut load = vec![SVector::zeros(); problem.exact.len()];
        problem
            .operator
            .multiply_add(1.0, &problem.exact, &mut load);
        let law = Tresca { coefficient: 0.6 };
        let potentials: Vec<_> = (problem.potentials.iter())
            .map(|radial| Radial {
                law,
                force: radial.force,
                state: (),
            })
            .collect();
        for (potential, &p) in potentials.iter().zip(&problem.vertices) {
            let v = problem.exact[p];
            if v.norm() > 0.0 {
                load[p] += v.normalize() * (0.6 * potential.force);
            } else {
                let angle = numbers.between(0.0, std::f64::consts::TAU);
                let inside = numbers.between(0.0, 0.59) * potential.force;
                load[p] += SVector::from([angle.cos(), angle.sin(), 0.0]) * inside;
            }
        }
        let energy = Energy {
            operator: &problem.operator,
            load: &load,
            potentials: &potentials,
            vertices: &problem.vertices,
            fixed: &problem.fixed,
        };
        let mut solver = Condensed::new();
        solver.prepare(&energy)?;
        let mut v = problem.nearby(1e-3, seed);
        solver.minimize(&energy, &problem.stopping(1e-11 * problem.size()), &mut v)?;
        assert!(problem.error(&v) <= 1e-11 * problem.size());
        for &p in problem.vertices.iter().step_by(2) {
            assert!(v[p].iter().all(|&value| value == 0.0));
        }
    }
    Ok(())
}

/// The norm of a change of the boundary is that of the change of the whole field: a solver that
/// knows no bound by the energy stops within the tolerance all the same.
#[test]
fn stops_on_the_norm_of_the_field() -> Fallible {
    for regime in REGIMES {
        let problem = slider(3, regime, 1)?;
        let mut solver = Condensed::new();
        solver.prepare(&problem.energy())?;
        for share in [1e-2, 1e-5, 1e-10] {
            let stopping = Stopping {
                equivalence: f64::INFINITY,
                ..problem.stopping(share * problem.size())
            };
            let mut v = problem.at_rest();
            let report = solver.minimize(&problem.energy(), &stopping, &mut v)?;
            let error = problem.error(&v);
            assert!(
                error <= stopping.tolerance,
                "{regime:?}: {error:e}, {report:?}"
            );
        }
    }
    Ok(())
}

/// A tolerance that no arithmetic meets ends where the rounding errors begin.
#[test]
fn tolerances_below_rounding_are_not_waited_for() -> Fallible {
    for regime in REGIMES {
        let problem = slider(2, regime, 1)?;
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-300, &mut v)?;
        assert!(report.iterations < 60, "{regime:?}: {report:?}");
        assert!(problem.error(&v) <= 1e-12 * problem.size());
    }
    Ok(())
}

#[test]
fn a_step_size_that_returns_is_not_factorised_again() -> Fallible {
    let mut problem = slider(2, Regime::Mixed, 1)?;
    let run = |problem: &Problem<2>, solver: &mut Condensed<2>| -> Fallible {
        let mut v = problem.at_rest();
        problem.solve(solver, 1e-10 * problem.size(), &mut v)?;
        assert!(problem.error(&v) <= 1e-10 * problem.size());
        Ok(())
    };
    let mut solver = Condensed::new();
    let steps = [1.0, 0.5, 0.25, 0.125].map(|part| part * TIME_STEP);
    for round in 0..3 {
        for (k, tau) in steps.into_iter().enumerate() {
            problem.set_time_step(tau);
            run(&problem, &mut solver)?;
            assert_eq!(solver.factorizations(), if round == 0 { k + 1 } else { 4 });
        }
    }
    // A fifth takes the place of the one unused for longest.
    problem.set_time_step(2.0 * TIME_STEP);
    run(&problem, &mut solver)?;
    problem.set_time_step(steps[3]);
    run(&problem, &mut solver)?;
    assert_eq!(solver.factorizations(), 5);
    problem.set_time_step(steps[0]);
    run(&problem, &mut solver)?;
    assert_eq!(solver.factorizations(), 6);
    // A step that differs in its last bit is another one.
    problem.set_time_step(steps[0].next_up());
    run(&problem, &mut solver)?;
    assert_eq!(solver.factorizations(), 7);
    // With one place, two steps in turn are factorised each time.
    let mut solver = Condensed::new().with_cached_factors(1);
    for k in 0..4 {
        problem.set_time_step(steps[k % 2]);
        run(&problem, &mut solver)?;
        assert_eq!(solver.factorizations(), k + 1);
    }
    Ok(())
}

#[test]
fn nothing_is_allocated_once_factors_are_there() -> Fallible {
    fn check<const C: usize>(problem: &mut Problem<C>) -> Fallible {
        let mut solver = Condensed::new();
        for tau in [TIME_STEP, 0.5 * TIME_STEP] {
            problem.set_time_step(tau);
            solver.prepare(&problem.energy())?;
        }
        let starts = [
            problem.at_rest(),
            problem.nearby(1e-6, 1),
            problem.nearby(1.0, 2),
        ];
        let mut v = problem.at_rest();
        for equivalence in [problem.equivalence, f64::INFINITY] {
            let stopping = Stopping {
                equivalence,
                ..problem.stopping(1e-9)
            };
            let mut result = Ok(Default::default());
            let info = measure(|| {
                for start in &starts {
                    v.copy_from_slice(start);
                    result = (result.clone())
                        .and_then(|_| solver.prepare(&problem.energy()))
                        .and_then(|()| solver.minimize(&problem.energy(), &stopping, &mut v));
                }
            });
            assert_eq!(info.count_total, 0, "{info:?}");
            result?;
        }
        // Alternation, too.
        for tau in [TIME_STEP, 0.5 * TIME_STEP] {
            problem.set_time_step(tau);
            let mut result = Ok(());
            let info = measure(|| result = solver.prepare(&problem.energy()));
            assert_eq!(info.count_total, 0, "{info:?}");
            result?;
        }
        assert_eq!(solver.factorizations(), 2);
        Ok(())
    }
    for regime in REGIMES {
        check(&mut slider(2, regime, 1)?)?;
        check(&mut antiplane(2, regime, 1)?)?;
        check(&mut block(1, regime, 1)?)?;
    }
    Ok(())
}

#[test]
fn what_needs_more_memory_than_allowed_is_refused() -> Fallible {
    let problem = slider(3, Regime::Slip, 1)?;
    let unknowns = problem.dense().1.len();
    let mut needs = Vec::new();
    // Refused for its dense part, for its entries and for the whole.
    for allowed in [100, 100_000, 300_000] {
        let mut solver = Condensed::new().with_memory_limit(allowed);
        let mut result = Ok(());
        let info = measure(|| result = solver.prepare(&problem.energy()));
        let Err(SolveError::MemoryLimit {
            unknowns: found,
            needed,
            allowed: limit,
        }) = result
        else {
            panic!("{allowed}: {result:?}");
        };
        assert_eq!((found, limit), (unknowns, allowed));
        assert!(needed > allowed);
        assert!(info.bytes_max < 5_000_000, "{info:?}");
        needs.push(needed);
        let mut v = problem.at_rest();
        let answer = solver.minimize(&problem.energy(), &problem.stopping(1.0), &mut v);
        assert!(matches!(
            answer,
            Err(SolveError::SizeMismatch { expected: 0, .. })
        ));
    }
    assert!(needs.is_sorted());
    let mut solver = Condensed::new().with_memory_limit(20 * needs[2]);
    solver.prepare(&problem.energy())?;
    Ok(())
}

#[test]
fn without_friction_it_is_a_linear_solver() -> Fallible {
    for kind in 0..2 {
        let mut problem = slider(2, Regime::Slip, 1)?;
        problem.potentials.clear();
        problem.vertices.clear();
        if kind == 1 {
            // All but one component of one vertex are held.
            problem.fixed.fill([true; 2]);
            problem.fixed[12][1] = false;
        }
        problem.set_load();
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-12 * problem.size(), &mut v)?;
        assert_eq!(report.iterations, 1);
        assert!(problem.error(&v) <= 1e-12 * problem.size());
    }
    Ok(())
}

#[test]
fn with_one_free_vertex_it_is_the_local_problem() -> Fallible {
    for regime in REGIMES {
        let mut problem = block(1, regime, 1)?;
        let vertex = problem.vertices[4];
        for (i, fixed) in problem.fixed.iter_mut().enumerate() {
            *fixed = if i == vertex {
                [false, false, true]
            } else {
                [true; 3]
            };
        }
        let mut v = problem.at_rest();
        let report = problem.solve(&mut Condensed::new(), 1e-12 * problem.size(), &mut v)?;
        assert!(report.iterations <= 2, "{report:?}");
        assert!(problem.error(&v) <= 1e-12 * problem.size(), "{regime:?}");
        // Nothing is free at all.
        problem.fixed.fill([true; 3]);
        let held = v.clone();
        problem.solve(&mut Condensed::new(), 1e-12, &mut v)?;
        assert_eq!(v, held);
    }
    Ok(())
}

/// `phi(v) = -k v^2/2`: what is left when a strongly weakening state is eliminated.
struct Weakening(f64);

impl ConvexPotential<1> for Weakening {
    fn value(&self, v: &SVector<f64, 1>) -> f64 {
        -0.5 * self.0 * v[0] * v[0]
    }
    fn slope_along(&self, v: &SVector<f64, 1>, d: &SVector<f64, 1>) -> Interval {
        let slope = -self.0 * v[0] * d[0];
        Interval {
            lower: slope,
            upper: slope,
        }
    }
    fn local_model(&self, v: &SVector<f64, 1>) -> LocalModel<1> {
        LocalModel {
            gradient: v * -self.0,
            hessian: SMatrix::from([[-self.0]]),
            smooth: [true],
        }
    }
    fn minimize(&self, block: &SMatrix<f64, 1, 1>, force: &SVector<f64, 1>) -> SVector<f64, 1> {
        force / (block[(0, 0)] - self.0)
    }
}

/// The message a caller can act on: where, and in which iteration.
#[test]
fn a_slope_steeper_than_the_body_is_reported() -> Fallible {
    let problem = antiplane(2, Regime::Slip, 1)?;
    let size = problem.vertices.len();
    let minimize = |slope: &dyn Fn(usize) -> f64| -> Result<_, SolveError> {
        let potentials: Vec<_> = (0..size).map(|k| Weakening(slope(k))).collect();
        let energy = Energy {
            operator: &problem.operator,
            load: &problem.load,
            potentials: &potentials,
            vertices: &problem.vertices,
            fixed: &problem.fixed,
        };
        let mut solver = Condensed::new();
        solver.prepare(&energy)?;
        let mut v = problem.at_rest();
        solver.minimize(&energy, &problem.stopping(1e-10 * problem.size()), &mut v)
    };
    let vertex = 9;
    assert_eq!(
        minimize(&|k| if k == vertex { 1e12 } else { 0.0 }),
        Err(SolveError::NotConvex {
            vertex: problem.vertices[vertex],
            iteration: 1
        })
    );
    // A slope that the body can carry does no harm.
    minimize(&|_| 1.0)?;
    Ok(())
}

#[test]
fn wrong_input_is_an_error() -> Fallible {
    let answer = |spoil: &dyn Fn(&mut Problem<2>)| -> Result<_, Box<dyn std::error::Error>> {
        let mut problem = slider(1, Regime::Mixed, 1)?;
        let mut v = problem.at_rest();
        spoil(&mut problem);
        let before = v.clone();
        let result = problem.solve(&mut Condensed::new(), 1e-9, &mut v);
        if result.is_err() {
            assert_eq!(v, before);
        }
        Ok(result)
    };
    let size = slider(1, Regime::Mixed, 1)?.load.len();
    let mismatch = |expected, found| Err(SolveError::SizeMismatch { expected, found });
    assert_eq!(
        answer(&|p| p.load.truncate(size - 1))?,
        mismatch(size, size - 1)
    );
    assert_eq!(
        answer(&|p| p.fixed.push([false; 2]))?,
        mismatch(size, size + 1)
    );
    assert_eq!(answer(&|p| p.potentials.truncate(3))?, mismatch(11, 3));
    let unsorted = answer(&|p| p.vertices.swap(3, 4))?;
    assert!(matches!(
        unsorted,
        Err(SolveError::UnsortedVertices { position: 4, .. })
    ));
    for value in [f64::NAN, f64::INFINITY] {
        for vertex in [0, 1, 2, 7, 30] {
            let spoiled = answer(&|p| p.load[vertex] = SVector::from([value; 2]))?;
            assert!(
                matches!(spoiled, Err(SolveError::NotFinite { iteration: 1, .. })),
                "{spoiled:?}"
            );
        }
    }
    assert!(answer(&|p| p.operator.data_mut()[17].fill(f64::NAN))?.is_err());
    let negative = answer(&|p| {
        let place = p.operator.iter().position(|(_, (i, j))| (i, j) == (7, 7));
        p.operator.data_mut()[place.expect("stored")] = -SMatrix::identity();
    })?;
    assert_eq!(negative, Err(SolveError::IndefiniteBlock { vertex: 7 }));
    let indefinite = answer(&|p| {
        let places: Vec<_> = p.operator.iter().map(|(_, (i, j))| i != j).collect();
        for (block, _) in p
            .operator
            .data_mut()
            .iter_mut()
            .zip(places)
            .filter(|(_, off)| *off)
        {
            *block *= -20.0;
        }
    })?;
    assert!(
        matches!(indefinite, Err(SolveError::IndefiniteOperator { .. })),
        "{indefinite:?}"
    );
    Ok(())
}

/// After a failed preparation the solver refuses to go on with what it had before.
#[test]
fn a_failed_preparation_leaves_nothing_to_solve_with() -> Fallible {
    let problem = slider(1, Regime::Mixed, 1)?;
    let mut broken = slider(1, Regime::Mixed, 1)?;
    broken.operator.data_mut().fill(SMatrix::zeros());
    let mut solver = Condensed::new();
    solver.prepare(&problem.energy())?;
    assert!(solver.prepare(&broken.energy()).is_err());
    let mut v = problem.at_rest();
    let stopping = problem.stopping(1e-9);
    assert!(
        solver
            .minimize(&problem.energy(), &stopping, &mut v)
            .is_err()
    );
    solver.prepare(&problem.energy())?;
    solver.minimize(&problem.energy(), &stopping, &mut v)?;
    assert_eq!(solver.factorizations(), 1);
    Ok(())
}

#[test]
fn too_few_iterations() -> Fallible {
    let problem = slider(2, Regime::Slip, 1)?;
    let energy = problem.energy();
    let mut solver = Condensed::new();
    solver.prepare(&energy)?;
    for max_iterations in [0, 1] {
        let stopping = Stopping {
            max_iterations,
            ..problem.stopping(1e-13)
        };
        let mut v = problem.at_rest();
        let before = energy.value(&v);
        let answer = solver.minimize(&energy, &stopping, &mut v);
        let Err(SolveError::NotConverged {
            iterations,
            tolerance,
            ..
        }) = answer
        else {
            panic!("{answer:?}");
        };
        assert_eq!((iterations, tolerance), (max_iterations, 1e-13));
        assert!(energy.value(&v) <= before);
    }
    Ok(())
}

/// Another body, other vertices, other masks: bit for bit what a fresh solver does.
#[test]
fn what_was_prepared_before_leaves_no_trace() -> Fallible {
    let mut solver = Condensed::new();
    let mut same = |problem: &Problem<2>| -> Fallible {
        let (mut v, mut w) = (problem.nearby(1e-3, 5), problem.nearby(1e-3, 5));
        let goal = 1e-10 * problem.size();
        let used = problem.solve(&mut solver, goal, &mut v)?;
        let fresh = problem.solve(&mut Condensed::new(), goal, &mut w)?;
        assert_eq!((used, v), (fresh, w));
        Ok(())
    };
    let mut problem = slider(2, Regime::Mixed, 1)?;
    same(&problem)?;
    for tau in [1e-5, TIME_STEP, 1e-2] {
        problem.set_time_step(tau);
        same(&problem)?;
    }
    let keep: Vec<usize> = (0..problem.vertices.len()).filter(|k| k % 3 != 1).collect();
    problem.potentials = keep.iter().map(|&k| problem.potentials[k]).collect();
    problem.vertices = keep.iter().map(|&k| problem.vertices[k]).collect();
    problem.set_load();
    same(&problem)?;
    let inner = problem
        .fixed
        .iter()
        .position(|fixed| fixed == &[false, false]);
    problem.fixed[inner.ok_or("no free vertex")?] = [true, false];
    same(&problem)?;
    same(&slider(1, Regime::Slip, 9)?)
}

#[test]
fn messages_carry_their_numbers() {
    let text = SolveError::MemoryLimit {
        unknowns: 7,
        needed: 99,
        allowed: 42,
    }
    .to_string();
    assert!(
        ["7", "99", "42"].iter().all(|part| text.contains(part)),
        "{text}"
    );
    let text = SolveError::NotConvex {
        vertex: 3,
        iteration: 2,
    }
    .to_string();
    assert!(["3", "2"].iter().all(|part| text.contains(part)), "{text}");
}
