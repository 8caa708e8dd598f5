//! Runs that give up, and settings that are refused.

use nalgebra::SMatrix;
use stickslip::friction::Tresca;
use stickslip::{Adaptive, ErrorControl, Patch, Point, Scene, Simulation, StepError, Stepper};

use crate::{Method, Outcome, stepper, stick_slip};

#[test]
fn a_run_gives_up_with_a_reason() -> Outcome {
    let slider = stick_slip(1e-6);
    for method in [Method::RungeKutta, Method::Newmark] {
        let mut block = stepper(&slider, method)?;
        let mut shown = 0;
        let failure = Adaptive::new(1e-6)
            .with_max_steps(10)
            .run(&mut *block, 1e3, &mut |_| shown += 1)
            .err()
            .ok_or("ended")?;
        assert!(
            matches!(failure.cause, StepError::TooManySteps { steps: 10, dt } if dt > 0.0),
            "{failure}"
        );
        assert!(shown <= 10 && block.snapshot().time < 1e3);
        // The smallest step allowed is too large for the first event.
        let mut block = stepper(&slider, method)?;
        let failure = Adaptive::new(1e-6)
            .with_first_step(0.1)
            .with_step_bounds(0.05, f64::INFINITY)
            .run(&mut *block, 1e3, &mut |_| ())
            .err()
            .ok_or("ended")?;
        let StepError::StepTooSmall {
            dt,
            error,
            tolerance,
        } = failure.cause
        else {
            return Err(failure.into());
        };
        assert!(
            dt < 0.05 && error > tolerance && tolerance == 1e-6,
            "{failure}"
        );
        // What was reached stays in place.
        assert!(block.snapshot().time > 1.0 && block.snapshot().time < 1e3);
    }
    Ok(())
}

/// Coulomb's block lets go with a jump of the slip rate: no step is small enough.
#[test]
fn a_jump_of_the_slip_rate_is_reported() -> Outcome {
    let stiffness = 1e6;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
        .with_load_history(move |time, load| load[0][0] = 1e3 * time);
    let mut block = Simulation::new(scene, stickslip::BackwardEuler, Point)?;
    let failure = Adaptive::new(1e-3)
        .run(&mut block, 100.0, &mut |_| ())
        .err()
        .ok_or("ended")?;
    assert!(
        matches!(failure.cause, StepError::StepTooSmall { .. }),
        "{failure}"
    );
    // It lets go at 60 s.
    let time = block.snapshot().time;
    assert!((time - 60.0).abs() < 1e-9, "{time}");
    Ok(())
}

#[test]
fn settings_out_of_range_are_named() -> Outcome {
    let slider = stick_slip(1e-6);
    let nan = f64::NAN;
    let floor = |slip_rate_floor| {
        Adaptive::new(1e-5).with_error_control(ErrorControl {
            slip_rate_floor,
            ..ErrorControl::default()
        })
    };
    for (name, adaptive, until) in [
        ("tolerance", Adaptive::new(0.0), 1.0),
        ("tolerance", Adaptive::new(-1.0), 1.0),
        ("tolerance", Adaptive::new(nan), 1.0),
        ("first step", Adaptive::new(1e-5).with_first_step(0.0), 1.0),
        ("first step", Adaptive::new(1e-5).with_first_step(nan), 1.0),
        (
            "smallest step",
            Adaptive::new(1e-5).with_step_bounds(-1.0, 1.0),
            1.0,
        ),
        (
            "smallest step",
            Adaptive::new(1e-5).with_step_bounds(2.0, 1.0),
            1.0,
        ),
        (
            "smallest step",
            Adaptive::new(1e-5).with_step_bounds(nan, 1.0),
            1.0,
        ),
        (
            "largest step",
            Adaptive::new(1e-5).with_step_bounds(0.0, 0.0),
            1.0,
        ),
        ("end", Adaptive::new(1e-5), -1.0),
        ("end", Adaptive::new(1e-5), nan),
        ("end", Adaptive::new(1e-5), f64::INFINITY),
        ("slip rate floor", floor(-1.0), 1.0),
        ("slip rate floor", floor(nan), 1.0),
    ] {
        let mut block = stepper(&slider, Method::RungeKutta)?;
        let mut shown = 0;
        let failure = adaptive
            .run(&mut *block, until, &mut |_| shown += 1)
            .err()
            .ok_or(name)?;
        assert!(
            matches!(failure.cause, StepError::Control { what, .. } if what == name),
            "{name}: {failure}"
        );
        assert_eq!((shown, block.snapshot().step), (0, 0));
    }
    Ok(())
}

/// A stop that is no number is none of the times at which a step could end.
#[test]
fn a_stop_that_is_no_number_is_named() -> Outcome {
    for stop in [f64::NAN, -f64::NAN] {
        let mut block = stepper(&stick_slip(1e-6), Method::RungeKutta)?;
        let failure = Adaptive::new(1e-5)
            .with_stops([0.5, stop])
            .run(&mut *block, 1.0, &mut |_| ())
            .err()
            .ok_or("ran")?;
        assert!(
            matches!(failure.cause, StepError::Control { what: "stop", .. }),
            "{failure}"
        );
    }
    Ok(())
}
