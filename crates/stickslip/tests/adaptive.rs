//! Adaptive steps: what a tolerance buys, what a rejected step leaves, where a run ends.

use nalgebra::SMatrix;
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::state::Dieterich;
use stickslip::{
    Adaptive, ErrorControl, Events, Monolithic, Newmark, Patch, Point, RungeKutta, Scene,
    SceneError, Sdirk2, Simulation, Snapshot, StateUpdate, StepError, Stepper,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A slider on half the critical stiffness with radiation damping, disturbed.
fn stick_slip(load_velocity: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(load_velocity),
    }
}

/// The ways to integrate a slider without inertia.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    RungeKutta,
    Newmark,
    Sdirk2,
}

fn stepper(slider: &SpringSlider, method: Method) -> Result<Box<dyn Stepper<1>>, SceneError> {
    let rate = slider.load.velocity(0.0);
    let scene = slider.scene(FRICTION, AGING, 1.1 * rate, steady_state(&AGING, rate)?)?;
    Ok(match method {
        Method::RungeKutta => Box::new(RungeKutta::new(scene)?),
        Method::Newmark => Box::new(implicit(scene)?),
        Method::Sdirk2 => {
            Box::new(Simulation::new(scene, Sdirk2, Point)?.with_coupling(Monolithic::default()))
        }
    })
}

type SpringScene = stickslip::problems::SpringScene<DieterichRuina, Dieterich>;
type SpringSimulation = Simulation<SMatrix<f64, 1, 1>, DieterichRuina, Dieterich, Newmark, 1>;

fn implicit(scene: SpringScene) -> Result<SpringSimulation, SceneError> {
    Ok(Simulation::new(scene, Newmark::default(), Point)?
        .with_coupling(Monolithic::default())
        .with_state_update(StateUpdate::Midpoint))
}

/// `ln V` and the state.
fn motion(at: Snapshot<'_, 1>) -> [f64; 2] {
    [at.velocity[0][0].ln(), at.states.state(0)]
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// All numbers as bits.
fn bits(at: &Snapshot<'_, 1>) -> [u64; 5] {
    [
        at.time,
        at.step as f64,
        at.displacement[0][0],
        at.velocity[0][0],
        at.states.state(0),
    ]
    .map(f64::to_bits)
}

/// Through two events into the third stick phase; the error is the largest at several times between
/// events, since at a single one it may change its sign.
///
/// A local error of `tol`, as is kept to in each step, makes `h` about `tol^(1/q)`, `q` the order of the
/// estimate, and the error of the end `h^p`, `p` the order of the result: `tol^(p/q)`, for `tol^(-1/q)`
/// steps at most.
#[test]
fn the_error_falls_with_the_tolerance() -> Outcome {
    let slider = stick_slip(1e-6);
    let (times, until) = ([500.0, 600.0, 650.0, 800.0, 850.0, 900.0], 900.0);
    let run = |method, control, tolerance| -> Result<_, Box<dyn std::error::Error>> {
        let mut block = stepper(&slider, method)?;
        let mut peak = 0_f64;
        let mut seen = Vec::new();
        let report = Adaptive::new(tolerance)
            .with_error_control(control)
            .with_stops(times)
            .run(&mut *block, until, &mut |at| {
                peak = peak.max(at.max_slip_rate());
                if times.iter().any(|&time| (time - at.time).abs() < 1e-9) {
                    seen.push(motion(at));
                }
            })?;
        assert_eq!(block.snapshot().time, until);
        assert_eq!(seen.len(), times.len());
        assert!(peak > 5e-3, "{peak:e}");
        Ok((seen, report.accepted))
    };
    let plain = ErrorControl::default();
    let (exact, _) = run(Method::RungeKutta, plain, 1e-13)?;
    for (method, control, order, estimated) in [
        (Method::RungeKutta, plain, 5.0, 5.0),
        (Method::Newmark, plain, 2.0, 3.0),
        (Method::Newmark, ErrorControl::extrapolated(2), 4.0, 3.0),
        (Method::Newmark, ErrorControl::extrapolated(3), 6.0, 5.0),
        (Method::Newmark, ErrorControl::extrapolated(4), 8.0, 7.0),
        (Method::Sdirk2, plain, 2.0, 3.0),
        (Method::Sdirk2, ErrorControl::extrapolated(2), 3.0, 3.0),
    ] {
        let mut errors = Vec::new();
        let mut steps = Vec::new();
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let (end, accepted) = run(method, control, tolerance)?;
            let pairs = end.iter().zip(&exact);
            errors.push(pairs.map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max));
            steps.push(accepted);
        }
        let decades = (errors[0] / errors[4]).log10() / 4.0;
        let cost = (steps[4] as f64 / steps[0] as f64).log10() / 4.0;
        // Signed errors of the events' times add up, and may cancel at one tolerance: none is far
        // above the line through the outer two.
        for (k, &error) in errors.iter().enumerate() {
            let line = errors[0] * 10_f64.powf(-decades * k as f64);
            assert!(error < 5.0 * line, "{method:?} {control:?} {errors:?}");
        }
        let expected = order / estimated;
        assert!(
            (0.75 * expected..1.1 * expected).contains(&decades),
            "{method:?} {control:?} {errors:?}: {decades} for {expected}"
        );
        assert!(cost < 1.0 / estimated, "{method:?} {control:?} {steps:?}");
    }
    Ok(())
}

