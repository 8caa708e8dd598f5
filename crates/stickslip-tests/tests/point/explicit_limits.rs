//! What explicit steps refuse, shorten and see: stability, ends of plans, rest.

use nalgebra::{DMatrix, SMatrix, Vector1};
use stickslip::bie::{Cells, Fault, Medium, Mode};
use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina, Tresca};
use stickslip::integrate::{Limit, StopReason};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BoundaryPart, Contact, GeneralizedAlpha, Point, Run, RungeKutta, Scene, SceneError, Simulation,
    StepError, Steps,
};

use crate::Outcome;

fn one(value: f64) -> SMatrix<f64, 1, 1> {
    SMatrix::<f64, 1, 1>::new(value)
}

fn fault() -> Outcome<Fault> {
    let rock = Medium {
        shear_modulus: 32e9,
        shear_wave_speed: 3464.0,
    };
    let cells = Cells::new([-15e3, 15e3], 40)?;
    Ok(Fault::whole_space(cells, rock, Mode::Antiplane)?)
}

fn crack(fault: &Fault) -> Outcome<RungeKutta<1>> {
    let contact = Contact::new(fault, Tresca { coefficient: 0.5 }, 120e6)
        .with_shear_stress(Vector1::new(60.1e6));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    Ok(RungeKutta::new(scene)?)
}

/// `dt lambda_max(A)/eta` is at most 3.3066, where the stability function of the method is 1; beyond it a constant step is
/// refused with that limit, or split.
#[test]
fn constant_steps_beyond_stability_are_refused_or_split() -> Outcome {
    let fault = fault()?;
    let stiffness = DMatrix::from(&fault.stiffness())
        .symmetric_eigenvalues()
        .max();
    let damping = DMatrix::from(&fault.radiation_damping())[(0, 0)];
    let limit = 3.306_568 * damping / stiffness;
    let mut exact = crack(&fault)?;
    exact.run(&Steps::adaptive(1e-8).until(60.0), |_| ())?;
    let exact = exact.snapshot().contact(0).slip(20);
    for ratio in [0.99, 1.001, 1.3, 1.7, 4.0, 60.0] {
        let plan = Steps::constant(ratio * limit).until(60.0);
        let mut motion = crack(&fault)?;
        motion.run(&plan, |_| ())?;
        let off = (motion.snapshot().contact(0).slip(20) / exact - 1.0).abs();
        assert!(off < 1e-2, "{ratio}: slip off by {off:e}");
        let refused = crack(&fault)?.run(&plan.without_substeps(), |_| ());
        let cause = refused.err().map(|failure| failure.cause);
        match cause {
            None => assert!(ratio < 1.0, "{ratio}"),
            Some(StepError::Unstable { limit: found, .. }) => {
                assert!(ratio > 1.0);
                // Far beyond it the limit is a bound.
                let off = found / limit;
                assert!((0.8..1.0 + 1e-5).contains(&off), "{ratio}: {off}");
                assert!(off > 0.999 || ratio > 1.5, "{ratio}: {off}");
            }
            Some(cause) => return Err(cause.into()),
        }
    }
    Ok(())
}

/// A step longer than the plan is shortened to the end, and to a stop, at which data jump.
#[test]
fn a_step_longer_than_the_plan_is_shortened() -> Outcome {
    for exponent in [0, 1, 6, 8, 9, 10, 15, 100, 300] {
        for stops in [vec![], vec![0.25]] {
            let jump = if stops.is_empty() {
                f64::INFINITY
            } else {
                0.25
            };
            let scene = Scene::new(one(1.0))
                .with_viscosity(one(1e-3))
                .with_load_history(move |time, load| {
                    load[0][0] = if time < jump { time } else { 10.0 };
                });
            let mut motion = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
            let dt = 10_f64.powi(exponent);
            let count = 1 + stops.len();
            let plan = Steps::constant(dt).until(1.0).stopping_at(stops);
            let report = motion.run(&plan, |_| ())?;
            assert_eq!((report.ended, report.accepted), (StopReason::Time, count));
            assert_eq!(motion.snapshot().time, 1.0, "{dt:e}");
            assert_eq!(motion.snapshot().displacement[0][0] > 2.0, count == 2);
            // There is nothing left.
            let report = motion.run(&plan, |_| ())?;
            assert_eq!((report.ended, report.accepted), (StopReason::Time, 0));
        }
    }
    Ok(())
}

