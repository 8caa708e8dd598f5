//! A run of the paper's slider that figures show.

use serde::{Deserialize, Serialize};
use stickslip::problems::END;

/// How the state evolves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// The aging law
    Dieterich,
    /// The slip law
    Ruina,
}

/// The discretisation in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Newmark's scheme
    Newmark,
    /// Backward Euler
    BackwardEuler,
}

/// How rate and state meet in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Iteration {
    /// The paper's relaxed fixed point
    Paper,
    /// The fixed point by Aitken's rule
    Aitken,
    /// At once
    Monolithic,
}

/// A run of the paper's slider: its setting and what is to be computed how finely.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Experiment {
    /// How the state evolves
    pub law: Law,
    /// Uniform refinements of the mesh of ten triangles
    pub refinements: usize,
    /// Steps in the whole 15 s
    pub steps: usize,
    /// The discretisation in time
    pub scheme: Scheme,
    /// How rate and state meet in a step
    pub rule: Iteration,
    /// Whether the state moves by the mean of the rates at both ends of a step, which is of second order, instead
    /// of the last one, as in the paper
    pub midpoint: bool,
    /// The share of the 15 s after which it ends
    pub until: f64,
}

impl Experiment {
    /// The setting of the paper, on a mesh and with steps of its own.
    pub fn paper(refinements: usize, steps: usize) -> Self {
        Self {
            law: Law::Dieterich,
            refinements,
            steps,
            scheme: Scheme::Newmark,
            rule: Iteration::Paper,
            midpoint: false,
            until: 1.0,
        }
    }

    /// The same of second order, rate and state at once.
    #[must_use]
    pub fn of_second_order(self) -> Self {
        Self {
            rule: Iteration::Monolithic,
            midpoint: true,
            ..self
        }
    }

    /// The size of a step \[s\].
    pub fn step_size(&self) -> f64 {
        END / self.steps as f64
    }

    /// The steps to the end.
    pub fn count(&self) -> usize {
        (self.until * self.steps as f64).round() as usize
    }

    /// A name for its files.
    pub fn name(&self) -> String {
        let Self {
            law,
            refinements,
            steps,
            scheme,
            rule,
            midpoint,
            until,
        } = self;
        let midpoint = if *midpoint { "-midpoint" } else { "" };
        let name = format!("j{refinements}-n{steps}-{law:?}-{scheme:?}-{rule:?}{midpoint}-{until}");
        name.to_lowercase()
    }

    /// About how long it takes, in any unit: unknowns and problems of all steps.
    pub fn effort(&self) -> f64 {
        let problems = match self.rule {
            Iteration::Paper => 1.6,
            Iteration::Aitken => 1.4,
            Iteration::Monolithic => 1.0,
        };
        let unknowns = 4_f64.powi(self.refinements as i32);
        self.count() as f64 * problems * unknowns * (self.refinements as f64).max(1.0)
    }
}
