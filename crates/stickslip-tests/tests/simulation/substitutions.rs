//! The load of a step is the same in all its velocity problems: it is substituted forward once, and the body follows
//! once.

use std::any::Any;

use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Condensed, Coupling, FixedPoint, Matrix, Monolithic, Newmark, NonsmoothSolver,
    Operator, Staggered,
};

use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, body, slide};

/// The tolerance of the coupling.
const TOLERANCE: f64 = 1e-10;

/// Condensation that takes the load of every problem anew.
struct OneByOne(Condensed<2>);

impl NonsmoothSolver<BlockMatrix<2>, 2> for OneByOne {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<2>, 2>) -> Result<(), SolveError> {
        self.0.prepare(energy)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<2>, 2>,
        stopping: &Stopping<'_, BlockMatrix<2>>,
        v: &mut [nalgebra::SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        self.0.minimize(energy, stopping, v)
    }
}

/// Through stick and slip, every step from where the same step by the other solver began.
fn once_a_step(
    refinements: usize,
    make: fn() -> Box<dyn Coupling>,
    extra: fn(usize) -> usize,
) -> Outcome {
    const STEPS: usize = 6900;
    let body = body(refinements);
    let space = body.space()?;
    let slider = || -> Outcome<Sliding> {
        let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
        let scheme = Newmark::default();
        let slider = slide(&body, &space, laws, scheme, Solver::Condensed, TOLERANCE)?;
        Ok(slider.with_coupling(make()))
    };
    let (mut slider, mut other) = (slider()?, slider()?);
    other.set_solver(OneByOne(Condensed::new()))?;
    let stiffness: &dyn Any = slider.stiffness();
    let stiffness: &BlockMatrix<2> = stiffness.downcast_ref().ok_or("block rows")?;
    let mass: &dyn Any = slider.mass().ok_or("no mass")?;
    let mass = mass.downcast_ref().ok_or("a number a block")?;
    let norm = BlockMatrix::combination_with(&[(1.0, stiffness)], Some((1.0, mass)));
    let (mut slowest, mut fastest) = (f64::INFINITY, 0_f64);
    let (mut iterations, mut others) = (0, 0);
    let mut off = 0_f64;
    for step in 0..STEPS {
        let before = slider.counters();
        other.restore(slider.state())?;
        let report = slider.step(STEP)?;
        let at_once = other.step(STEP)?;
        let after = slider.counters();
        let forward = after.forward_substitutions - before.forward_substitutions;
        let backward = after.backward_substitutions - before.backward_substitutions;
        if step > 0 {
            assert_eq!(forward, 1, "step {step}: {report:?}");
            let extra = extra(report.coupling_iterations);
            assert!(
                (1..=1 + extra).contains(&backward),
                "step {step}: {backward}, {report:?}"
            );
            iterations += report.coupling_iterations;
            others += at_once.coupling_iterations;
        }
        if report.coupling_iterations == at_once.coupling_iterations {
            let (v, w) = (&slider.state().velocity, &other.state().velocity);
            let difference: Vec<_> = v.iter().zip(w).map(|(v, w)| v - w).collect();
            off = off.max(norm.norm(&difference));
        }
        let rate = slider.snapshot().max_slip_rate();
        slowest = slowest.min(rate);
        fastest = fastest.max(rate);
    }
    assert!(
        slowest < 1e-20 && fastest > 5e-3,
        "{slowest:e}, {fastest:e}"
    );
    assert_eq!(slider.counters().factorizations, 1);
    assert!(off <= TOLERANCE, "{off:e}");
    let mean = (iterations as f64 - others as f64).abs() / STEPS as f64;
    assert!(mean < 0.01, "{iterations}, {others}");
    Ok(())
}

/// The cost of the rounding errors in a step of more than eight velocity problems.
fn patient(iterations: usize) -> usize {
    usize::from(iterations > 8)
}

fn none(_: usize) -> usize {
    0
}

#[test]
fn by_the_papers_rule() -> Outcome {
    for refinements in [1, 2] {
        once_a_step(refinements, || Box::new(FixedPoint::paper()), patient)?;
    }
    Ok(())
}

#[test]
fn by_aitkens_rule() -> Outcome {
    for refinements in [1, 2] {
        once_a_step(refinements, || Box::new(FixedPoint::accelerated()), patient)?;
    }
    Ok(())
}

#[test]
fn at_once() -> Outcome {
    once_a_step(1, || Box::new(Monolithic::default()), none)?;
    once_a_step(2, || Box::new(Monolithic::default()), none)
}

#[test]
fn in_passes() -> Outcome {
    once_a_step(1, || Box::new(Staggered::with_passes(2)), none)?;
    once_a_step(2, || Box::new(Staggered::with_passes(3)), none)
}
