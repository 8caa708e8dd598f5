//! Errors and costs by the tolerance, and by the step.

use stickslip::{ErrorControl, Run, Steps};

use super::{Method, motion, stepper, stick_slip};
use crate::Outcome;

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// Through two events into the third stick phase; the error is the largest at several times between
/// events, since at a single one it may change its sign.
///
/// A local error of `tol`, as is kept to in each step, makes `h` about `tol^(1/q)`, `q` the order
/// of the estimate, and the error of the end `h^p`, `p` the order of the result: `tol^(p/q)`, for
/// `tol^(-1/q)` steps at most.
#[test]
fn the_error_falls_with_the_tolerance() -> Outcome {
    let slider = stick_slip(1e-6);
    let (times, until) = ([500.0, 600.0, 650.0, 800.0, 850.0, 900.0], 900.0);
    let run = |method, control, tolerance| -> Outcome<_> {
        let mut block = stepper(&slider, method)?;
        let mut peak = 0_f64;
        let mut seen = Vec::new();
        let steps = Steps::adaptive(tolerance)
            .with_error_control(control)
            .stopping_at(times)
            .until(until);
        let report = block.run(&steps, |at| {
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
    // The last number is the decades from one tolerance to the next.
    for (method, control, order, estimated, apart_by) in [
        (Method::RungeKutta, plain, 5.0, 5.0, 1.25),
        (Method::Newmark, plain, 2.0, 3.0, 1.0),
        (
            Method::Newmark,
            ErrorControl::extrapolated(2),
            4.0,
            3.0,
            1.0,
        ),
        (
            Method::Newmark,
            ErrorControl::extrapolated(3),
            6.0,
            5.0,
            1.0,
        ),
        (
            Method::Newmark,
            ErrorControl::extrapolated(4),
            8.0,
            7.0,
            1.0,
        ),
        (Method::Sdirk2, plain, 2.0, 3.0, 1.0),
        (Method::Sdirk2, ErrorControl::extrapolated(2), 3.0, 3.0, 1.0),
    ] {
        let mut errors = Vec::new();
        let mut steps = Vec::new();
        for k in 0..5 {
            let tolerance = 10_f64.powf(-3.0 - apart_by * f64::from(k));
            let (end, accepted) = run(method, control, tolerance)?;
            let pairs = end.iter().zip(&exact);
            errors.push(pairs.map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max));
            steps.push(accepted);
        }
        let range = 4.0 * apart_by;
        let decades = (errors[0] / errors[4]).log10() / range;
        let cost = (steps[4] as f64 / steps[0] as f64).log10() / range;
        // Signed errors of the events' times add up, and may cancel at one tolerance: none is far
        // above the line through the outer two.
        for (k, &error) in errors.iter().enumerate() {
            let line = errors[0] * 10_f64.powf(-decades * apart_by * k as f64);
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

/// Estimated error of one step `dt` from the same point on the way into an event, and the error of
/// eight such steps with each taken as `control` says.
fn local(control: ErrorControl, dt: f64) -> Outcome<[f64; 2]> {
    let slider = stick_slip(1e-6);
    let start = 20.0;
    let mut block = stepper(&slider, Method::Newmark)?;
    let mut exact = stepper(&slider, Method::RungeKutta)?;
    // The same beginning for all, exact to rounding.
    let fine = Steps::adaptive(1e-13);
    let beginning = (fine.clone()).with_error_control(ErrorControl::extrapolated(4));
    block.run(&beginning.until(start), |_| ())?;
    let estimate = block.step_estimated(dt, &control)?;
    block.undo();
    for _ in 0..8 {
        block.step_estimated(dt, &control)?;
    }
    exact.run(&fine.until(block.snapshot().time), |_| ())?;
    Ok([
        estimate.largest(),
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
