//! Steps that fail.

use stickslip::problems::{AGING, FRICTION, NORMAL_STRESS, Slider};
use stickslip::state::{LogTheta, StateError, StateLaw};
use stickslip::{
    BackwardEuler, Failure, FixedPoint, Newmark, Point, Simulation, StateUpdate, StepError,
    Stepper, Tnnmg,
};

use crate::common::{Outcome, STEP, Solver, bits, body, paper_slider, slide};
use crate::{ALPHA, NAN, aging_spring, one_line};

/// What failed, where and when; in one line that says so.
fn failure_of<const C: usize>(stepper: &mut dyn Stepper<C>, dt: f64) -> Result<Failure, String> {
    let before = bits(&stepper.snapshot());
    let (step, time) = (stepper.snapshot().step, stepper.snapshot().time);
    let failure = stepper.step(dt).err().ok_or("the step was accepted")?;
    let failure = one_line(failure)?;
    if failure.step != step + 1 || (failure.time - (time + dt)).abs() > 1e-14 * time {
        return Err(format!("another step: {failure}"));
    }
    if !failure.to_string().contains(&format!("step {}", step + 1)) {
        return Err(format!("which step? {failure}"));
    }
    let after = stepper.snapshot();
    if bits(&after) != before || (after.step, after.time) != (step, time) {
        return Err("the last accepted step has changed".into());
    }
    Ok(failure)
}

#[test]
fn step_sizes_out_of_range_leave_no_trace() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let mut failing = paper_slider(&body, &space, Solver::Tnnmg, 1e-10)?;
    let mut steady = paper_slider(&body, &space, Solver::Tnnmg, 1e-10)?;
    for n in 0..60 {
        for dt in [0.0, -STEP, NAN, f64::INFINITY] {
            let StepError::StepSize { dt: found } = failure_of(&mut *failing, dt)?.cause else {
                return Err("another failure".into());
            };
            assert_eq!(found.to_bits(), dt.to_bits());
        }
        let dt = if n < 40 { STEP } else { 3.0 * STEP };
        assert_eq!(failing.step(dt)?, steady.step(dt)?);
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        assert_eq!(failing.snapshot().time, steady.snapshot().time);
    }
    Ok(())
}

/// A load and a pull that are no numbers around 0.35 s: the steps into the gap fail, a longer one
/// over it goes on as if nothing had been tried.
#[test]
fn data_that_turn_nan_are_named_and_can_be_stepped_over() -> Outcome {
    let gap = |time: f64| {
        if (0.325..0.375).contains(&time) {
            NAN
        } else {
            0.0
        }
    };
    let body = body(1);
    let space = body.space()?;
    let side = space.trace(|x| x[0] == 5.0)?;
    let corner = side.vertices()[0];
    let first = space.trace(|x| x[1] == 1.0)?.vertices()[0];
    for load in [true, false] {
        let make = || -> Result<_, Box<dyn std::error::Error>> {
            let scene = body
                .scene(&space)?
                .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
                .with_state(AGING, ALPHA);
            let scene = if load {
                scene.with_load_history(move |time, load| load[corner][0] = 1e3 * time + gap(time))
            } else {
                let top = space.trace(|x| x[1] == 1.0)?;
                scene.move_at(&top, [true, true], move |time| [1e-3 * time, gap(time)])
            };
            let solver = Tnnmg::new(space.hierarchy().prolongations());
            Ok(Simulation::new(scene, Newmark::default(), solver)?)
        };
        let (mut failing, mut steady) = (make()?, make()?);
        failing.run(3, 0.1, &mut |_| ())?;
        steady.run(3, 0.1, &mut |_| ())?;
        for dt in [0.05, 0.03] {
            let failure = failure_of(&mut failing, dt)?;
            let StepError::Data {
                what,
                vertex,
                value,
            } = failure.cause
            else {
                return Err(failure.into());
            };
            let expected = if load {
                ("load", corner)
            } else {
                ("prescribed velocity", first)
            };
            assert_eq!(
                (what, vertex, value.is_nan()),
                (expected.0, expected.1, true)
            );
            assert!((failure.time - (0.3 + dt)).abs() < 1e-15);
        }
        for _ in 0..5 {
            assert_eq!(failing.step(0.1)?, steady.step(0.1)?);
            assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        }
        assert!(failing.snapshot().max_slip_rate() > 0.0);
    }
    Ok(())
}

