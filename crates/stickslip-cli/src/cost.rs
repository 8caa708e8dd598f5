//! The cost of the steps of a run.

use stickslip::Snapshot;

/// Cost of the steps of a run, in all and in the worst step, and the peak slip rate of the contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Statistics {
    /// The number of recorded steps.
    pub steps: usize,
    /// The number of velocity problems.
    pub velocity_problems: Total,
    /// The number of iterations of the velocity solver.
    pub solver_iterations: Total,
    /// The number of steps in which the coupling fell back on another.
    pub fallbacks: usize,
    /// The number of steps with slip-rate weakening at their end, including the response of the state.
    pub weakening: usize,
    /// The largest slip rate of all contacts [m/s].
    pub peak_slip_rate: f64,
}

/// A count over steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Total {
    /// The sum over all steps.
    pub sum: usize,
    /// The largest count of a step.
    pub most: usize,
}

impl Statistics {
    /// Adds the step of a snapshot.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        self.steps += 1;
        self.velocity_problems.add(at.report.coupling_iterations);
        self.solver_iterations.add(at.report.solver_iterations);
        self.fallbacks += usize::from(at.report.fell_back);
        self.weakening += usize::from(at.report.weakening_nodes > 0);
        self.peak_slip_rate = self.peak_slip_rate.max(at.max_slip_rate());
    }

    /// The mean of a count per step; zero before the first one.
    pub fn per_step(&self, total: Total) -> f64 {
        total.sum as f64 / self.steps.max(1) as f64
    }
}

impl Total {
    fn add(&mut self, count: usize) {
        self.sum += count;
        self.most = self.most.max(count);
    }
}
