//! Runs that give up, and settings that are refused.

use nalgebra::SMatrix;
use stickslip::friction::Tresca;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, ErrorControl, Newmark, Point, Run, Scene, Simulation,
    StateUpdate, StepError, Steps,
};

use super::{Method, stepper, stick_slip};
use crate::Outcome;

#[test]
fn a_run_gives_up_with_a_reason() -> Outcome {
    let slider = stick_slip(1e-6);
    for method in [Method::RungeKutta, Method::Newmark] {
        let mut block = stepper(&slider, method)?;
        let mut shown = 0;
        let few = Steps::adaptive(1e-6).with_max_steps(10).until(1e3);
        let failure = block.run(&few, |_| shown += 1).err().ok_or("ended")?;
        assert!(
            matches!(failure.cause, StepError::TooManySteps { steps: 10, dt, .. } if dt > 0.0),
            "{failure}"
        );
        assert!(shown <= 10 && block.snapshot().time < 1e3);
        // The smallest step allowed is too large for the first event.
        let mut block = stepper(&slider, method)?;
        let long = Steps::adaptive(1e-6)
            .with_first_step(0.1)
            .with_min_step(0.05)
            .with_max_step(f64::INFINITY)
            .until(1e3);
        let failure = block.run(&long, |_| ()).err().ok_or("ended")?;
        let StepError::StepTooSmall {
            dt,
            error,
            tolerance,
            resisted: true,
        } = failure.cause
        else {
            return Err(failure.into());
        };
        assert!(
            dt < 0.05 && error.largest() > tolerance && tolerance == 1e-6,
            "{failure}"
        );
        // What was reached stays in place.
        assert!(block.snapshot().time > 1.0 && block.snapshot().time < 1e3);
    }
    Ok(())
}

/// Backward Euler misses the logarithm of a state that heals from next to nothing by as much at every step size: the run
/// ends by saying so, and not by a number that is none.
#[test]
fn a_state_that_no_step_resolves_is_named() -> Outcome {
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e5);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e6))
        .with_mass(SMatrix::<f64, 1, 1>::new(10.0))
        .with_contact(contact.with_state(AGING, LogTheta(-800.0)))
        .with_load_history(move |time, load| load[0][0] = 1e3 * time);
    let mut block = Simulation::new(scene, Newmark::default(), Point)?
        .with_state_update(StateUpdate::BackwardEuler);
    let run = block.run(&Steps::adaptive(1e-2).until(1.0), |_| ());
    let failure = run.err().ok_or("ended")?;
    let StepError::StepTooSmall { dt, error, .. } = failure.cause else {
        return Err(failure.into());
    };
    assert!(dt > 0.0 && error.largest() > 1e-2, "{failure}");
    assert!(failure.to_string().len() < 300, "{failure}");
    Ok(())
}

/// On half the critical stiffness, without inertia and damping, slip runs away in finite time: the run ends by saying what
/// the scene lacks. With damping it does not end.
#[test]
fn slip_that_nothing_resists_is_named() -> Outcome {
    let critical = 1e6 * (FRICTION.b - FRICTION.a) / FRICTION.slip_distance;
    let run = |damping: f64| -> Outcome<_> {
        let slider = SpringSlider {
            stiffness: 0.5 * critical,
            normal_stress: 1e6,
            mass: 0.0,
            damping,
            load: LoadPath::steady(1e-6),
        };
        let scene = slider.steady(FRICTION, AGING, 1.1e-6)?;
        let mut block = Simulation::new(scene, BackwardEuler, Point)?;
        let run = block.run(&Steps::adaptive(1e-3).until(1e3), |_| ());
        Ok(run.err().map(|failure| failure.to_string()))
    };
    let failure = run(0.0)?.ok_or("ended")?;
    assert!(
        failure.contains("add mass or radiation damping"),
        "{failure}"
    );
    assert_eq!(run(5e6)?, None);
    Ok(())
}

/// Coulomb's block lets go with a jump of the slip rate, which moves it by no more than a step's way: it is slid
/// over, and the way is the spring's less its stretch.
#[test]
fn a_jump_of_the_slip_rate_is_slid_over() -> Outcome {
    let stiffness = 1e6;
    let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 1e5);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_contact(contact)
        .with_load_history(move |time, load| load[0][0] = 1e3 * time);
    let mut block = Simulation::new(scene, BackwardEuler, Point)?;
    let report = block.run(&Steps::adaptive(1e-3).until(100.0), |_| ())?;
    let at = block.snapshot();
    assert!((at.displacement[0][0] - 0.04).abs() < 1e-15);
    assert_eq!(at.contact(0).slip(0), at.displacement[0][0]);
    // From the first slip on the way grows by a share of itself that the tolerance allows.
    assert!(report.accepted + report.rejected < 1000, "{report:?}");
    Ok(())
}