#[test]
fn steps_end_on_stops_and_on_the_end() -> Outcome {
    let slider = SpringSlider {
        load: LoadPath::steady(1e-6)
            .then(10.0 / 3.0, 1e-5)
            .then(29.1, 1e-6),
        ..stick_slip(1e-6)
    };
    let mut stops = vec![0.1, 0.7, std::f64::consts::PI, 1e-3, 47.11, 300.0];
    stops.extend(slider.load.kinks());
    for method in [Method::RungeKutta, Method::Newmark, Method::Sdirk2] {
        for control in [ErrorControl::default(), ErrorControl::extrapolated(3)] {
            let mut block = stepper(&slider, method)?;
            let mut times = vec![0.0];
            let until = 97.3;
            let adaptive = Adaptive::new(1e-5)
                .with_error_control(control)
                .with_stops(stops.iter().copied())
                // Behind and beyond the run.
                .with_stops([-1.0, 0.0, 1e9]);
            let report = adaptive.run(&mut *block, until, &mut |at| times.push(at.time))?;
            let mut ulps = 0_f64;
            for stop in stops.iter().copied().filter(|&stop| stop < until) {
                let nearest = times
                    .iter()
                    .map(|time| (time - stop).abs())
                    .fold(f64::INFINITY, f64::min);
                ulps = ulps.max(nearest / (stop.next_up() - stop));
            }
            assert!(ulps <= 1.0, "{method:?} {control:?} {ulps}");
            assert_eq!(block.snapshot().time, until);
            assert_eq!(times.len(), report.accepted + 1);
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
            // No sliver before a stop.
            let shortest = times
                .windows(2)
                .map(|pair| pair[1] - pair[0])
                .fold(f64::INFINITY, f64::min);
            assert!(
                shortest > 0.9 * report.step_range[0],
                "{shortest:e} {report:?}"
            );
            // A second run begins where the first one ended.
            adaptive.run(&mut *block, until, &mut |_| ())?;
            assert_eq!(block.snapshot().time, until);
            adaptive.run(&mut *block, until + 1.0, &mut |_| ())?;
            assert_eq!(block.snapshot().time, until + 1.0);
        }
    }
    Ok(())
}

/// An estimated step that is taken back leaves nothing: not in what is seen, and not in what
/// follows, also where the half of it that is already known is taken over.
#[test]
fn a_step_taken_back_leaves_no_trace() -> Outcome {
    let slider = stick_slip(1e-6);
    for method in [Method::RungeKutta, Method::Newmark, Method::Sdirk2] {
        for control in [
            ErrorControl::default(),
            ErrorControl::extrapolated(2),
            ErrorControl::extrapolated(4),
        ] {
            let mut disturbed = stepper(&slider, method)?;
            let mut calm = stepper(&slider, method)?;
            for n in 0..40_i32 {
                let dt = 0.3 * 1.1_f64.powi(n % 7);
                let before = bits(&disturbed.snapshot());
                for factor in [8.0, 3.0, 2.0] {
                    disturbed.step_estimated(factor * dt, &control)?;
                    assert_ne!(bits(&disturbed.snapshot()), before);
                    disturbed.undo();
                    assert_eq!(bits(&disturbed.snapshot()), before);
                }
                // An impossible step, too.
                assert!(disturbed.step_estimated(f64::NAN, &control).is_err());
                assert_eq!(bits(&disturbed.snapshot()), before);
                let errors = [
                    disturbed.step_estimated(dt, &control)?,
                    calm.step_estimated(dt, &control)?,
                ];
                assert_eq!(errors[0], errors[1], "{method:?} {control:?} {n}");
                let (a, b) = (disturbed.snapshot(), calm.snapshot());
                assert_eq!(bits(&a), bits(&b), "{method:?} {control:?} {n}");
            }
        }
    }
    Ok(())
}

