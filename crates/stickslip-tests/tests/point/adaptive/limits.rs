//! The limit on the steps of a run, reported when it runs out of them.

use std::f64::consts::TAU;

use nalgebra::SMatrix;
use stickslip::friction::DieterichRuina;
use stickslip::integrate::{ErrorOf, Limit};
use stickslip::problems::spring_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, CentralDifferences, Contact, ErrorControl, Newmark, Point, Scene, Simulation,
    StepError, Steps,
};

use crate::Outcome;

type Block = Simulation<1>;

/// A block that slides at 1e-6 m/s, a fifth more or less once a second, and has done so for ever.
fn swaying() -> Outcome<Block> {
    let (rate, stiffness, normal_stress) = (1e-6, 5e9, 1e6);
    let DieterichRuina {
        reference_friction,
        slip_distance,
        ..
    } = FRICTION;
    let steady = LogTheta((slip_distance / rate).ln());
    let contact =
        Contact::new(BoundaryPart::point(1.0), FRICTION, normal_stress).with_state(AGING, steady);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_contact(contact)
        .with_load_history(move |time, load| {
            let way = rate * (time + 0.2 * (TAU * time).sin() / TAU);
            load[0][0] = stiffness * way + normal_stress * reference_friction;
        });
    Ok(Simulation::new(scene, Newmark::default(), Point)?)
}

/// A mass on a spring, once a second, without friction.
fn oscillator() -> Outcome<Block> {
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(TAU * TAU))
        .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
        .with_velocity(vec![[1.0].into()]);
    Ok(Simulation::new(scene, Newmark::default(), Point)?)
}

const MAX_STEPS: usize = 1000;

/// The limit reported by a run with too few steps.
fn gives_up(block: &mut Block, steps: Steps) -> Outcome<Limit> {
    let run = block.run(&steps.with_max_steps(MAX_STEPS).until(1e7), |_| ());
    let failure = run.err().ok_or("ended")?;
    let StepError::TooManySteps { steps, dt, limit } = failure.cause else {
        return Err(failure.into());
    };
    assert!(steps == MAX_STEPS && dt > 0.0, "{failure}");
    assert_eq!(failure.to_string().lines().count(), 1);
    Ok(limit)
}

#[test]
fn a_run_out_of_steps_names_its_limit() -> Outcome {
    let at_rest = ErrorControl {
        slip_rate_floor: 1.0,
        motion: 0.0,
        ..ErrorControl::default()
    };
    let rates = ErrorControl {
        motion: 0.0,
        ..ErrorControl::default()
    };
    for (control, block, of) in [
        (rates, swaying()?, ErrorOf::SlipRate),
        (at_rest, swaying()?, ErrorOf::State),
        (ErrorControl::default(), oscillator()?, ErrorOf::Motion),
    ] {
        let mut block = block;
        let steps = Steps::adaptive(1e-4).with_error_control(control);
        let Limit::Error(error) = gives_up(&mut block, steps)? else {
            return Err("limited by something else".into());
        };
        assert_eq!(error.largest_of(), of, "{error}");
        assert!(error.largest() > 0.0, "{error}");
        assert_eq!((error.slip_rate.vertex, error.state.vertex), (0, 0));
        if of == ErrorOf::SlipRate {
            // The rate may be less or more by the fifth, and by what friction adds.
            assert!((0.5e-6..2e-6).contains(&error.slip_rate.value), "{error}");
        }
        if of == ErrorOf::State {
            // ln(L/V) less or more.
            assert!((error.state.value - 10_f64.ln()).abs() < 0.5, "{error}");
        }
    }
    Ok(())
}

#[test]
fn a_bound_is_a_limit_too() -> Outcome {
    let bounded = Steps::adaptive(1e-2).with_max_step(1e-3);
    let limit = gives_up(&mut oscillator()?, bounded)?;
    assert_eq!(limit, Limit::LargestStep(1e-3));
    Ok(())
}

/// The largest stable step is 2 over the frequency. One step fails, and tells.
#[test]
fn an_explicit_scheme_is_limited_by_its_stability() -> Outcome {
    let stable = 2.0 / TAU;
    for steps in [
        Steps::adaptive(1e3),
        Steps::adaptive(1e3).in_powers_of_two(),
    ] {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(TAU * TAU))
            .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
            .with_velocity(vec![[1.0].into()]);
        let mut block = Simulation::new(scene, CentralDifferences, Point)?;
        let report = block.run(&steps.clone().until(1e3), |_| ())?;
        assert_eq!((report.failed, report.rejected), (1, 0));
        let [_, largest] = report.step_range;
        assert!(largest <= stable && largest > 0.49 * stable, "{report:?}");
        let Limit::Stability(limit) = gives_up(&mut block, steps)? else {
            return Err("limited by something else".into());
        };
        assert!((limit / stable - 1.0).abs() < 1e-6, "{limit}");
    }
    Ok(())
}

/// Where nothing but a sway limits them, steps of powers of two are at most twice as many as those of any size, but
/// for the share of the tolerance that they aim at: `(0.8/0.5)^(1/3)`, and the rejections that this spares.
#[test]
fn quantised_steps_grow_to_what_the_error_allows() -> Outcome {
    let count = |steps: Steps| -> Outcome<usize> {
        let report = oscillator()?.run(&steps.with_first_step(1e-6).until(1e3), |_| ())?;
        Ok(report.accepted + report.rejected)
    };
    for tolerance in [1e-3, 1e-5] {
        let any = count(Steps::adaptive(tolerance))?;
        let quantised = count(Steps::adaptive(tolerance).in_powers_of_two())?;
        let bound = 2.0 * (0.8_f64 / 0.5).cbrt() * any as f64;
        assert!((quantised as f64) < bound, "{quantised} for {any}");
    }
    Ok(())
}