/// A value that is not a number, at the start, at the end of a step or in between, is refused with its time.
#[test]
fn a_crossing_by_no_number_is_refused() -> Outcome {
    for (from, until) in [(0.0, 0.05), (0.48, 0.52), (0.505, 0.506)] {
        let mut motion = crack(&fault()?)?;
        let value = |time: f64| {
            if (from..until).contains(&time) {
                f64::NAN
            } else {
                time - 0.505
            }
        };
        let plan = Steps::constant(0.1).until(1.0);
        let crossed = motion.run_to_crossing(&plan, 1e-6, |at| value(at.time), |_| ());
        let failure = crossed.err().ok_or("crossed")?;
        assert!(matches!(failure.cause, StepError::Control { value, .. } if value.is_nan()));
        assert!((from..until).contains(&failure.time), "{failure}");
    }
    Ok(())
}

/// Friction of one size, whatever the slip rate, has no slip rate without viscosity.
#[test]
fn friction_without_a_slope_needs_viscosity() -> Outcome {
    let scene = |viscosity: f64| {
        let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 1e6);
        let scene = Scene::new(one(1e9))
            .with_load_history(|t, f| f[0][0] = 1e6 * t)
            .with_contact(contact);
        if viscosity > 0.0 {
            scene.with_viscosity(one(viscosity))
        } else {
            scene
        }
    };
    let refused = RungeKutta::new(scene(0.0)).err();
    assert!(matches!(
        refused,
        Some(SceneError::Vertex {
            what: "viscosity",
            vertex: 0,
            ..
        })
    ));
    let mut motion = RungeKutta::new(scene(1e6))?;
    motion.run(&Steps::adaptive(1e-6).until(3.0), |_| ())?;
    assert!(motion.snapshot().displacement[0][0] > 0.0);
    Ok(())
}

/// A block that relaxes under velocity-strengthening friction slides by `a sigma/K ln(1 + V K t/(a sigma))`, from any
/// stress: the first step may not jump over the balance into rest.
#[test]
fn first_steps_do_not_jump_into_rest() -> Outcome {
    let (stiffness, a, normal, rate) = (1e9, 1e-3, 1e6, 1e-9);
    let law = RegularizedDieterichRuina {
        a,
        b: 0.0,
        reference_friction: 0.6,
        reference_velocity: rate,
        slip_distance: 1.0,
    };
    for number in 0..60 {
        let above = 8.0 + 0.25 * f64::from(number);
        for tolerance in [1e-3, 1e-4, 1e-6] {
            let contact = Contact::new(BoundaryPart::point(1.0), law, normal)
                .with_state(Dieterich { slip_distance: 1.0 }, LogTheta(-rate.ln()))
                .with_shear_stress(Vector1::new((0.6 + above * a) * normal));
            let mut motion = RungeKutta::new(Scene::new(one(stiffness)).with_contact(contact))?;
            let first = motion.snapshot().velocity[0][0];
            motion.run(&Steps::adaptive(tolerance).until(1e6), |_| ())?;
            let length = a * normal / stiffness;
            let exact = length * (first * 1e6 / length).ln_1p();
            let off = (motion.snapshot().displacement[0][0] / exact - 1.0).abs();
            assert!(off < 1e-2, "{above}, {tolerance}: off by {off:e}");
        }
    }
    Ok(())
}

