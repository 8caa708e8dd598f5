//! Whether a run gets anywhere: how far the last steps led, and what limited them.

use super::controller::Controller;
use super::limit::{Limit, LocalError};
use crate::StepError;

/// Blocks of steps that are looked back on, and those that make up the steps allowed.
const BLOCKS: usize = 10;
const IN_ALL: usize = 1000;
/// The smallest block; fewer steps say nothing.
const SMALLEST: usize = 500;
/// A step that fails ends a block as so many others would: a solver that gives up has done all the work it may.
const FAILED: usize = 20;
/// The steps that may fail in all, and as a share of those allowed.
const FAILURES: usize = 200;
const FAILURES_IN_ALL: usize = 40;
/// The largest ratio of the ways of two blocks in which the step size has not changed.
const STEADY: f64 = 4.0;

/// The way of each of the last blocks, and what has happened in the present one. A step that is taken back or fails is
/// one that leads nowhere.
///
/// The step size of an event varies by decades, and a run that goes from event to event covers whole cycles with a
/// block, or spends blocks without an event. So a run in which all of [`BLOCKS`] blocks led equally far goes on like
/// that, unless there is a trend, or steps have grown again before. The way that lies ahead with a trend that goes on
/// linearly is
///
/// ```text
/// n w + n^2 g / 2,    n the blocks left of those allowed,   g >= 0 the growth a block,
///                     w the longest way of a block, of all that came after much shorter ones
/// ```
///
/// A run that ends within the steps of [`BLOCKS`] blocks is never given up; steps that fail make blocks shorter.
pub(super) struct Pace {
    max_steps: usize,
    block: usize,
    /// The ways of the last blocks \[s\], the present one last, and how many have begun.
    ways: [f64; BLOCKS],
    begun: usize,
    /// The shortest way of a block of all, and the longest one after a block that was shorter by more than [`STEADY`].
    shortest: f64,
    recovered: f64,
    /// The steps of each of these blocks, and those of the present one that failed.
    taken: [usize; BLOCKS],
    failed: usize,
    /// The largest error in the present block, and the last failure.
    error: LocalError,
    failure: Option<StepError>,
}

/// A run that does not get to its end.
pub(super) struct Hopeless {
    /// The average step of the last blocks \[s\].
    pub(super) dt: f64,
    /// The steps that the rest would need.
    pub(super) needed: f64,
}

impl Pace {
    pub(super) fn new(max_steps: usize) -> Self {
        Self {
            max_steps,
            block: (max_steps / IN_ALL).max(SMALLEST),
            ways: [0.0; BLOCKS],
            begun: 1,
            shortest: f64::INFINITY,
            recovered: 0.0,
            taken: [0; BLOCKS],
            failed: 0,
            error: LocalError::default(),
            failure: None,
        }
    }

    /// Counts a step that led as far as `way` \[s\], 0 if it was taken back.
    pub(super) fn step(&mut self, way: f64, error: LocalError) {
        if self.taken[BLOCKS - 1] == 0 || error.largest() > self.error.largest() {
            self.error = error;
        }
        self.taken[BLOCKS - 1] += 1;
        self.ways[BLOCKS - 1] += way;
    }

    /// Counts a step that failed.
    pub(super) fn fail(&mut self, cause: StepError) {
        self.taken[BLOCKS - 1] += 1;
        self.failed += 1;
        self.failure = Some(cause);
    }

    /// At the end of a block: whether the time `left` \[s\] needs more steps than are allowed, so many of which were
    /// taken before.
    pub(super) fn judge(&mut self, steps: usize, left: f64) -> Option<Hopeless> {
        if self.taken[BLOCKS - 1] + (FAILED - 1) * self.failed < self.block {
            return None;
        }
        let way = self.ways[BLOCKS - 1];
        if way > STEADY * self.shortest {
            self.recovered = self.recovered.max(way);
        }
        self.shortest = self.shortest.min(way);
        let hopeless = (self.begun >= BLOCKS)
            .then(|| self.look_ahead(steps, left))
            .flatten();
        if hopeless.is_none() {
            self.ways.rotate_left(1);
            self.ways[BLOCKS - 1] = 0.0;
            self.begun += 1;
            self.taken.rotate_left(1);
            (self.taken[BLOCKS - 1], self.failed) = (0, 0);
        }
        hopeless
    }

    fn look_ahead(&self, steps: usize, left: f64) -> Option<Hopeless> {
        let fold = |choose: fn(f64, f64) -> f64| self.ways.into_iter().reduce(choose);
        let (shortest, longest) = (fold(f64::min)?, fold(f64::max)?);
        if longest > STEADY * shortest {
            return None;
        }
        let all = self.taken.iter().sum::<usize>() as f64;
        let block = all / BLOCKS as f64;
        let (first, last) = self.ways.split_at(BLOCKS / 2);
        let sum = |ways: &[f64]| ways.iter().sum::<f64>();
        let half = (BLOCKS / 2) as f64;
        let growth = ((sum(last) - sum(first)) / (half * half)).max(0.0);
        let blocks = self.max_steps.saturating_sub(steps) as f64 / block;
        let reach = blocks * longest.max(self.recovered) + 0.5 * growth * blocks * blocks;
        let dt = sum(&self.ways) / all;
        (left > reach).then(|| Hopeless {
            dt,
            needed: left / dt,
        })
    }

    /// Whether of the steps more have failed than may.
    pub(super) fn has_failed(&self, failed: usize) -> bool {
        failed > FAILURES.max(self.max_steps / FAILURES_IN_ALL)
    }

    /// What limits the steps.
    pub(super) fn limit(&mut self, controller: &Controller<'_>) -> Limit {
        let failed = 2 * self.failed > self.taken[BLOCKS - 1];
        match self.failure.take().filter(|_| failed) {
            Some(cause) => Limit::Failure(Box::new(cause)),
            None => controller.bound().unwrap_or(Limit::Error(self.error)),
        }
    }
}
