//! The ends and sizes of steps, and the state after a step that is taken back.

use stickslip::integrate::StopReason;
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::{ErrorControl, Run, Snapshot, Steps};

use super::{Method, stepper, stick_slip};
use crate::Outcome;

/// All numbers as bits.
fn bits(at: &Snapshot<'_, 1>) -> [u64; 5] {
    [
        at.time,
        at.step as f64,
        at.displacement[0][0],
        at.velocity[0][0],
        at.contact(0).state(0),
    ]
    .map(f64::to_bits)
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
            let adaptive = Steps::adaptive(1e-5)
                .with_error_control(control)
                .stopping_at(stops.iter().copied())
                // Behind and beyond the run.
                .stopping_at([-1.0, 0.0, 1e9])
                .until(until);
            let report = block.run(&adaptive, |at| times.push(at.time))?;
            assert_eq!(report.ended, StopReason::Time);
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
            assert_eq!(block.run(&adaptive, |_| ())?.accepted, 0);
            assert_eq!(block.snapshot().time, until);
            block.run(&adaptive.until(until + 1.0), |_| ())?;
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

/// Between two steps lies a power of two, except where the end cuts.
#[test]
fn quantised_steps_differ_by_powers_of_two() -> Outcome {
    let mut block = stepper(&stick_slip(1e-6), Method::Newmark)?;
    let first = 0.125;
    let mut times = vec![0.0];
    let quantised = Steps::adaptive(1e-4)
        .with_first_step(first)
        .in_powers_of_two();
    let report = block.run(&quantised.until(900.0), |at| times.push(at.time))?;
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
