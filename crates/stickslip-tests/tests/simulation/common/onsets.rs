//! The times at which a slip rate rises through a threshold: that of one vertex, or of an exact solution. A catalogue has
//! the events of a whole contact.

/// Finds the times at which a slip rate rises through a threshold.
///
/// Between two samples the logarithm of the rate is taken as linear. After an event, the next one
/// is looked for once the rate has been below `rearm`: ringing after an event is not another event.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Onsets {
    threshold: f64,
    rearm: f64,
    armed: bool,
    last: Option<(f64, f64)>,
    times: Vec<f64>,
}

impl Onsets {
    /// Events at `threshold` [m/s], told apart by a rate below `rearm` [m/s] between them.
    pub(crate) fn new(threshold: f64, rearm: f64) -> Self {
        Self {
            threshold,
            rearm,
            armed: true,
            last: None,
            times: Vec::with_capacity(64),
        }
    }

    /// Takes the slip rate [m/s] at a time \[s\].
    pub(crate) fn record(&mut self, time: f64, slip_rate: f64) {
        let rate = slip_rate.abs();
        if let Some((last_time, last_rate)) = self.last
            && self.armed
            && last_rate < self.threshold
            && rate >= self.threshold
        {
            let (from, to) = ((last_time, last_rate), (time, rate));
            self.times.push(time_of(self.threshold, from, to));
            self.armed = false;
        }
        if rate < self.rearm {
            self.armed = true;
        }
        self.last = Some((time, rate));
    }

    /// The times found so far \[s\].
    pub(crate) fn times(&self) -> &[f64] {
        &self.times
    }
}

/// The time at which a rate that goes from `from` to `to`, each a time and a rate, passes `level`: its logarithm
/// is taken as linear. A rate of zero at either end leaves nothing to interpolate, and the later time is taken.
fn time_of(level: f64, from: (f64, f64), to: (f64, f64)) -> f64 {
    let share = if from.1 > 0.0 && to.1 > 0.0 {
        (level.ln() - from.1.ln()) / (to.1.ln() - from.1.ln())
    } else {
        1.0
    };
    let share = if share.is_finite() { share } else { 1.0 };
    from.0 + share * (to.0 - from.0)
}
