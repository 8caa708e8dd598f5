//! A step at one vertex.

use stickslip::Snapshot;
use stickslip::integrate::StepReport;

/// One frictional vertex after a step, with the cost of the step: a row of `history.csv` and a point of its pictures.
/// [`PointHistories`](stickslip::record::PointHistories) has neither costs nor the largest slip rate.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Sample {
    /// The step's number.
    pub step: usize,
    /// Its time \[s\].
    pub time: f64,
    /// The first component of the displacement \[m\].
    pub displacement: f64,
    /// The first component of the velocity [m/s].
    pub velocity: f64,
    /// The state, in the state law's own variable; zero for a scene without one.
    pub state: f64,
    /// The largest slip rate on the frictional boundary [m/s].
    pub max_slip_rate: f64,
    /// The cost of the step.
    pub report: StepReport,
}

impl Sample {
    /// The sample of a vertex.
    ///
    /// # Panics
    /// For a vertex that the body does not have.
    pub fn of<const C: usize>(at: &Snapshot<'_, C>, vertex: usize) -> Self {
        let states = at.contacts().find_map(|contact| {
            let k = contact.position_of(vertex)?;
            Some(contact.state(k))
        });
        Self {
            step: at.step,
            time: at.time,
            displacement: at.displacement[vertex][0],
            velocity: at.velocity[vertex][0],
            state: states.unwrap_or(0.0),
            max_slip_rate: at.max_slip_rate(),
            report: at.report,
        }
    }
}
