//! What the steps of a run cost.

use stickslip::Snapshot;

/// What the steps of a run cost, in all and in the worst step, and how fast the contacts slid.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Statistics {
    /// Steps recorded.
    pub steps: usize,
    /// Velocity problems solved.
    pub velocity_problems: Total,
    /// Iterations of the velocity solver.
    pub solver_iterations: Total,
    /// Steps in which the coupling gave up and fell back on another.
    pub fallbacks: usize,
    /// Steps at whose end friction weakens with the slip rate somewhere, its state following.
    pub weakening: usize,
    /// The largest slip rate of all contacts [m/s].
    pub peak_slip_rate: f64,
}

/// A count over steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Total {
    /// In all steps.
    pub sum: usize,
    /// In the worst step.
    pub most: usize,
}

impl Statistics {
    /// Counts the step shown.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        self.steps += 1;
        self.velocity_problems.add(at.report.coupling_iterations);
        self.solver_iterations.add(at.report.solver_iterations);
        self.fallbacks += usize::from(at.report.fell_back);
        self.weakening += usize::from(at.report.weakening_nodes > 0);
        self.peak_slip_rate = self.peak_slip_rate.max(at.max_slip_rate());
    }

    /// The mean of a count over the steps; zero before the first one.
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
