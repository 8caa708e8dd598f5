//! Places of ticks on an axis.

use std::ops::Range;

/// The largest number of ticks.
pub(super) const TICKS: usize = 9;

/// A round distance of ticks.
pub(super) fn step(range: &Range<f64>, logarithmic: bool, counts: bool) -> f64 {
    let length = range.end - range.start;
    let mut step = 10_f64.powf((length / TICKS as f64).log10().floor());
    let fits = |step: f64| length / step <= TICKS as f64;
    step *= [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|digit| fits(step * digit))
        .unwrap_or(10.0);
    if logarithmic || counts {
        step = step.max(1.0).round();
    }
    step
}

/// Ticks at multiples of a step.
pub(super) fn multiples(range: &Range<f64>, step: f64) -> Vec<f64> {
    // Ticks at the ends of the axis belong to it, be they rounded.
    let slack = 1e-9;
    let first = (range.start / step - slack).ceil() as i64;
    let last = (range.end / step + slack).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// At least three ticks on a logarithmic axis: at powers of ten, at round numbers where these are few, or else at multiples
/// of a step.
pub(super) fn logarithmic_ticks(range: &Range<f64>, step_of_powers: f64) -> Vec<f64> {
    const LEAST: usize = 3;
    let powers = multiples(range, step_of_powers);
    if powers.len() >= LEAST {
        return powers;
    }
    let decades = range.start.floor() as i32..=range.end.ceil() as i32;
    let round = |decade: i32| [1.0, 2.0, 5.0].map(|digit: f64| f64::from(decade) + digit.log10());
    let places = decades.flat_map(round);
    let places: Vec<f64> = places.filter(|place| range.contains(place)).collect();
    if places.len() >= LEAST {
        return places;
    }
    let values = 10_f64.powf(range.start)..10_f64.powf(range.end);
    let values = multiples(&values, step(&values, false, false));
    values.into_iter().map(f64::log10).collect()
}
