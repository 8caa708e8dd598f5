//! Steps with several solutions: the one that continues the last step, by every solver and coupling.

use stickslip::problems::{AGING, END, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;
use stickslip::{Coupling, FixedPoint, Monolithic, Newmark, StepError, Steps};

use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, body, distance, slide};

/// The paper's slider shortly before its first event, by a solver and a coupling.
fn before_the_event(solver: Solver, coupling: Box<dyn Coupling>) -> Outcome<Sliding> {
    let body = body(1);
    let space = body.space()?;
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let slider = slide(&body, &space, laws, Newmark::default(), solver, 1e-11)?;
    let mut slider = slider.with_coupling(coupling);
    slider.run(&Steps::constant(STEP).until(9.9), |_| ())?;
    Ok(slider)
}

/// Ten times the paper's step through an event: all take the same steps, and refuse the same ones at the same size.
#[test]
fn every_solver_and_coupling_takes_the_same_solution() -> Outcome {
    let dt = END / 1000.0;
    let mut sliders = Vec::new();
    for solver in [Solver::Condensed, Solver::Tnnmg, Solver::GaussSeidel] {
        let patient = FixedPoint::accelerated().with_max_iterations(2000);
        sliders.push(before_the_event(solver, Box::new(Monolithic::default()))?);
        sliders.push(before_the_event(solver, Box::new(patient))?);
    }
    let (mut folds, mut followed, mut peak) = (0, 0, 0_f64);
    for _ in 0..60 {
        let results: Vec<_> = sliders.iter_mut().map(|slider| slider.step(dt)).collect();
        let ends: Vec<_> = results
            .iter()
            .map(|result| match result {
                Ok(report) => {
                    followed += report.followed;
                    None
                }
                Err(failure) => match failure.cause {
                    StepError::Fold { reached, .. } => Some(reached),
                    _ => Some(f64::NAN),
                },
            })
            .collect();
        if let Some(first) = ends[0] {
            folds += 1;
            // A fold is found to a millionth of the step, where the solution runs away with a square root.
            let same = |end: &Option<f64>| end.is_some_and(|end| (end / first - 1.0).abs() < 1e-3);
            assert!(ends.iter().all(same), "{results:?}");
            for slider in &mut sliders {
                slider.run(&Steps::constant(dt / 10.0).count(10), |_| ())?;
            }
        } else {
            assert!(ends.iter().all(Option::is_none), "{results:?}");
        }
        let at: Vec<_> = sliders.iter().map(|slider| slider.snapshot()).collect();
        let largest = at[0].velocity.iter().map(|v| v.amax()).fold(0.0, f64::max);
        peak = peak.max(largest);
        for other in &at[1..] {
            let apart = distance(at[0].velocity, other.velocity);
            assert!(apart < 1e-6 * largest, "{}: {apart:e}", other.time);
        }
    }
    assert!(peak > 5e-3, "no event: {peak:e}");
    assert!(folds > 0 && followed > 0, "{folds}, {followed}");
    Ok(())
}
