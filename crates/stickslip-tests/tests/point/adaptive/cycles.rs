//! Earthquake cycles: what they cost, and that they repeat.

use stickslip::record::EventCatalogue;
use stickslip::{ErrorControl, Run, Steps};

use super::{Method, stepper, stick_slip};
use crate::Outcome;

/// The slip rates at which an event begins and ends [m/s].
const EVENT: [f64; 2] = [1e-3, 1e-5];

/// One cycle under tectonic loading: years of rest, milliseconds of slip.
///
/// Steps of constant size would have to be those of the slip: where the smallest step was taken,
/// one of eight times that size has more than five times the local error allowed. So a period takes
/// more than `period / (8 dt)` constant steps of the same accuracy.
#[test]
fn a_slow_cycle_takes_a_thousandth_of_the_constant_steps() -> Outcome {
    let slider = stick_slip(1e-9);
    for (method, control, tolerance) in [
        (Method::RungeKutta, ErrorControl::default(), 1e-5),
        (Method::Newmark, ErrorControl::default(), 1e-5),
        (Method::Newmark, ErrorControl::extrapolated(3), 1e-5),
        (Method::Sdirk2, ErrorControl::default(), 1e-5),
    ] {
        let adaptive = Steps::adaptive(tolerance)
            .with_error_control(control)
            .with_first_step(1.0)
            .until(2.2e6);
        let mut block = stepper(&slider, method)?;
        // The second event has nothing left of the initial disturbance.
        let mut catalogue = EventCatalogue::new(&block.snapshot(), 0, EVENT, 3e10, 16)?;
        let (mut last, mut smallest) = (0.0, (f64::INFINITY, 0.0, 0));
        let mut counts = Vec::new();
        block.run(&adaptive, |at| {
            catalogue.record(&at);
            let dt = at.time - last;
            if dt < smallest.0 {
                smallest = (dt, last, counts.len());
            }
            last = at.time;
            counts.push(catalogue.events().len() + usize::from(catalogue.is_under_way()));
        })?;
        let events = catalogue.events();
        assert!(events.len() >= 3, "{events:?}");
        let period = events[2].onset - events[1].onset;
        let steps = counts.iter().filter(|&&count| count == 2).count();
        // The same run again, given up after as many steps as lead there.
        let (dt, time, accepted) = smallest;
        let mut again = stepper(&slider, method)?;
        for attempts in accepted.. {
            again = stepper(&slider, method)?;
            let until = adaptive.clone().with_max_steps(attempts);
            assert!(again.run(&until, |_| ()).is_err());
            if again.snapshot().time >= time {
                break;
            }
        }
        assert_eq!(again.snapshot().time, time);
        // The explicit method may leave the finite numbers.
        let error = again.step_estimated(8.0 * dt, &control);
        let error = error.map_or(f64::INFINITY, |error| error.largest());
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
        let mut catalogue = EventCatalogue::new(&block.snapshot(), 0, EVENT, 3e10, 16)?;
        let adaptive = Steps::adaptive(1e-10).with_error_control(control);
        block.run(&adaptive.until(3000.0), |at| {
            catalogue.record(&at);
        })?;
        let pairs = catalogue.events().windows(2);
        let periods: Vec<f64> = pairs.map(|w| w[1].onset - w[0].onset).collect();
        assert!(periods.len() >= 4, "{periods:?}");
        for pair in periods[2..].windows(2) {
            assert!((pair[1] / pair[0] - 1.0).abs() < 1e-6, "{periods:?}");
        }
    }
    Ok(())
}
