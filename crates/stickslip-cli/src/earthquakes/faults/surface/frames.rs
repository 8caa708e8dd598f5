//! Slip rates in the course of events, and the slip of each event.

use stickslip::ContactView;

/// The largest number of frames of an event.
const MOST: usize = 32;

/// The slip of an event.
pub(super) struct EventSlip {
    /// The time of its first step \[s\].
    pub(super) time: f64,
    /// The slip of each cell in it \[m\], so far.
    pub(super) slip: Vec<f64>,
}

/// A time since the first step of an event \[s\], and the slip rate of each cell [m/s].
pub(super) type Frame = (f64, Vec<f64>);

/// The slip of all events, and frames of the one with the largest slip in all cells.
pub(super) struct Frames {
    threshold: f64,
    under_way: bool,
    /// Slip before the event.
    before: Vec<f64>,
    events: Vec<EventSlip>,
    taken: Vec<Frame>,
    /// Every so many steps, and steps since the last frame.
    every: usize,
    since: usize,
    /// The number of the event that is kept, and its frames.
    kept: Option<(usize, Vec<Frame>)>,
}

impl Frames {
    /// Of events from a slip rate [m/s] on until a tenth of it.
    pub(super) fn new(threshold: f64, cells: usize) -> Self {
        Self {
            threshold,
            under_way: false,
            before: vec![0.0; cells],
            events: Vec::new(),
            taken: Vec::new(),
            every: 1,
            since: 0,
            kept: None,
        }
    }

    /// Records a step.
    pub(super) fn record(&mut self, time: f64, contact: &ContactView<'_, 1>) {
        let largest = contact.max_slip_rate();
        if !self.under_way && largest >= self.threshold {
            self.under_way = true;
            self.taken.clear();
            (self.every, self.since) = (1, 0);
            let slip = vec![0.0; self.before.len()];
            self.events.push(EventSlip { time, slip });
        }
        let Some(event) = self.events.last_mut().filter(|_| self.under_way) else {
            for (k, slip) in self.before.iter_mut().enumerate() {
                *slip = contact.slip(k);
            }
            return;
        };
        for (k, (slip, before)) in event.slip.iter_mut().zip(&self.before).enumerate() {
            *slip = contact.slip(k) - before;
        }
        if self.since == 0 {
            let rates = (0..contact.len()).map(|k| contact.slip_rate(k));
            self.taken.push((time - event.time, rates.collect()));
        }
        self.since = (self.since + 1) % self.every;
        if self.taken.len() == MOST {
            // Every other one, evenly over steps.
            let mut n = 0;
            self.taken.retain(|_| {
                n += 1;
                n % 2 == 1
            });
            self.every *= 2;
            self.since = (self.every / 2 + 1) % self.every;
        }
        self.under_way = largest >= 0.1 * self.threshold;
        if !self.under_way {
            self.keep();
        }
    }

    /// Keeps the frames of the last event, if it is the largest one so far.
    fn keep(&mut self) {
        let size = |n: usize| self.events[n].slip.iter().sum::<f64>();
        let last = self.events.len() - 1;
        if self
            .kept
            .as_ref()
            .is_none_or(|(n, _)| size(last) > size(*n))
        {
            self.kept = Some((last, std::mem::take(&mut self.taken)));
        }
    }

    /// The events, and the frames of the largest one with its time.
    pub(super) fn finish(mut self) -> (Vec<EventSlip>, Option<(f64, Vec<Frame>)>) {
        if self.under_way {
            self.keep();
        }
        let frames = self.kept.map(|(n, frames)| (self.events[n].time, frames));
        (self.events, frames)
    }
}
