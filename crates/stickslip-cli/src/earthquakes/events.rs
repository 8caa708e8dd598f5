//! Events of a fault: slip faster than a threshold anywhere on it.

use stickslip::ContactView;

use super::YEAR;
use crate::onsets::Onsets;

/// The events of a contact. One that is under way at the start begins there.
pub(super) struct Events {
    threshold: f64,
    onsets: Onsets,
    /// Slip before the event \[m\], and whether a cell was faster than the threshold in it.
    before: Vec<f64>,
    passed: Vec<bool>,
    under_way: bool,
    events: Vec<Event>,
}

/// An event.
pub(super) struct Event {
    /// The time of its onset \[s\].
    pub(super) onset: f64,
    /// The largest log10 V.
    pub(super) peak: f64,
    /// The mean slip of the cells that were faster than the threshold \[m\]; so far, for an event under way.
    pub(super) mean_slip: f64,
    /// Their number.
    pub(super) cells: usize,
}

impl Events {
    /// Events from a slip rate of `threshold` [m/s] until a tenth of it.
    pub(super) fn new(threshold: f64, cells: usize) -> Self {
        Self {
            threshold,
            onsets: Onsets::new(threshold, 0.1 * threshold),
            before: vec![0.0; cells],
            passed: vec![false; cells],
            under_way: false,
            events: Vec::new(),
        }
    }

    /// Records a step, and returns whether an event is under way.
    pub(super) fn record<const C: usize>(
        &mut self,
        time: f64,
        contact: &ContactView<'_, C>,
    ) -> bool {
        let largest = contact.max_slip_rate();
        self.onsets.record(time, largest);
        if !self.under_way && largest >= self.threshold {
            self.under_way = true;
            self.passed.fill(false);
            let onset = self.onsets.times().last().copied();
            let known = self
                .events
                .last()
                .map_or(f64::NEG_INFINITY, |event| event.onset);
            self.events.push(Event {
                onset: onset.filter(|&onset| onset > known).unwrap_or(time),
                peak: f64::NEG_INFINITY,
                mean_slip: 0.0,
                cells: 0,
            });
        }
        let Some(event) = self.events.last_mut().filter(|_| self.under_way) else {
            for (k, slip) in self.before.iter_mut().enumerate() {
                *slip = contact.slip(k);
            }
            return false;
        };
        event.peak = event.peak.max(largest.log10());
        (event.mean_slip, event.cells) = (0.0, 0);
        for (k, (passed, before)) in self.passed.iter_mut().zip(&self.before).enumerate() {
            *passed |= contact.slip_rate(k) >= self.threshold;
            if *passed {
                event.mean_slip += contact.slip(k) - before;
                event.cells += 1;
            }
        }
        event.mean_slip /= event.cells as f64;
        self.under_way = largest >= 0.1 * self.threshold;
        true
    }

    /// All events so far, in their order.
    pub(super) fn all(&self) -> &[Event] {
        &self.events
    }

    /// A property of each event.
    pub(super) fn each(&self, value: impl Fn(&Event) -> f64) -> Vec<f64> {
        self.events.iter().map(value).collect()
    }

    /// Their onsets \[years\].
    pub(super) fn years(&self) -> Vec<f64> {
        self.each(|event| event.onset / YEAR)
    }
}
