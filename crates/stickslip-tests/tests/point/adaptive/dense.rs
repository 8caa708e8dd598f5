//! Times inside of steps: as accurate as the steps, which stay as they are.

use stickslip::{Run, Steps};

use super::{Method, motion, stepper, stick_slip};
use crate::Outcome;

const UNTIL: f64 = 900.0;

fn times() -> Vec<f64> {
    (0..=3000).map(|k| UNTIL * f64::from(k) / 3000.0).collect()
}

/// Through two events: no sample is further from a run of tolerance 1e-13 that ends steps there than ten times the
/// largest difference of the ends of steps from it, which are those of the method.
#[test]
fn samples_are_as_accurate_as_steps() -> Outcome {
    let slider = stick_slip(1e-6);
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let steps = Steps::adaptive(tolerance).until(UNTIL);
        let [mut samples, mut ends] = [Vec::new(), Vec::new()];
        let mut block = stepper(&slider, Method::RungeKutta)?;
        let seen = |at: stickslip::Snapshot<'_, 1>| (at.time, motion(at));
        block.run_sampled(
            &steps,
            &times(),
            |at| samples.push(seen(at)),
            |at| {
                ends.push(seen(at));
            },
        )?;
        assert_eq!(samples.len(), times().len());
        let exact = Steps::adaptive(1e-13).until(UNTIL);
        let mut found = Vec::new();
        for shown in [&samples, &ends] {
            let mut reference = stepper(&slider, Method::RungeKutta)?;
            let stops: Vec<f64> = shown.iter().map(|(time, _)| *time).collect();
            let steps = exact.clone().stopping_at(stops.iter().copied());
            let mut at_stops = Vec::new();
            reference.run_sampled(&steps, &stops, |at| at_stops.push(motion(at)), |_| ())?;
            assert_eq!(at_stops.len(), shown.len());
            let errors = shown.iter().zip(&at_stops);
            found.push(errors.map(|((_, a), b)| apart(*a, *b)).fold(0.0, f64::max));
        }
        let [inside, at_ends] = [found[0], found[1]];
        assert!(
            inside < 10.0 * at_ends,
            "{tolerance:e}: {inside:e} {at_ends:e}"
        );
    }
    Ok(())
}

/// The steps of a run with samples have the bits of those without.
#[test]
fn samples_change_no_step() -> Outcome {
    let slider = stick_slip(1e-6);
    let steps = Steps::adaptive(1e-5).until(UNTIL).stopping_at([123.0]);
    let mut ends = [Vec::new(), Vec::new()];
    let [with, without] = &mut ends;
    let push = |into: &mut Vec<_>, at: stickslip::Snapshot<'_, 1>| {
        into.push((at.time, motion(at), at.contact(0).traction(0)));
    };
    let mut block = stepper(&slider, Method::RungeKutta)?;
    block.run_sampled(&steps, &times(), |_| (), |at| push(with, at))?;
    let mut block = stepper(&slider, Method::RungeKutta)?;
    block.run(&steps, |at| push(without, at))?;
    assert!(ends[0].len() > 100);
    assert_eq!(ends[0], ends[1]);
    Ok(())
}

/// An implicit method ends steps at the times; times that go back are refused.
#[test]
fn other_methods_end_steps_there() -> Outcome {
    let slider = stick_slip(1e-6);
    let steps = Steps::adaptive(1e-4).until(10.0);
    let [mut samples, mut ends] = [Vec::new(), Vec::new()];
    let mut block = stepper(&slider, Method::Sdirk2)?;
    let asked = [0.0, 2.5, 7.0, 10.0];
    block.run_sampled(
        &steps,
        &asked,
        |at| samples.push(at.time),
        |at| ends.push(at.time),
    )?;
    assert_eq!(samples, asked);
    assert!(asked[1..].iter().all(|time| ends.contains(time)));
    let mut block = stepper(&slider, Method::RungeKutta)?;
    for wrong in [[2.0, 1.0], [-1.0, 1.0], [1.0, f64::NAN]] {
        let refused = block.run_sampled(&steps, &wrong, |_| (), |_| ());
        assert!(refused.is_err_and(|error| error.to_string().contains("time of a sample")));
    }
    Ok(())
}
