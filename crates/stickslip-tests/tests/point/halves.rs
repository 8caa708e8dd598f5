//! A way through time of one's own: a simulation that takes each step as two halves.

use std::ops::ControlFlow;

use nalgebra::SMatrix;
use stickslip::integrate::{ControlState, LocalError, StepReport, Stepper, StopReason};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::{
    ErrorControl, Newmark, Point, Run, Scene, SceneError, Simulation, Snapshot, StepError,
    StepFailure, StepState, Steps,
};

use crate::Outcome;

type Block = Simulation<1>;

struct Halves {
    inner: Block,
    /// The state at the beginning of the last step.
    before: StepState<1>,
}

impl Halves {
    fn new(inner: Block) -> Self {
        let before = inner.state().clone();
        Self { inner, before }
    }

    /// Goes back after a failure of the second half.
    fn both(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        let from = self.inner.state().clone();
        self.inner.step(0.5 * dt)?;
        let second = self.inner.step(0.5 * dt);
        if second.is_err() {
            assert!(self.inner.restore(&from).is_ok());
        }
        second
    }
}

impl Stepper<1> for Halves {
    fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        self.both(dt)
    }

    fn step_estimated(&mut self, dt: f64, _: &ErrorControl) -> Result<LocalError, StepFailure> {
        let from = self.inner.state().clone();
        self.inner.step(dt)?;
        let whole = self.inner.state().clone();
        assert!(self.inner.restore(&from).is_ok());
        self.both(dt)?;
        self.before = from;
        let at = self.inner.state();
        let mut error = LocalError::default();
        // Of an order of two, by a third of the difference.
        let rates = [at.velocity[0][0], whole.velocity[0][0]];
        error.slip_rate.error = (rates[0] / rates[1]).ln().abs() / 3.0;
        error.slip_rate.value = rates[0];
        error.state.error = (at.contacts[0].states[0] - whole.contacts[0].states[0]).abs() / 3.0;
        Ok(error)
    }

    fn error_order(&self, _: &ErrorControl) -> usize {
        3
    }

    fn set_stops(&mut self, stops: &[f64]) {
        self.inner.set_stops(stops);
    }

    fn undo(&mut self) {
        assert!(self.inner.restore(&self.before).is_ok());
    }

    fn state(&self) -> &StepState<1> {
        self.inner.state()
    }

    fn snapshot(&self) -> Snapshot<'_, 1> {
        self.inner.snapshot()
    }

    fn restore(&mut self, state: &StepState<1>) -> Result<(), SceneError> {
        self.inner.restore(state)
    }

    fn remember(&mut self, control: ControlState) {
        Stepper::remember(&mut self.inner, control);
    }
}

/// A slider whose load speeds up tenfold at 5 s.
fn slider() -> SpringSlider {
    SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass: 5e3,
        damping: 0.0,
        load: LoadPath::steady(1e-6).then(5.0, 1e-5),
    }
}

fn block() -> Outcome<Block> {
    let scene = slider().steady(FRICTION, AGING, 1e-6)?;
    Ok(Simulation::new(scene, Newmark::default(), Point)?)
}

/// Its constant steps are those of the simulation at half the size, bit for bit; each of its own is shown once.
#[test]
fn constant_steps_are_those_of_half_the_size() -> Outcome {
    let (mut halves, mut plain) = (Halves::new(block()?), block()?);
    let mut shown = 0;
    let plan = Steps::constant(0.125).count(100).stopping_at([5.0]);
    let report = halves.run(&plan, |_| shown += 1)?;
    plain.run(
        &Steps::constant(0.0625).count(200).stopping_at([5.0]),
        |_| (),
    )?;
    assert_eq!(
        (report.accepted, shown, report.ended),
        (100, 100, StopReason::Count)
    );
    assert_eq!(halves.state(), plain.state());
    assert_eq!(halves.snapshot().step, 200);
    Ok(())
}

/// Adaptive steps keep to a tolerance, stop where they are told to, and go on behind an observer's break with the step they
/// had.
#[test]
fn adaptive_steps_keep_to_their_tolerance() -> Outcome {
    let mut exact = block()?;
    let plan = |tolerance: f64| Steps::adaptive(tolerance).until(40.0).stopping_at([5.0]);
    exact.run(&plan(1e-9), |_| ())?;
    let read = |at: Snapshot<'_, 1>| [at.max_slip_rate().ln(), at.contact(0).state(0)];
    let expected = read(exact.snapshot());
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut halves: Box<dyn Stepper<1>> = Box::new(Halves::new(block()?));
        let mut stopped = false;
        let whole = halves.run(&plan(tolerance), |at| stopped |= at.time == 5.0)?;
        assert!(stopped && halves.snapshot().time == 40.0);
        for (found, expected) in read(halves.snapshot()).iter().zip(expected) {
            let allowed = tolerance * whole.accepted as f64;
            assert!((found - expected).abs() < allowed, "{tolerance}: {whole:?}");
        }
        let mut pieces = Halves::new(block()?);
        let mut count = 0;
        loop {
            let piece = pieces.run(&plan(tolerance), |_| ControlFlow::Break(()))?;
            count += piece.accepted + piece.rejected;
            if piece.ended == StopReason::Time {
                break;
            }
        }
        assert_eq!(count, whole.accepted + whole.rejected);
        assert_eq!(pieces.state(), halves.state());
    }
    Ok(())
}

/// It ends at a crossing, as any other.
#[test]
fn a_crossing_is_located() -> Outcome {
    let mut halves = Halves::new(block()?);
    let steps = Steps::constant(0.5).until(40.0).stopping_at([5.0]);
    let passes = |at: Snapshot<'_, 1>| at.max_slip_rate() - 5e-6;
    let report = halves.run_to_crossing(&steps, 1e-6, passes, |_| ())?;
    assert_eq!(report.ended, StopReason::Crossing);
    let at = halves.snapshot();
    assert!(at.time > 5.0 && at.max_slip_rate() >= 5e-6);
    Ok(())
}

/// Data that end inside a step fail in its second half: the last accepted step stays, substeps and adaptive ones come as
/// close as they may.
#[test]
fn a_failure_of_the_second_half_leaves_the_last_step() -> Outcome {
    let ends = 0.8;
    let block = || -> Outcome<_> {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1.0))
            .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
            .with_load_history(move |time, load| {
                load[0][0] = if time > ends { f64::NAN } else { time }
            });
        Ok(Halves::new(Simulation::new(
            scene,
            Newmark::default(),
            Point,
        )?))
    };
    let mut halves = block()?;
    halves.step(0.5)?;
    let before = halves.state().clone();
    let failure = halves.step(0.5).err().ok_or("taken")?;
    assert!(matches!(failure.cause, StepError::Data { .. }), "{failure}");
    assert_eq!(*halves.state(), before);
    let failure = halves.run(&Steps::constant(0.5).until(2.0), |_| ());
    let failure = failure.err().ok_or("ended")?;
    assert!(matches!(failure.cause, StepError::Data { .. }), "{failure}");
    let time = halves.snapshot().time;
    assert!(time <= ends && time > ends - 1e-3, "{time}");
    Ok(())
}