/// In the middle of an event a long step needs more than 20 velocity problems; the short ones after
/// it go on as if it had never been tried.
#[test]
fn steps_that_do_not_couple_can_be_taken_shorter() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let make = || -> Result<_, Box<dyn std::error::Error>> {
        let laws = (FRICTION, AGING, ALPHA);
        let scheme = Newmark::default();
        let slider = slide(&body, &space, laws, scheme, Solver::Tnnmg, 1e-10)?;
        Ok(slider.with_coupling(FixedPoint::paper().with_max_iterations(20)))
    };
    let (mut failing, mut steady) = (make()?, make()?);
    failing.run(6700, STEP, &mut |_| ())?;
    steady.run(6700, STEP, &mut |_| ())?;
    let (mut failures, mut most, mut peak) = (0, 0, 0_f64);
    for _ in 0..50 {
        let before = failing.snapshot().step;
        match failing.step(10.0 * STEP) {
            Ok(_) => {
                steady.step(10.0 * STEP)?;
            }
            Err(failure) => {
                let StepError::NotCoupled {
                    iterations: 20,
                    change,
                    tolerance: 1e-10,
                } = failure.cause
                else {
                    return Err(failure.into());
                };
                assert!(change > 1e-10 && change.is_finite());
                assert_eq!(
                    (failure.step, failing.snapshot().step),
                    (before + 1, before)
                );
                one_line(failure)?;
                failures += 1;
            }
        }
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        let report = failing.step(STEP)?;
        assert_eq!(report, steady.step(STEP)?);
        assert_eq!(bits(&failing.snapshot()), bits(&steady.snapshot()));
        assert_eq!(failing.snapshot().time, steady.snapshot().time);
        most = report.coupling_iterations.max(most);
        peak = failing.snapshot().max_slip_rate().max(peak);
    }
    assert!(
        failures > 0 && most > 5 && peak > 1e-3,
        "{failures}, {most}, {peak:e}"
    );
    Ok(())
}

/// A law that has no answer is named with vertex and rate.
#[derive(Debug, Clone, Copy)]
struct Broken;

impl StateLaw for Broken {
    type State = LogTheta;

    fn evolution(&self, _state: LogTheta, slip_rate: f64) -> f64 {
        if slip_rate > 1e-3 { NAN } else { 0.0 }
    }

    fn evolution_slope(&self, _state: LogTheta, _slip_rate: f64) -> f64 {
        0.0
    }
}

#[test]
fn a_state_law_without_an_answer_is_named() -> Outcome {
    let first_stage = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    for (update, step) in [
        (StateUpdate::BackwardEuler, 1.0),
        (StateUpdate::Midpoint, first_stage),
    ] {
        let scene = aging_spring()
            .with_state(Broken, ALPHA)
            .with_load_history(|time, load| load[0][0] = 1e6 * time);
        let slider = Simulation::new(scene, BackwardEuler, Point)?;
        let mut slider = slider.with_state_update(update);
        slider.run(5, 1e-3, &mut |_| ())?;
        let failure = failure_of(&mut slider, 1.0)?;
        let StepError::State {
            vertex,
            slip_rate,
            source,
        } = failure.cause
        else {
            return Err(failure.into());
        };
        assert!(vertex == 0 && slip_rate > 1e-3);
        assert!(
            matches!(source, StateError::Advance { dt, .. } if dt == step),
            "{source:?}"
        );
        slider.run(5, 1e-3, &mut |_| ())?;
        assert_eq!(slider.snapshot().step, 10);
    }
    Ok(())
}