/// Estimated error of one step `dt` from the same point on the way into an event, and the error of
/// eight such steps with each taken as `control` says.
fn local(control: ErrorControl, dt: f64) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let slider = stick_slip(1e-6);
    let start = 20.0;
    let mut block = stepper(&slider, Method::Newmark)?;
    let mut exact = stepper(&slider, Method::RungeKutta)?;
    // The same beginning for all, exact to rounding.
    Adaptive::new(1e-13)
        .with_error_control(ErrorControl::extrapolated(4))
        .run(&mut *block, start, &mut |_| ())?;
    let estimate = block.step_estimated(dt, &control)?;
    block.undo();
    for _ in 0..8 {
        block.step_estimated(dt, &control)?;
    }
    Adaptive::new(1e-13).run(&mut *exact, block.snapshot().time, &mut |_| ())?;
    Ok([
        estimate,
        apart(motion(block.snapshot()), motion(exact.snapshot())),
    ])
}

/// The estimate falls with the power that the controller reckons with, the result with its order.
/// Over eight steps the error of the end has one power less than that of a step, times the number
/// of steps, which stays: one power more than the order.
#[test]
fn estimates_and_results_have_their_orders() -> Outcome {
    for (control, dt, estimated, order) in [
        (ErrorControl::default(), 0.2, 3, 2),
        (ErrorControl::extrapolated(2), 0.4, 3, 4),
        (ErrorControl::extrapolated(3), 4.0, 5, 6),
    ] {
        let block = stepper(&stick_slip(1e-6), Method::Newmark)?;
        assert_eq!(block.error_order(&control), estimated);
        let [coarse, fine] = [local(control, dt)?, local(control, 0.5 * dt)?];
        let powers = [0, 1].map(|k| (coarse[k] / fine[k]).log2());
        let estimated = estimated as f64;
        let order = f64::from(order) + 1.0;
        assert!(
            (powers[0] - estimated).abs() < 0.25,
            "{control:?} {powers:?}"
        );
        assert!((powers[1] - order).abs() < 0.35, "{control:?} {powers:?}");
    }
    Ok(())
}

/// One cycle under tectonic loading: years of rest, milliseconds of slip.
///
/// Steps of constant size would have to be those of the slip: where the smallest step was taken, one
/// of eight times that size has more than five times the local error allowed. So a period takes more
/// than `period / (8 dt)` constant steps of the same accuracy.
#[test]
fn a_slow_cycle_takes_a_thousandth_of_the_constant_steps() -> Outcome {
    let slider = stick_slip(1e-9);
    for (method, control, tolerance) in [
        (Method::RungeKutta, ErrorControl::default(), 1e-5),
        (Method::Newmark, ErrorControl::default(), 1e-5),
        (Method::Newmark, ErrorControl::extrapolated(3), 1e-5),
        (Method::Sdirk2, ErrorControl::default(), 1e-5),
    ] {
        let adaptive = Adaptive::new(tolerance)
            .with_error_control(control)
            .with_first_step(1.0);
        let mut block = stepper(&slider, method)?;
        // The second event has nothing left of the initial disturbance.
        let mut events = Events::new(1e-3, 1e-5);
        let (mut last, mut smallest) = (0.0, (f64::INFINITY, 0.0, 0));
        let mut counts = Vec::new();
        adaptive.run(&mut *block, 2.2e6, &mut |at| {
            events.record(at.time, at.max_slip_rate());
            let dt = at.time - last;
            if dt < smallest.0 {
                smallest = (dt, last, counts.len());
            }
            last = at.time;
            counts.push(events.times().len());
        })?;
        let times = events.times();
        assert!(times.len() >= 3, "{times:?}");
        let period = times[2] - times[1];
        let steps = counts.iter().filter(|&&count| count == 2).count();
        // The same run again, given up after as many steps as lead there.
        let (dt, time, accepted) = smallest;
        let mut again = stepper(&slider, method)?;
        for attempts in accepted.. {
            again = stepper(&slider, method)?;
            let until = adaptive.clone().with_max_steps(attempts);
            assert!(until.run(&mut *again, 2.2e6, &mut |_| ()).is_err());
            if again.snapshot().time >= time {
                break;
            }
        }
        assert_eq!(again.snapshot().time, time);
        // The explicit method may leave the finite numbers.
        let error = again.step_estimated(8.0 * dt, &control);
        let error = error.unwrap_or(f64::INFINITY);
        assert!(error > 5.0 * tolerance, "{error:e}");
        let constant = period / (8.0 * dt);
        assert!(1000.0 * (steps as f64) < constant, "{steps}, {constant:e}");
    }
    Ok(())
}

