//! The paper's slider by an independent implementation.

use stickslip::integrate::StepReport;
use stickslip::{Snapshot, Steps};

use super::onsets::Onsets;
use super::{STEP, Sliding, relative};
use crate::Outcome;

/// The motion of a vertex along the first axis, its state, and the cost of the step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) step: usize,
    /// [s]
    pub(crate) time: f64,
    /// [m]
    pub(crate) displacement: f64,
    /// [m/s]
    pub(crate) velocity: f64,
    pub(crate) state: f64,
    /// That of the boundary [m/s].
    pub(crate) max_slip_rate: f64,
    pub(crate) report: StepReport,
}

impl Sample {
    /// Of a vertex of the first contact.
    fn of(at: &Snapshot<'_, 2>, vertex: usize) -> Option<Self> {
        let contact = at.contact(0);
        Some(Self {
            step: at.step,
            time: at.time,
            displacement: at.displacement[vertex][0],
            velocity: at.velocity[vertex][0],
            state: contact.state(contact.position_of(vertex)?),
            max_slip_rate: at.max_slip_rate(),
            report: at.report,
        })
    }
}

/// The results of the independent implementation at `N = 1e4` for Dieterich's law and Newmark's scheme.
pub(crate) struct Reference {
    pub(crate) refinements: usize,
    /// `alpha(0.3 T)`.
    pub(crate) state: f64,
    /// `v(0.6 T)` [m/s].
    pub(crate) creep: f64,
    /// The first time of `V = 1e-4` m/s [s].
    pub(crate) first_slip: f64,
    pub(crate) first_peak: usize,
    /// `u` at 0.7, 0.9 and 1 `T` [m].
    pub(crate) displacements: [(usize, f64); 3],
    /// The largest slip rate of the boundary [m/s], five digits.
    pub(crate) peak: f64,
    /// Velocity problems a step.
    pub(crate) mean_iterations: f64,
    pub(crate) max_iterations: usize,
    /// `u(0)` [m] and its last digit.
    pub(crate) initial: (f64, f64),
    /// An upper bound for multigrid cycles a step on average.
    pub(crate) cycles: f64,
}

pub(crate) const THREE: Reference = Reference {
    refinements: 3,
    state: 1.502465049183,
    creep: 1.907600690586e-8,
    first_slip: 10.008895770,
    first_peak: 6740,
    displacements: [
        (7000, 2.3949206028e-4),
        (9000, 8.2033165544e-4),
        (10_000, 1.101330662764e-3),
    ],
    peak: 1.1371e-2,
    mean_iterations: 4.269,
    max_iterations: 18,
    initial: (-1.817828861594e-7, 1e-18),
    cycles: 14.0,
};

pub(crate) const FOUR: Reference = Reference {
    refinements: 4,
    state: 1.502465049183,
    creep: 1.8998854672e-8,
    first_slip: 10.009699449,
    first_peak: 6740,
    displacements: [
        (7000, 2.3978713526e-4),
        (9000, 8.7250322595e-4),
        (10_000, 1.162204198586e-3),
    ],
    peak: 1.2286e-2,
    mean_iterations: 4.259,
    max_iterations: 20,
    initial: (-8.036e-8, 5e-12),
    cycles: 16.0,
};

impl Reference {
    /// All steps of the slider, whose motion at `x0` is this.
    pub(crate) fn follow(&self, slider: &mut Sliding, x0: usize) -> Outcome<Vec<Sample>> {
        let mut samples = Vec::with_capacity(10_000);
        let mut slips = Onsets::new(1e-4, 1e-4);
        slips.record(0.0, 0.0);
        slider.run(&Steps::constant(STEP).count(10_000), |at| {
            slips.record(at.time, at.velocity[x0][0]);
            samples.extend(Sample::of(&at, x0));
        })?;
        let at = |step: usize| &samples[step - 1];

        assert!((at(3000).state - self.state).abs() < 1e-10);
        assert!(relative(at(6000).velocity, self.creep) < 1e-7);
        assert!((slips.times()[0] - self.first_slip).abs() < 1e-6);
        let first_peak = samples
            .windows(3)
            .find(|w| w[1].velocity > 1e-3 && w[1].velocity > w[0].velocity.max(w[2].velocity));
        assert_eq!(first_peak.map(|w| w[1].step), Some(self.first_peak));
        for (step, displacement) in self.displacements {
            let computed = at(step).displacement;
            assert!(
                relative(computed, displacement) < 1e-8,
                "u({step}) = {computed:e}, {displacement:e}"
            );
        }
        // The reference has five digits.
        let peak = samples.iter().map(|s| s.max_slip_rate).fold(0.0, f64::max);
        assert!((peak - self.peak).abs() < 0.5e-6 + 1e-6 * peak, "{peak:e}");
        Ok(samples)
    }
}
