//! Steps that fail.

use nalgebra::Vector2;
use stickslip::fem::{body_force, elasticity, mass};
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS, PippingSlider};
use stickslip::state::{LogTheta, StateError, StateLaw};
use stickslip::{
    BackwardEuler, BoundaryPart, Cholesky, Components, Contact, FixedPoint, Newmark, Point, Scene,
    Simulation, StateUpdate, StepError, StepFailure, Steps, Tnnmg,
};

use super::{ALPHA, COULOMB, NAN, free_spring, one_line};
use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, bits, body, paper_slider, slide};

/// The cause, place and time of a failure, in one line.
fn failure_of<const C: usize>(stepper: &mut dyn Stepper<C>, dt: f64) -> Outcome<StepFailure> {
    let before = bits(&stepper.snapshot());
    let (step, time) = (stepper.snapshot().step, stepper.snapshot().time);
    let failure = stepper.step(dt).err().ok_or("the step was accepted")?;
    let failure = one_line(failure)?;
    if failure.step != step + 1 || (failure.time - (time + dt)).abs() > 1e-14 * time {
        return Err(format!("another step: {failure}").into());
    }
    if !failure.to_string().contains(&format!("step {}", step + 1)) {
        return Err(format!("which step? {failure}").into());
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
            let StepError::StepSize { dt: found } = failure_of(&mut failing, dt)?.cause else {
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

/// Nothing, but no number around 0.35 s.
fn gap(time: f64) -> f64 {
    if (0.325..0.375).contains(&time) {
        NAN
    } else {
        0.0
    }
}

/// A body whose load or whose pull has a gap, and the vertex at which it is seen.
fn gapped(load: bool) -> Outcome<(Sliding, usize)> {
    let body = body(1);
    let space = body.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS);
    let contact = contact.with_state(AGING, ALPHA);
    let top = PippingSlider::top(&space)?;
    let (scene, vertex) = if load {
        let corner = space.trace(|x| x[0] == 5.0)?.vertices()[0];
        let pull = move |time: f64, load: &mut [Vector2<f64>]| {
            load[corner][0] = 1e3 * time + gap(time);
        };
        (body.scene(&space)?.with_load_history(pull), corner)
    } else {
        let weight = Vector2::new(0.0, -body.density * body.gravity);
        let scene = Scene::new(elasticity(&space, &body.elastic)?)
            .with_mass(mass(&space, body.density)?)
            .with_load(body_force(&space, |_| weight))
            .prescribe_velocity(&top, Components::ALL, |time| [1e-3 * time, gap(time)])
            .in_equilibrium(Cholesky::new());
        (scene, top.vertices()[0])
    };
    let solver = Tnnmg::new(space.transfers());
    let scene = scene.with_contact(contact);
    Ok((Simulation::new(scene, Newmark::default(), solver)?, vertex))
}

/// A load and a pull that are no numbers around 0.35 s: the steps into the gap fail, a longer one
/// over it goes on as if nothing had been tried.
#[test]
fn data_that_turn_nan_are_named_and_can_be_stepped_over() -> Outcome {
    for (load, expected) in [(true, "load"), (false, "prescribed velocity")] {
        let ((mut failing, place), (mut steady, _)) = (gapped(load)?, gapped(load)?);
        failing.run(&Steps::constant(0.1).count(3), |_| ())?;
        steady.run(&Steps::constant(0.1).count(3), |_| ())?;
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
            assert_eq!((what, vertex, value.is_nan()), (expected, place, true));
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
    let make = || -> Outcome<_> {
        let laws = (FRICTION, AGING, ALPHA);
        let scheme = Newmark::default();
        let slider = slide(&body, &space, laws, scheme, Solver::Tnnmg, 1e-10)?;
        Ok(slider.with_coupling(FixedPoint::paper().with_max_iterations(20)))
    };
    let (mut failing, mut steady) = (make()?, make()?);
    failing.run(&Steps::constant(STEP).count(6700), |_| ())?;
    steady.run(&Steps::constant(STEP).count(6700), |_| ())?;
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

    fn evolution_state_slope(&self, _state: LogTheta, _slip_rate: f64) -> f64 {
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
        let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, NORMAL_STRESS);
        let scene = free_spring()
            .with_contact(contact.with_state(Broken, ALPHA).unchecked())
            .with_load_history(|time, load| load[0][0] = 1e6 * time);
        let slider = Simulation::new(scene, BackwardEuler, Point)?;
        let mut slider = slider.with_state_update(update);
        slider.run(&Steps::constant(1e-3).count(5), |_| ())?;
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
        slider.run(&Steps::constant(1e-3).count(5), |_| ())?;
        assert_eq!(slider.snapshot().step, 10);
    }
    Ok(())
}

/// The views of a contact and its supports are those of the last accepted step, also after one
/// that failed at another normal stress.
#[test]
fn reactions_after_a_failed_step_are_those_before_it() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, COULOMB, 1e5)
        .with_free_normal()
        .with_normal_stress_history(|time, stress| {
            stress.iter_mut().for_each(|stress| *stress *= 1.0 + time);
        });
    let scene = body
        .scene(&space)?
        .with_contact(contact)
        .fix(&bottom, Components::Y)
        .with_load_history(|time, load| load[0][0] = gap(time));
    let solver = Tnnmg::new(space.transfers());
    let mut body = Simulation::new(scene, Newmark::default(), solver)?;
    body.run(&Steps::constant(0.1).count(3), |_| ())?;
    let seen = |body: &Sliding| {
        let at = body.snapshot();
        let contact = at.contact(0);
        let stresses = (0..contact.len()).map(|k| contact.normal_stress(k));
        let tractions = (0..contact.len()).map(|k| contact.traction(k)[0]);
        (
            at.reaction(&bottom),
            stresses.collect::<Vec<f64>>(),
            tractions.collect::<Vec<f64>>(),
        )
    };
    let (reaction, stresses, tractions) = seen(&body);
    assert!(body.step(0.05).is_err());
    let (again, same_stresses, same_tractions) = seen(&body);
    assert_eq!(stresses, same_stresses);
    for (traction, same) in tractions.iter().zip(same_tractions) {
        assert!((traction - same).abs() < 1e-6, "{traction}, {same}");
    }
    let (reaction, again) = (reaction?, again?);
    assert!((reaction - again).norm() < 1e-6, "{reaction}, {again}");
    Ok(())
}
