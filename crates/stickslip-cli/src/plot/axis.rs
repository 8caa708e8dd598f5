//! Range and ticks of an axis.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

use super::label::{MINUS, raised, rounded, scientific};
use super::ticks::{logarithmic_ticks, multiples, step};

/// The largest number of decades below the largest value on a logarithmic axis.
const DECADES: f64 = 16.0;
/// The margin beside the values, as a share of the axis.
const MARGIN: f64 = 0.03;
/// The share of the axis by which it is longer than its values, to end at a tick.
const SHORT: f64 = 0.02;

/// An axis: positions on it are values, or their decimal logarithms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) range: Range<f64>,
    pub(super) ticks: Vec<f64>,
    logarithmic: bool,
    decimals: usize,
    /// Whether labels grow downwards, as those of a depth.
    downward: bool,
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
        let mut range = low - room..high + room;
        // Whole numbers alone have no ticks between.
        let step = step(&range, logarithmic, counts);
        if !logarithmic {
            let reach = SHORT * (range.end - range.start);
            let outer = (
                (range.start / step).floor() * step,
                (range.end / step).ceil() * step,
            );
            if range.start - outer.0 <= reach {
                range.start = outer.0;
            }
            if outer.1 - range.end <= reach {
                range.end = outer.1;
            }
        }
        let ticks = if logarithmic {
            logarithmic_ticks(&range, step)
        } else {
            multiples(&range, step)
        };
        Self {
            range,
            ticks,
            logarithmic,
            decimals: (-step.log10().floor()).clamp(0.0, 300.0) as usize,
            downward: false,
        }
    }

    /// The axis of a depth, whose values are its negatives: labels are positive and grow downwards.
    pub(super) fn downward(mut self, downward: bool) -> Self {
        self.downward = downward;
        self
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

    /// The label of a tick: with a minus of its own, and powers of ten as such.
    pub(super) fn label(&self, tick: f64) -> String {
        let tick = if self.downward { -tick } else { tick };
        // No signed zero.
        let tick = tick + 0.0;
        let large = tick.abs() >= 1e5;
        if self.logarithmic && self.ticks.iter().all(|tick| tick.fract() == 0.0) {
            format!("10{}", raised(tick as i32))
        } else if self.logarithmic {
            rounded(10_f64.powf(tick))
        } else if large || self.decimals > 5 {
            scientific(tick, 1)
        } else {
            format!("{tick:.*}", self.decimals).replace('-', MINUS)
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

#[cfg(test)]
mod tests {
    use super::super::ticks::TICKS;
    use super::*;

    /// The number of a label.
    fn read(label: &str) -> f64 {
        let is_digit = |c: char| c.is_ascii_digit() || c == '.';
        let power = label
            .strip_prefix("10")
            .filter(|rest| !rest.is_empty() && !rest.contains(is_digit));
        let factors = power.map(|power| ("1", power)).or(label.split_once("·10"));
        let (mantissa, exponent) = factors.unwrap_or((label, ""));
        let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|other| other == c);
        let exponent: String = exponent
            .chars()
            .map(|c| digit(c).map_or("-".into(), |digit| digit.to_string()))
            .collect();
        let mantissa = mantissa.replace(MINUS, "-");
        let exponent = if exponent.is_empty() { "0" } else { &exponent };
        format!("{mantissa}e{exponent}").parse().unwrap_or(f64::NAN)
    }

    /// However narrow its range, a logarithmic axis has three ticks, which read as their values.
    #[test]
    fn logarithmic_axes_have_three_ticks() {
        for (low, high) in [
            (0.3, 1.4),
            (1e-3, 2e-3),
            (6.1e-5, 7.3e-5),
            (0.3, 80.0),
            (990.0, 1010.0),
        ] {
            let axis = Axis::new([low, high].into_iter(), true, true);
            assert!((3..=TICKS + 2).contains(&axis.ticks.len()), "{axis:?}");
            for &tick in &axis.ticks {
                let (shown, value) = (read(&axis.label(tick)), 10_f64.powf(tick));
                assert!((shown / value - 1.0).abs() < 6e-3, "{shown} {value}");
            }
        }
    }

    #[test]
    fn an_axis_that_begins_just_above_zero_has_zero() {
        let axis = Axis::new([1.5e-3, 15.0].into_iter(), false, true);
        assert_eq!((axis.range.start, axis.ticks[0]), (0.0, 0.0));
    }

    #[test]
    fn depths_are_positive_downwards() {
        let axis = Axis::new([-24.0, 0.0].into_iter(), false, true).downward(true);
        let labels: Vec<_> = axis.ticks.iter().map(|&tick| axis.label(tick)).collect();
        assert_eq!(labels, ["20", "15", "10", "5", "0"]);
        let axis = Axis::new([-2.0, 0.0].into_iter(), false, true);
        assert_eq!(axis.label(axis.ticks[0]), "\u{2212}2");
    }

    #[test]
    fn ticks_are_round_and_few() {
        for (low, high) in [(0.0, 9.5), (13.5, 15.0), (-3e-4, 1.2e-3), (1e4, 1e6)] {
            let axis = Axis::new([low, high].into_iter(), false, true);
            assert!((3..=TICKS + 1).contains(&axis.ticks.len()), "{axis:?}");
            for tick in &axis.ticks {
                let shown = read(&axis.label(*tick));
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
        assert_eq!(labels, ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"]);
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
