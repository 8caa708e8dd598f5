//! How far a run is, and what it reports.

use super::steps::{Constant, StepSize};
use super::{RunReport, Steps, StopReason};
use crate::Snapshot;
use crate::numerics::NUMERICS;

/// The progress of a run.
pub(super) struct Progress<'a> {
    pub(super) steps: &'a Steps,
    /// The time at which the run began \[s\].
    pub(super) begun: f64,
    /// The first stop ahead.
    pub(super) stop: usize,
    pub(super) report: RunReport,
}

impl<'a> Progress<'a> {
    pub(super) fn new(steps: &'a Steps, begun: f64) -> Self {
        Self {
            steps,
            begun,
            stop: 0,
            report: RunReport {
                ended: StopReason::Time,
                accepted: 0,
                rejected: 0,
                failed: 0,
                substepped: 0,
                substeps: 0,
                step_range: [f64::INFINITY, 0.0],
            },
        }
    }

    /// The duration of a run, or its order of magnitude.
    pub(super) fn span(&self, time: f64) -> f64 {
        let stop = self.steps.stops.iter().find(|&&stop| stop > time);
        match (self.steps.until, stop) {
            (Some(end), _) => end - time,
            (_, Some(stop)) => stop - time,
            _ => 1.0,
        }
    }

    /// The time to the next stop or to the end \[s\], or the reason to stop at the end.
    pub(super) fn ahead<const C: usize>(
        &mut self,
        at: &Snapshot<'_, C>,
    ) -> Result<f64, StopReason> {
        let time = at.time;
        if (self.steps.count).is_some_and(|count| self.report.accepted >= count) {
            return Err(StopReason::Count);
        }
        let reached = |stop: f64| stop <= time + f64::EPSILON * time.abs();
        while (self.steps.stops.get(self.stop)).is_some_and(|&stop| reached(stop)) {
            self.stop += 1;
        }
        let end = self.steps.until.unwrap_or(f64::INFINITY);
        let target = self
            .steps
            .stops
            .get(self.stop)
            .map_or(end, |stop| stop.min(end));
        if target.is_infinite() {
            return Ok(f64::INFINITY);
        }
        let left = at.state().clock.left(target);
        // What rounding leaves of the way to the end is none.
        let resolution = f64::EPSILON * time.abs().max(target.abs());
        let sliver = match self.steps.size {
            // Of a run that has taken no step yet nothing is left by rounding.
            StepSize::Constant(Constant { dt, .. }) => NUMERICS.slack * dt.min(time - self.begun),
            StepSize::Adaptive(_) => NUMERICS.slack * left.abs(),
        };
        if time >= end || target == end && left <= sliver.max(resolution) {
            return Err(StopReason::Time);
        }
        Ok(left)
    }

    pub(super) fn accept(&mut self, taken: f64) {
        self.report.accepted += 1;
        let [smallest, largest] = self.report.step_range;
        self.report.step_range = [smallest.min(taken), largest.max(taken)];
    }

    pub(super) fn finish(mut self, ended: StopReason) -> RunReport {
        self.report.ended = ended;
        self.report
    }
}
