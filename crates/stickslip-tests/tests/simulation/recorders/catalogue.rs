//! The catalogue of events against the steps it is made of.

use crate::common::onsets::Onsets;
use stickslip::record::EventCatalogue;
use stickslip::{SceneError, Steps};

use crate::Outcome;
use crate::common::{STEP, Solver, body, paper_slider, relative};

const THRESHOLD: f64 = 1e-3;
const END: f64 = 1e-4;
const SHEAR_MODULUS: f64 = 2e7;

/// The bottom of the slider after a step.
struct Shown {
    time: f64,
    rates: Vec<f64>,
    slips: Vec<f64>,
    tractions: Vec<f64>,
}

/// Every number of the first event, from all steps afterwards.
#[test]
fn the_first_event_of_the_slider() -> Outcome {
    let body = body(3);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, Solver::Condensed, 1e-12)?;
    let rates = [THRESHOLD, END];
    let mut catalogue = EventCatalogue::new(&slider.snapshot(), 0, rates, SHEAR_MODULUS, 8)?;
    let mut onsets = Onsets::new(THRESHOLD, END);
    let mut shown: Vec<Shown> = Vec::new();
    slider.run(&Steps::constant(STEP).count(6400), |_| ())?;
    slider.run(&Steps::constant(STEP).count(700), |at| {
        let contact = at.contact(0);
        catalogue.record(&at);
        onsets.record(at.time, at.max_slip_rate());
        let of = |value: &dyn Fn(usize) -> f64| (0..contact.len()).map(value).collect();
        shown.push(Shown {
            time: at.time,
            rates: of(&|k| contact.slip_rate(k)),
            slips: of(&|k| contact.slip(k)),
            tractions: of(&|k| contact.traction(k)[0]),
        });
    })?;
    let event = catalogue.events().first().ok_or("no event")?;
    assert_eq!(onsets.times().first(), Some(&event.onset));

    let largest = |at: &Shown| at.rates.iter().copied().fold(0.0, f64::max);
    let begin = shown.iter().position(|at| largest(at) >= THRESHOLD);
    let begin = begin.ok_or("no event")?;
    let end = shown[begin..].iter().position(|at| largest(at) < END);
    let end = begin + end.ok_or("no end")?;
    let (before, after) = (&shown[begin - 1], &shown[end]);
    assert!(before.time < event.onset && event.onset <= shown[begin].time);
    assert!(shown[end - 1].time < event.arrest && event.arrest <= after.time);
    let peak = shown[begin..end]
        .iter()
        .max_by(|a, b| largest(a).total_cmp(&largest(b)));
    let peak = peak.ok_or("no peak")?;
    assert_eq!(
        (event.peak_slip_rate, event.peak_time),
        (largest(peak), peak.time)
    );
    let contact = slider.snapshot().contact(0);
    let place = contact
        .position_of(event.peak_vertex)
        .ok_or("not of the contact")?;
    assert_eq!(peak.rates[place], event.peak_slip_rate);
    let origin = contact
        .position_of(event.origin)
        .ok_or("not of the contact")?;
    assert!(before.rates[origin] < THRESHOLD && shown[begin].rates[origin] >= THRESHOLD);

    let count = contact.len();
    let passed = |k: &usize| shown[begin..end].iter().any(|at| at.rates[*k] >= THRESHOLD);
    let extent: Vec<usize> = (0..count).filter(passed).collect();
    let slip = |k: usize| after.slips[k] - before.slips[k];
    let sum = |of: &dyn Fn(usize) -> f64, over: &[usize]| -> f64 {
        over.iter().map(|&k| contact.weight(k) * of(k)).sum()
    };
    let all: Vec<usize> = (0..count).collect();
    let area = sum(&|_| 1.0, &extent);
    let place = |k: usize| contact.point(k)[0];
    let low = extent
        .iter()
        .map(|&k| place(k))
        .fold(f64::INFINITY, f64::min);
    let high = extent
        .iter()
        .map(|&k| place(k))
        .fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(event.vertices, extent.len());
    assert_eq!((event.low[0], event.high[0]), (low, high));
    let close = |a: f64, b: f64| assert!(relative(a, b) < 1e-12, "{a:e}, {b:e}");
    close(event.area, area);
    close(event.mean_slip, sum(&slip, &extent) / area);
    close(event.moment, SHEAR_MODULUS * sum(&slip, &extent));
    close(
        event.largest_slip,
        all.iter().map(|&k| slip(k)).fold(0.0, f64::max),
    );
    let drop = |k: usize| before.tractions[k] - after.tractions[k];
    assert!((event.stress_drop - sum(&drop, &extent) / area).abs() < 1e-9);
    let mean = |k: usize| 0.5 * (before.tractions[k] + after.tractions[k]) * slip(k);
    close(event.released, sum(&mean, &all));
    let work: f64 = shown[begin - 1..=end]
        .windows(2)
        .map(|pair| {
            let [a, b] = [&pair[0], &pair[1]];
            let work = |k: usize| {
                0.5 * (a.tractions[k].abs() + b.tractions[k].abs()) * (b.slips[k] - a.slips[k])
            };
            sum(&work, &all)
        })
        .sum();
    close(event.friction_work, work);
    assert!(event.friction_work > 0.0 && event.stress_drop > 0.0);
    Ok(())
}

/// Rates and moduli out of range, and contacts that are none.
#[test]
fn settings_out_of_range_are_refused() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    let slider = paper_slider(&body, &space, Solver::Condensed, 1e-10)?;
    let at = slider.snapshot();
    for (contact, rates, modulus) in [
        (0, [0.0, 0.0], 1.0),
        (0, [1e-3, 2e-3], 1.0),
        (0, [1e-3, f64::NAN], 1.0),
        (0, [1e-3, 1e-4], -1.0),
        (1, [1e-3, 1e-4], 1.0),
    ] {
        let refused = EventCatalogue::new(&at, contact, rates, modulus, 0).err();
        let named = matches!(
            (contact, &refused),
            (0, Some(SceneError::Value { .. }))
                | (
                    1,
                    Some(SceneError::Index {
                        what: "contact",
                        index: 1,
                        count: 1
                    })
                )
        );
        assert!(named, "{refused:?}");
    }
    Ok(())
}
