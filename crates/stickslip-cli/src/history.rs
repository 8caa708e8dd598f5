//! The history of one vertex, kept in memory.

use stickslip::Snapshot;
use stickslip::integrate::StepReport;

/// A sample of one frictional vertex after one step.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
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
    /// The cost of the step.
    pub report: StepReport,
}

/// The history of one component of one frictional vertex in memory, which grows with the samples.
/// [`PointHistories`](stickslip::record::PointHistories) writes to a file instead.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct History {
    vertex: usize,
    component: usize,
    samples: Vec<Sample>,
}

impl History {
    /// A history of `component` of `vertex`, with room for `steps` samples before the next allocation.
    pub fn new(vertex: usize, component: usize, steps: usize) -> Self {
        Self {
            vertex,
            component,
            samples: Vec::with_capacity(steps),
        }
    }

    /// Adds a sample of a step and returns it.
    ///
    /// # Panics
    /// For a step of a smaller body than it was made for.
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