/// From the third event on the cycle is the limit cycle: one period like the other.
#[test]
fn the_cycle_repeats() -> Outcome {
    let slider = stick_slip(1e-6);
    for (method, control) in [
        (Method::RungeKutta, ErrorControl::default()),
        (Method::Newmark, ErrorControl::extrapolated(4)),
    ] {
        let mut block = stepper(&slider, method)?;
        let mut events = Events::new(1e-3, 1e-5);
        Adaptive::new(1e-10)
            .with_error_control(control)
            .run(&mut *block, 3000.0, &mut |at| {
                events.record(at.time, at.max_slip_rate());
            })?;
        let periods: Vec<f64> = events.times().windows(2).map(|w| w[1] - w[0]).collect();
        assert!(periods.len() >= 4, "{periods:?}");
        for pair in periods[2..].windows(2) {
            assert!((pair[1] / pair[0] - 1.0).abs() < 1e-6, "{periods:?}");
        }
    }
    Ok(())
}

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

/// Between two steps lies a power of two, except where the end cuts.
#[test]
fn quantised_steps_differ_by_powers_of_two() -> Outcome {
    let mut block = stepper(&stick_slip(1e-6), Method::Newmark)?;
    let first = 0.125;
    let mut times = vec![0.0];
    let report = Adaptive::new(1e-4)
        .with_first_step(first)
        .with_quantised_steps()
        .run(&mut *block, 900.0, &mut |at| times.push(at.time))?;
    let mut cut = 0;
    let mut sizes = std::collections::BTreeSet::new();
    for pair in times.windows(2) {
        let octaves = ((pair[1] - pair[0]) / first).log2();
        if (octaves - octaves.round()).abs() < 1e-6 {
            sizes.insert(octaves.round() as i32);
        } else {
            cut += 1;
        }
    }
    // The last one, and the one before it that left as much.
    assert!(cut <= 2, "{cut} of {}", times.len());
    assert!(sizes.len() > 5 && report.accepted > 100);
    Ok(())
}

/// The elastic slider with steps that are quantised: one factor a size, kept.
#[cfg(all(feature = "fem", feature = "tnnmg", feature = "condensed"))]
mod elastic {
    use std::cell::Cell;
    use std::rc::Rc;

    use nalgebra::SVector;
    use stickslip::friction::ConvexPotential;
    use stickslip::problems::{INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
    use stickslip::state::LogTheta;
    use stickslip::tnnmg::{Energy, SolveError, SolveReport, Stopping};
    use stickslip::{BlockMatrix, Condensed, NonsmoothSolver};

    use super::*;

    /// The direct solver, whose factorisations are shown outside.
    struct Counting(Condensed<2>, Rc<Cell<usize>>);

    impl<P: ConvexPotential<2>> NonsmoothSolver<BlockMatrix<2>, P, 2> for Counting {
        fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<2>, P, 2>) -> Result<(), SolveError> {
            self.0.prepare(energy)?;
            self.1.set(self.0.factorizations());
            Ok(())
        }

        fn minimize(
            &mut self,
            energy: &Energy<'_, BlockMatrix<2>, P, 2>,
            stopping: &Stopping<'_, BlockMatrix<2>>,
            v: &mut [SVector<f64, 2>],
        ) -> Result<SolveReport, SolveError> {
            self.0.minimize(energy, stopping, v)
        }
    }

    /// Factorisations and accepted and rejected steps up to the first event.
    fn cost(adaptive: &Adaptive) -> Result<(usize, usize), Box<dyn std::error::Error>> {
        let body = Slider {
            refinements: 2,
            ..Slider::default()
        };
        let space = body.space()?;
        let scene = body
            .scene(&space)?
            .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let count = Rc::new(Cell::new(0));
        let solver = Counting(Condensed::new().with_cached_factors(24), Rc::clone(&count));
        let mut slider =
            Simulation::new(scene, Sdirk2, solver)?.with_coupling(Monolithic::default());
        let mut peak = 0_f64;
        let report = adaptive.run(&mut slider, 10.2, &mut |at| {
            peak = peak.max(at.max_slip_rate());
        })?;
        assert!(peak > 5e-3, "no event: {peak:e}");
        Ok((count.get(), report.accepted + report.rejected))
    }

    #[test]
    fn quantised_steps_share_their_factors() -> Outcome {
        let adaptive = Adaptive::new(1e-2)
            .with_first_step(1e-3)
            .with_error_control(ErrorControl {
                slip_rate_floor: 1e-12,
                ..ErrorControl::default()
            });
        let (many, steps) = cost(&adaptive)?;
        let (few, quantised) = cost(&adaptive.with_quantised_steps())?;
        // A whole and two halves: at most two operators a step, and both where none is kept.
        assert!(many > steps / 2, "{many} of {steps}");
        assert!(few <= 24 && few < many / 4, "{few} of {quantised}");
        Ok(())
    }
}
