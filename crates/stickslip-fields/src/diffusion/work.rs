//! Scratch of a step.

use super::system::{Conductances, System};

/// The numbers of a step that no memory keeps.
#[derive(Debug, Clone)]
pub(super) struct Work {
    /// The conductances of the step, where they change with time.
    pub own: Conductances,
    pub system: System,
    /// The volume rates into cells at the start.
    pub flow: Vec<f64>,
    /// The change of pressure up to `gamma dt`.
    pub first: Vec<f64>,
    /// The change of pressure of the step.
    pub second: Vec<f64>,
    /// The right-hand side of a stage that is solved twice; else empty.
    pub kept: Vec<f64>,
    /// The rates of sources at both ends of the step.
    pub rates: Vec<[f64; 2]>,
    /// The bores, in the order of their sources.
    pub bores: Vec<BoreWork>,
}

/// The numbers of a bore in a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BoreWork {
    /// The well index.
    pub index: f64,
    /// The volume rate into the bore at the start, without its source.
    pub flow: f64,
    /// The right-hand side of its balance.
    pub side: f64,
    /// Its change of pressure.
    pub change: f64,
}

impl Work {
    /// The vector of a stage: its right-hand side, then its solution.
    pub(super) fn side(&mut self, stage: Stage) -> &mut [f64] {
        match stage {
            Stage::First => &mut self.first,
            Stage::Second => &mut self.second,
        }
    }
}

/// The right-hand side of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    First,
    Second,
}