/// A plan that is refused takes no step and shows none.
fn is_refused(name: &str, steps: &Steps) -> Outcome {
    for method in [Method::RungeKutta, Method::Newmark] {
        let mut block = stepper(&stick_slip(1e-6), method)?;
        let mut shown = 0;
        let failure = block.run(steps, |_| shown += 1).err().ok_or(name)?;
        assert!(
            matches!(failure.cause, StepError::Control { what, .. } if what == name),
            "{name}: {failure}"
        );
        let text = failure.to_string();
        let range = format!("step-size control: {name} must be ");
        assert!(text.contains(&range) && text.contains(", is "), "{text}");
        assert_eq!((shown, block.snapshot().step), (0, 0));
    }
    Ok(())
}

#[test]
fn settings_out_of_range_are_named() -> Outcome {
    let nan = f64::NAN;
    let adaptive = || Steps::adaptive(1e-5).until(1.0);
    let floor = |slip_rate_floor| {
        adaptive().with_error_control(ErrorControl {
            slip_rate_floor,
            ..ErrorControl::default()
        })
    };
    for (name, steps) in [
        ("tolerance", Steps::adaptive(0.0).until(1.0)),
        ("tolerance", Steps::adaptive(-1.0).until(1.0)),
        ("tolerance", Steps::adaptive(nan).until(1.0)),
        ("first step", adaptive().with_first_step(0.0)),
        ("first step", adaptive().with_first_step(nan)),
        (
            "smallest step",
            adaptive().with_min_step(-1.0).with_max_step(1.0),
        ),
        (
            "smallest step",
            adaptive().with_min_step(2.0).with_max_step(1.0),
        ),
        (
            "smallest step",
            adaptive().with_min_step(nan).with_max_step(1.0),
        ),
        (
            "largest step",
            adaptive().with_min_step(0.0).with_max_step(0.0),
        ),
        ("end", adaptive().until(-1.0)),
        ("end", adaptive().until(nan)),
        ("end", adaptive().until(f64::INFINITY)),
        ("end", Steps::constant(0.1).until(-1.0)),
        ("end", Steps::constant(0.1).until(nan)),
        ("end", Steps::constant(0.1).until(f64::INFINITY)),
        ("slip rate floor", floor(-1.0)),
        ("slip rate floor", floor(nan)),
    ] {
        is_refused(name, &steps)?;
    }
    Ok(())
}

/// A stop that is no number is none of the times at which a step could end.
#[test]
fn a_stop_that_is_no_number_is_named() -> Outcome {
    for stop in [f64::NAN, -f64::NAN] {
        for steps in [Steps::adaptive(1e-5), Steps::constant(0.1)] {
            is_refused("stop", &steps.stopping_at([0.5, stop]).until(1.0))?;
        }
    }
    Ok(())
}

/// A tolerance that is no time to which a crossing could be found.
#[test]
fn a_tolerance_of_a_crossing_that_is_none_is_named() -> Outcome {
    for tolerance in [0.0, -1e-3, f64::NAN] {
        for steps in [Steps::adaptive(1e-5), Steps::constant(0.1)] {
            let mut block = stepper(&stick_slip(1e-6), Method::Newmark)?;
            let steps = steps.until(1.0);
            let mut shown = 0;
            let run = block.run_to_crossing(&steps, tolerance, |at| at.time - 0.5, |_| shown += 1);
            let failure = run.err().ok_or("ran")?;
            let StepError::Control { what, value, .. } = failure.cause else {
                return Err(failure.into());
            };
            assert_eq!(what, "tolerance of a crossing");
            assert_eq!(value.to_bits(), tolerance.to_bits());
            assert_eq!((shown, block.snapshot().step), (0, 0));
        }
    }
    Ok(())
}

/// Constant steps that are none fail as a single step of that size does.
#[test]
fn constant_steps_out_of_range_are_named() -> Outcome {
    for dt in [0.0, -0.1, f64::NAN] {
        for method in [Method::RungeKutta, Method::Newmark] {
            for steps in [
                Steps::constant(dt).until(1.0),
                Steps::constant(dt).count(3),
                Steps::constant(dt),
            ] {
                let mut block = stepper(&stick_slip(1e-6), method)?;
                let failure = block.run(&steps, |_| ()).err().ok_or("ran")?;
                let StepError::StepSize { dt: found } = failure.cause else {
                    return Err(failure.into());
                };
                assert_eq!(found.to_bits(), dt.to_bits());
                assert_eq!((failure.step, block.snapshot().step), (1, 0));
            }
        }
    }
    Ok(())
}
