//! Range and ticks of an axis.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

/// The largest number of decades below the largest value on a logarithmic axis.
const DECADES: f64 = 16.0;
/// The margin beside the values, as a share of the axis.
const MARGIN: f64 = 0.03;
/// The largest number of ticks.
const TICKS: usize = 9;

/// An axis: positions on it are values, or their decimal logarithms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) range: Range<f64>,
    pub(super) ticks: Vec<f64>,
    logarithmic: bool,
    decimals: usize,
}

impl Axis {
    /// An axis for these values, which lie inside it or at its ends.
    pub(super) fn new(values: impl Iterator<Item = f64>, logarithmic: bool, tight: bool) -> Self {
        let places = values.map(|value| if logarithmic { value.log10() } else { value });
        let places = places.filter(|place| place.is_finite());
        let (mut low, mut high, mut counts) = (f64::INFINITY, f64::NEG_INFINITY, !logarithmic);
        for place in places {
            (low, high) = (place.min(low), place.max(high));
            counts &= place.fract() == 0.0;
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if logarithmic {
            low = low.max(high - DECADES);
        }
        let least = (1e-6 * low.abs().max(high.abs())).max(1e-300);
        if high - low < least {
            (low, high) = (low - least, high + least);
        }
        let room = if tight { 0.0 } else { MARGIN * (high - low) };
        let range = low - room..high + room;
        // Whole numbers alone have no ticks between.
        let (ticks, decimals) = ticks(&range, logarithmic, counts);
        Self {
            range,
            ticks,
            logarithmic,
            decimals,
        }
    }

    /// The position of a value; `None` outside the axis.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        let place = if self.logarithmic {
            value.log10().max(self.range.start)
        } else {
            value
        };
        // A value too small for a logarithmic axis lies at its end; zero has the logarithm of no place.
        (place.is_finite() && !value.is_nan()).then_some(place)
    }

    /// The label of a tick.
    pub(super) fn label(&self, tick: f64) -> String {
        let large = tick.abs() >= 1e5;
        if self.logarithmic && tick.fract() == 0.0 {
            format!("1e{tick:.0}")
        } else if self.logarithmic {
            format!("{:.0e}", 10_f64.powf(tick))
        } else if large || self.decimals > 5 {
            format!("{tick:.*e}", 1)
        } else {
            format!("{tick:.*}", self.decimals)
        }
    }
}

/// The positions on an axis, with its ticks.
pub(super) struct Coordinates {
    places: RangedCoordf64,
    ticks: Vec<f64>,
}

impl Axis {
    /// For a chart.
    pub(super) fn coordinates(&self) -> Coordinates {
        Coordinates {
            places: self.range.clone().into(),
            ticks: self.ticks.clone(),
        }
    }
}

impl Ranged for Coordinates {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn range(&self) -> Range<f64> {
        self.places.range()
    }

    fn map(&self, place: &f64, limit: (i32, i32)) -> i32 {
        self.places.map(place, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // No lines between the ticks.
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }
}

/// Ticks at round numbers, and the decimals that these need.
fn ticks(range: &Range<f64>, logarithmic: bool, counts: bool) -> (Vec<f64>, usize) {
    let length = range.end - range.start;
    if logarithmic && length < 2.0 {
        let decades = range.start.floor() as i32..=range.end.ceil() as i32;
        let round =
            |decade: i32| [1.0, 2.0, 5.0].map(|digit: f64| f64::from(decade) + digit.log10());
        let places = decades.flat_map(round);
        return (places.filter(|place| range.contains(place)).collect(), 0);
    }
    let mut step = 10_f64.powf((length / TICKS as f64).log10().floor());
    let fits = |step: f64| length / step <= TICKS as f64;
    step *= [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|digit| fits(step * digit))
        .unwrap_or(10.0);
    if logarithmic || counts {
        step = step.max(1.0).round();
    }
    let first = (range.start / step).ceil() as i64;
    let last = (range.end / step).floor() as i64;
    let decimals = (-step.log10().floor()).clamp(0.0, 300.0) as usize;
    ((first..=last).map(|k| k as f64 * step).collect(), decimals)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        for (low, high) in [(0.0, 9.5), (13.5, 15.0), (-3e-4, 1.2e-3), (1e4, 1e6)] {
            let axis = Axis::new([low, high].into_iter(), false, true);
            assert!((3..=TICKS + 1).contains(&axis.ticks.len()), "{axis:?}");
            for tick in &axis.ticks {
                assert!((low..=high).contains(tick), "{axis:?}");
                let shown: f64 = axis.label(*tick).parse().unwrap_or(f64::NAN);
                assert!((shown - tick).abs() < 1e-9 * high, "{shown} {tick}");
            }
        }
    }

    #[test]
    fn counts_have_ticks_at_whole_numbers() {
        let axis = Axis::new([2.0, 3.0, 4.0].into_iter(), false, false);
        assert_eq!(axis.ticks, [2.0, 3.0, 4.0]);
    }

    #[test]
    fn decades_are_ticks() {
        let axis = Axis::new([3e-7, 0.0, 2e-2].into_iter(), true, true);
        let labels: Vec<_> = axis.ticks.iter().map(|&tick| axis.label(tick)).collect();
        assert_eq!(labels, ["1e-6", "1e-5", "1e-4", "1e-3", "1e-2"]);
        // What is less than the axis shows lies at its end.
        assert_eq!(axis.place(1e-30), Some(axis.range.start));
        assert_eq!(axis.place(f64::NAN), None);
    }

    #[test]
    fn what_is_constant_has_an_axis() {
        for value in [0.0, 5.0, -1e-9] {
            let axis = Axis::new([value].into_iter(), false, false);
            assert!(axis.range.start < value && value < axis.range.end);
        }
        assert!(!Axis::new([].into_iter(), true, false).range.is_empty());
    }
}
