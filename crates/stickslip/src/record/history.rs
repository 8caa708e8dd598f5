//! Recorders: values that the loop's closure feeds.

use crate::{Snapshot, StepReport};

/// What is known of one frictional vertex after one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The step's number.
    pub step: usize,
    /// Its time \[s\].
    pub time: f64,
    /// The recorded component of the displacement \[m\].
    pub displacement: f64,
    /// The recorded component of the velocity [m/s].
    pub velocity: f64,
    /// The state, in the state law's own variable; zero for a scene without one.
    pub state: f64,
    /// The largest slip rate on the frictional boundary [m/s].
    pub max_slip_rate: f64,
    /// What the step cost.
    pub report: StepReport,
}

/// The history of one component of one frictional vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    vertex: usize,
    component: usize,
    samples: Vec<Sample>,
}

impl History {
    /// Records `component` of `vertex`, with room for `steps` samples before memory is taken again.
    pub fn new(vertex: usize, component: usize, steps: usize) -> Self {
        Self {
            vertex,
            component,
            samples: Vec::with_capacity(steps),
        }
    }

    /// Takes a sample of the step shown and returns it.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> Sample {
        let states = at.contacts().find_map(|contact| {
            let k = contact.position_of(self.vertex)?;
            Some(contact.state(k))
        });
        let sample = Sample {
            step: at.step,
            time: at.time,
            displacement: at.displacement[self.vertex][self.component],
            velocity: at.velocity[self.vertex][self.component],
            state: states.unwrap_or(0.0),
            max_slip_rate: at.max_slip_rate(),
            report: at.report,
        };
        self.samples.push(sample);
        sample
    }

    /// The samples so far, in order.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }
}

/// Finds the times at which a slip rate rises through a threshold.
///
/// Between two samples the logarithm of the rate is taken as linear. After an event, the next one
/// is looked for once the rate has been below `rearm`: ringing after an event is not another event.
#[derive(Debug, Clone, PartialEq)]
pub struct Events {
    threshold: f64,
    rearm: f64,
    armed: bool,
    last: Option<(f64, f64)>,
    times: Vec<f64>,
}

impl Events {
    /// Events at `threshold` [m/s], told apart by a rate below `rearm` [m/s] between them.
    pub fn new(threshold: f64, rearm: f64) -> Self {
        Self {
            threshold,
            rearm,
            armed: true,
            last: None,
            times: Vec::with_capacity(64),
        }
    }

    /// Takes the slip rate [m/s] at a time \[s\].
    pub fn record(&mut self, time: f64, slip_rate: f64) {
        let rate = slip_rate.abs();
        if let Some((last_time, last_rate)) = self.last
            && self.armed
            && last_rate < self.threshold
            && rate >= self.threshold
        {
            let rise = rate.ln() - last_rate.ln();
            let share = (self.threshold.ln() - last_rate.ln()) / rise;
            // A rate of exactly zero before the jump leaves nothing to interpolate.
            let share = if share.is_finite() { share } else { 1.0 };
            self.times.push(last_time + share * (time - last_time));
            self.armed = false;
        }
        if rate < self.rearm {
            self.armed = true;
        }
        self.last = Some((time, rate));
    }

    /// The times found so far \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }
}
