//! Runs in pieces, runs that begin at any time, runs that end at an event.

use std::ops::ControlFlow;

use nalgebra::SMatrix;
use stickslip::friction::Tresca;
use stickslip::integrate::{Stepper, StopReason};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::{
    BoundaryPart, Contact, Newmark, Point, Run, RungeKutta, Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;

/// Stick-slip cycles with radiation damping.
fn cycling() -> SpringSlider {
    SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-6),
    }
}

/// The explicit and the implicit way of taking adaptive steps.
fn ways() -> Outcome<[Box<dyn Stepper<1>>; 2]> {
    let scene = || cycling().steady(FRICTION, AGING, 1.01e-6);
    Ok([
        Box::new(RungeKutta::new(scene()?)?),
        Box::new(Simulation::new(scene()?, Sdirk2, Point)?),
    ])
}

/// A run that an observer ends after each step goes on with the step it had: the same steps, the same bits.
#[test]
fn a_run_in_single_steps_is_the_run() -> Outcome {
    let steps = Steps::adaptive(1e-3).until(400.0);
    for (mut whole, mut pieces) in ways()?.into_iter().zip(ways()?) {
        let taken = whole.run(&steps, |_| ())?;
        let mut count = 0;
        loop {
            let piece = pieces.run(&steps, |_| ControlFlow::Break(()))?;
            count += piece.accepted + piece.rejected;
            if piece.ended == StopReason::Time {
                break;
            }
        }
        assert_eq!(count, taken.accepted + taken.rejected);
        assert_eq!(whole.snapshot().state(), pieces.snapshot().state());
    }
    Ok(())
}

/// A thousand ends cut a thousand steps, and no more: each piece goes on with the step planned before the cut.
#[test]
fn a_thousand_ends_cost_a_step_each() -> Outcome {
    let (end, pieces) = (400.0, 1000);
    for (mut whole, mut cut) in ways()?.into_iter().zip(ways()?) {
        let taken = whole.run(&Steps::adaptive(1e-3).until(end), |_| ())?;
        let mut count = 0;
        for piece in 1..=pieces {
            let time = end * f64::from(piece) / f64::from(pieces);
            let report = cut.run(&Steps::adaptive(1e-3).until(time), |_| ())?;
            count += report.accepted + report.rejected;
        }
        // The way to an end is walked in two halves where one step does not reach it.
        let bound = taken.accepted + taken.rejected + 2 * pieces as usize;
        assert!(count <= bound, "{count}, {bound}");
    }
    Ok(())
}

/// Time has no origin: loads and stops shifted with the start give the same motion.
#[test]
fn a_run_may_start_at_any_time() -> Outcome {
    let run = |start: f64| -> Outcome<_> {
        let stiffness = 1e8;
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_mass(SMatrix::from([[1e3]]))
            .with_contact(
                Contact::new(BoundaryPart::point(1.0), FRICTION, 1e5)
                    .with_state(AGING, stickslip::state::LogTheta(0.0))
                    .with_normal_stress_history(move |time, stress| {
                        stress[0] *= 1.0 - 0.05 * (time - start);
                    }),
            )
            .with_load_history(move |time, load| load[0][0] = stiffness * 1e-2 * (time - start))
            .from_time(start);
        let mut block = Simulation::new(scene, Newmark::default(), Point)?;
        assert_eq!(block.snapshot().time, start);
        assert_eq!(block.snapshot().contact(0).normal_stress(0), 1e5);
        let steps = Steps::constant(0.125).stopping_at([start + 1.0 / 3.0]);
        block.run(&steps.until(start + 8.0), |_| ())?;
        assert_eq!(block.snapshot().time, start + 8.0);
        Ok((block.snapshot().step, block.snapshot().displacement[0][0]))
    };
    let (steps, expected) = run(0.0)?;
    assert!(expected > 1e-3);
    for start in [-8.0, -3.0, 1024.0, 1e6] {
        let (count, moved) = run(start)?;
        assert_eq!(count, steps);
        // Times of 1e6 s are rounded to 1e-10 s, the load with them to 1e-4 N.
        assert!(
            (moved / expected - 1.0).abs() < 1e-8,
            "{start}: {moved}, {expected}"
        );
    }
    Ok(())
}