/// A stiff slider of one kind, towards its steady state, and its numbers: stiffness, damping, friction.
fn stiff_slider(n: u32) -> Outcome<(RungeKutta<1>, f64, f64, DieterichRuina)> {
    // Digits of multiples of irrational numbers.
    let [a, length, stiffness, damping] =
        [2.0_f64, 3.0, 5.0, 7.0].map(|p| (f64::from(n) * p.sqrt()).fract());
    let (a, slip_distance) = (
        10_f64.powf(-6.0 + 4.0 * a),
        10_f64.powf(-12.0 + 6.0 * length),
    );
    let law = DieterichRuina {
        a,
        b: 0.5 * a,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    };
    // The stiffness far above or far below that of the contact, and both relax in far less than the run.
    let factor = if n.is_multiple_of(2) {
        3.0 + 5.0 * stiffness
    } else {
        -2.0 - stiffness
    };
    let stiffness = 10_f64.powf(factor) * a * 1e6 / slip_distance;
    let damping = 10_f64.powf(4.0 * damping);
    let (rate, state) = (1e-6, LogTheta((slip_distance / 1e-6).ln()));
    let start = 1e6 * law.coefficient(rate, state) + damping * rate;
    let contact = Contact::new(BoundaryPart::point(1.0), law, 1e6)
        .with_state(Dieterich { slip_distance }, state);
    let scene = Scene::new(one(stiffness))
        .with_viscosity(one(damping))
        .with_velocity(vec![[rate].into()])
        .with_load_history(move |time, load| load[0][0] = start + 1.5 * rate * stiffness * time)
        .with_contact(contact);
    Ok((RungeKutta::new(scene)?, stiffness, damping, law))
}

/// A run that ends for its steps, which stability holds at `3.3/lambda`, names that limit, with `lambda` the largest modulus
/// of an eigenvalue of
/// ```text
/// D dV' = -K dV - (b sigma) dalpha',   dalpha' = -dV/L - exp(-alpha) dalpha,   D = eta + a sigma/V
/// ```
///
/// and one whose shortest step is beyond that limit is unstable. Fewer steps, on the way to it, are limited by their error.
#[test]
fn a_stiff_run_names_its_stability_limit() -> Outcome {
    for n in 1..40 {
        let (mut slider, stiffness, damping, law) = stiff_slider(n)?;
        let plan = Steps::adaptive(1e-4).with_first_step(1e-15).until(1e9);
        let early = slider.run(&plan.clone().with_max_steps(3), |_| ());
        let early = early.err().ok_or("ended")?.cause;
        let by_error = matches!(
            early,
            StepError::TooManySteps {
                limit: Limit::Error(_),
                ..
            }
        );
        assert!(by_error, "{n}: {early}");
        let run = slider.run(&plan.clone().with_max_steps(4000), |_| ());
        let failure = run.err().ok_or("ended")?;
        let StepError::TooManySteps {
            limit: Limit::Stability(limit),
            ..
        } = failure.cause
        else {
            return Err(format!("{n}: {failure}").into());
        };
        assert!(
            failure.to_string().contains("use an implicit one"),
            "{failure}"
        );
        let at = slider.snapshot();
        let (rate, aging) = (at.max_slip_rate(), (-at.contact(0).state(0)).exp());
        let resistance = damping + law.a * 1e6 / rate;
        let evolving = law.b * 1e6 / resistance;
        let by_rate = -law.slip_distance.recip();
        let matrix = SMatrix::<f64, 2, 2>::new(
            -stiffness / resistance - evolving * by_rate,
            evolving * aging,
            by_rate,
            -aging,
        );
        let largest = matrix.complex_eigenvalues().map(|own| own.norm()).max();
        let off = limit * largest / 3.306_568 - 1.0;
        assert!(off.abs() < 1e-4, "{n}: {off:e}");
        let refused = slider.run(&plan.with_min_step(1.5 * limit), |_| ());
        let cause = refused.err().ok_or("ended")?.cause;
        let unstable = matches!(cause, StepError::Unstable { dt, .. } if dt == 1.5 * limit);
        assert!(unstable, "{n}: {cause}");
    }
    Ok(())
}
