//! The history of the slider: as many samples as tables and pictures need, and extremes over all steps.

use std::num::NonZeroUsize;

use crate::onsets::Onsets;

/// The slip rates [m/s] for the start and the end of an event.
pub(super) const EVENT: (f64, f64) = (1e-3, 1e-5);
/// The number of samples at which every second one is dropped, if their interval is not given.
const MOST: usize = 40_000;

/// A sample at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// \[s\].
    pub time: f64,
    /// \[m/s\].
    pub slip_rate: f64,
    /// The displacement since the beginning \[m\].
    pub displacement: f64,
    /// The state \[s\].
    pub theta: f64,
    /// The coefficient of friction.
    pub friction: f64,
    /// The number of local problems.
    pub solves: usize,
}

/// A history and its cost.
pub struct Record {
    pub(super) method: &'static str,
    /// The samples kept.
    pub(super) samples: Vec<Sample>,
    /// The last sample, kept or not.
    pub(super) last: Option<Sample>,
    /// The interval of the samples kept; it doubles where it is not given.
    every: usize,
    given: bool,
    /// The number of samples so far.
    pub(super) count: usize,
    /// The sum of local problems.
    pub(super) solves: usize,
    /// The least and the largest coefficient of friction.
    pub(super) friction: [f64; 2],
    /// The largest slip rate [m/s].
    pub(super) peak_slip_rate: f64,
    pub(super) events: Onsets,
    /// The coefficient of friction at a time \[s\] of interest, if a step ended there.
    pub(super) at: (f64, Option<f64>),
    /// The wall time of the run \[s\].
    pub seconds: f64,
}

impl Record {
    /// An empty record of a run with that method, of every so many-th step or of as many as are enough, that notes the
    /// friction at a time.
    pub fn new(method: &'static str, every: Option<NonZeroUsize>, time: f64) -> Self {
        Self {
            method,
            samples: Vec::new(),
            last: None,
            every: every.map_or(1, NonZeroUsize::get),
            given: every.is_some(),
            count: 0,
            solves: 0,
            friction: [f64::INFINITY, f64::NEG_INFINITY],
            peak_slip_rate: 0.0,
            events: Onsets::new(EVENT.0, EVENT.1),
            at: (time, None),
            seconds: 0.0,
        }
    }

    /// Appends a sample.
    pub fn add(&mut self, sample: Sample) {
        self.events.record(sample.time, sample.slip_rate);
        self.solves += sample.solves;
        let [least, largest] = &mut self.friction;
        (*least, *largest) = (least.min(sample.friction), largest.max(sample.friction));
        self.peak_slip_rate = self.peak_slip_rate.max(sample.slip_rate.abs());
        if (sample.time - self.at.0).abs() < 1e-9 {
            self.at.1 = Some(sample.friction);
        }
        if self.count.is_multiple_of(self.every) {
            self.samples.push(sample);
        }
        self.count += 1;
        self.last = Some(sample);
        if !self.given && self.samples.len() >= MOST {
            let mut index = 0;
            self.samples.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.every *= 2;
        }
    }

    /// The samples kept, and the last one.
    pub(super) fn kept(&self) -> impl Iterator<Item = &Sample> {
        let kept = self.samples.last().map(|sample| sample.time);
        let last = self.last.iter().filter(move |last| Some(last.time) != kept);
        self.samples.iter().chain(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(n: usize) -> Sample {
        Sample {
            time: n as f64,
            slip_rate: 1e-6,
            displacement: 0.0,
            theta: 1.0,
            friction: if n == 77_777 { 0.9 } else { 0.6 },
            solves: 1,
        }
    }

    /// Samples are bounded and evenly spaced, ends are kept, and extremes are those of all steps.
    #[test]
    fn samples_are_bounded() {
        let mut record = Record::new("", None, 5.0);
        for n in 0..1_000_001 {
            record.add(sample(n));
        }
        assert_eq!(record.count, 1_000_001);
        let times: Vec<f64> = record.kept().map(|sample| sample.time).collect();
        assert!((MOST / 2..=MOST).contains(&times.len()), "{}", times.len());
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 1e6));
        let interval = times[1];
        assert!(
            times
                .windows(2)
                .rev()
                .skip(1)
                .all(|pair| pair[1] - pair[0] == interval)
        );
        assert_eq!((record.friction, record.at.1), ([0.6, 0.9], Some(0.6)));
    }

    #[test]
    fn a_given_interval_is_obeyed() {
        let mut record = Record::new("", NonZeroUsize::new(3), 0.0);
        for n in 0..100_000 {
            record.add(sample(n));
        }
        let times: Vec<f64> = record.kept().map(|sample| sample.time).collect();
        assert_eq!(times.len(), 33_334);
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == 3.0));
    }
}