/// A block under Tresca slides without acceleration from the time at which the spring has its strength: the
/// displacement passes a mark at a time that is known.
#[test]
fn a_crossing_is_located_to_its_tolerance() -> Outcome {
    let (stiffness, velocity, strength) = (1e6, 1e-3, 6e4);
    let scene = || {
        Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_contact(Contact::new(
                BoundaryPart::point(1.0),
                Tresca { coefficient: 0.6 },
                1e5,
            ))
            .with_load_history(move |time, load| load[0][0] = stiffness * velocity * time)
    };
    let mark = 1.2345e-2;
    // Quasi-statically, u = V t - strength / k; the backward Euler scheme is exact for that.
    let expected = (mark + strength / stiffness) / velocity;
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let mut block = Simulation::new(scene(), stickslip::BackwardEuler, Point)?;
        let mut shown = 0;
        let report = block.run_to_crossing(
            &Steps::constant(7.0).until(1000.0),
            tolerance,
            |at| at.displacement[0][0] - mark,
            |_| shown += 1,
        )?;
        assert_eq!(
            (report.ended, report.accepted),
            (StopReason::Crossing, shown)
        );
        let at = block.snapshot();
        assert!(at.displacement[0][0] >= mark);
        let late = at.time - expected;
        assert!((-1e-9..=tolerance + 1e-9).contains(&late), "{late:e}");
        // It goes on from there, and does not end at the same crossing again.
        let report = block.run_to_crossing(
            &Steps::constant(7.0).until(200.0),
            tolerance,
            |at| at.displacement[0][0] - mark,
            |_| (),
        )?;
        assert_eq!(report.ended, StopReason::Time);
        assert_eq!(block.snapshot().time, 200.0);
    }
    Ok(())
}

/// Events of adaptive runs lie where a run with a finer tolerance has them, and the run goes on with the step
/// it had.
#[test]
fn adaptive_runs_end_at_events_and_go_on() -> Outcome {
    let threshold = 1e-3_f64.ln();
    let onsets = |tolerance: f64, way: usize| -> Outcome<Vec<f64>> {
        let [explicit, implicit] = ways()?;
        let mut block = if way == 0 { explicit } else { implicit };
        let (mut onsets, mut count) = (Vec::new(), 0);
        let steps = Steps::adaptive(tolerance).until(1200.0);
        loop {
            let above = |at: stickslip::Snapshot<'_, 1>| at.max_slip_rate().ln() - threshold;
            let report = block.run_to_crossing(&steps, 1e-7, above, |_| ())?;
            count += report.accepted;
            if report.ended == StopReason::Time {
                break;
            }
            onsets.push(block.snapshot().time);
        }
        let whole = ways()?
            .into_iter()
            .nth(way)
            .ok_or("no such way")?
            .run(&steps, |_| ())?;
        // Each event costs the step that was cut.
        assert!(
            count <= whole.accepted + 3 * onsets.len(),
            "{count}, {whole:?}"
        );
        Ok(onsets)
    };
    let fine = onsets(1e-8, 0)?;
    assert!(fine.len() >= 3);
    for way in [0, 1] {
        for (coarse, fine) in onsets(1e-5, way)?.iter().zip(&fine) {
            assert!((coarse - fine).abs() < 1.0, "{coarse}, {fine}");
        }
    }
    Ok(())
}

/// The residuals of the equations of a step, for schemes of one and of two stages.
#[test]
fn residuals_of_steps_are_those_of_rounding() -> Outcome {
    let slider = SpringSlider {
        mass: 1e3,
        ..cycling()
    };
    let scene = || slider.steady(FRICTION, AGING, 1.01e-6);
    let mut block =
        Simulation::new(scene()?, Newmark::default(), Point)?.with_absolute_tolerance(1e-15)?;
    for _ in 0..100 {
        let from = block.state().clone();
        block.step(0.5)?;
        let left = block.residuals(&from);
        assert!(left.force < 1e-9 * left.force_terms, "{left:?}");
        assert!(left.state < 1e-9 && left.displacement < 1e-18, "{left:?}");
    }
    // A state that is not that of the step leaves something.
    let mut from = block.state().clone();
    block.step(0.5)?;
    from.contacts[0].states[0] += 0.1;
    from.displacement[0][0] += 1e-6;
    let left = block.residuals(&from);
    assert!(left.state > 1e-2 && left.displacement > 0.9e-6, "{left:?}");
    let mut block = Simulation::new(scene()?, Sdirk2, Point)?.with_absolute_tolerance(1e-15)?;
    let from = block.state().clone();
    block.step(0.5)?;
    let left = block.residuals(&from);
    assert!(left.force < 1e-9 * left.force_terms && left.state.is_nan());
    Ok(())
}
