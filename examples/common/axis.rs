//! Axes of pictures, with ticks at round numbers.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;

/// An axis and its ticks.
pub(crate) struct Axis {
    range: Range<f64>,
    ticks: Vec<f64>,
    /// Digits after the point; none for an axis of logarithms.
    decimals: Option<usize>,
}

/// About so many ticks.
const TICKS: f64 = 8.0;
/// Decades below the largest value that an axis of logarithms shows.
const DECADES: f64 = 16.0;

impl Axis {
    /// A linear axis around the values, with a margin as a share of its length.
    pub(crate) fn linear(values: impl Iterator<Item = f64>, margin: f64) -> Self {
        let (low, high) = extent(values).unwrap_or((0.0, 1.0));
        let least = 1e-6 * low.abs().max(high.abs());
        let length = (high - low).max(if least > 0.0 { least } else { 1.0 });
        let range = low - margin * length..low + (1.0 + margin) * length;
        let least_step = (range.end - range.start) / TICKS;
        let decade = 10f64.powf(least_step.log10().floor());
        let round = [1.0, 2.0, 5.0].map(|share| share * decade);
        let step = round
            .into_iter()
            .find(|&step| step >= least_step)
            .unwrap_or(10.0 * decade);
        let ticks = (range.start / step).ceil() as i64..=(range.end / step).floor() as i64;
        Self {
            range,
            ticks: ticks.map(|n| n as f64 * step).collect(),
            // log10 of a power of ten may lie just below the whole number.
            decimals: Some((-(1.01 * step).log10().floor()).max(0.0) as usize),
        }
    }

    /// An axis of decimal logarithms, with ticks at whole decades.
    pub(crate) fn decades(logarithms: impl Iterator<Item = f64>) -> Self {
        let (low, high) = extent(logarithms).unwrap_or((-10.0, 0.0));
        let high = high.ceil().max(low.floor() + 1.0);
        let low = low.floor().max(high - DECADES);
        let step = ((high - low) / TICKS).ceil();
        let ticks = (0..)
            .map(|n| low + f64::from(n) * step)
            .take_while(|&tick| tick <= high);
        Self {
            range: low..high,
            ticks: ticks.collect(),
            decimals: None,
        }
    }

    /// The value at the lower end.
    pub(crate) fn low(&self) -> f64 {
        self.range.start
    }
}

fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((value.min(low), value.max(high)))
    })
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range.clone()).map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        match self.decimals {
            Some(decimals) => format!("{value:.decimals$}"),
            None => format!("1e{value:.0}"),
        }
    }
}
