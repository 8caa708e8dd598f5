//! A run of the paper's slider for the figures.

use serde::{Deserialize, Serialize};
use stickslip::problems::pipping_slider::END;

/// The state law.
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

/// The coupling of rate and state in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Iteration {
    /// The paper's relaxed fixed point
    Paper,
    /// The fixed point by Aitken's rule
    Aitken,
    /// Rate and state solved simultaneously
    Monolithic,
}

/// A run of the paper's slider: its setting and discretisation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Experiment {
    /// The state law
    pub law: Law,
    /// Uniform refinements of the mesh of ten triangles
    pub refinements: usize,
    /// Steps in the whole 15 s
    pub steps: usize,
    /// The discretisation in time
    pub scheme: Scheme,
    /// The coupling of rate and state in a step
    pub rule: Iteration,
    /// Whether the state is updated with the mean of the rates at both ends of a step, which is of second order,
    /// instead of the last one, as in the paper
    pub midpoint: bool,
    /// The share of the 15 s after which it ends
    pub until: f64,
}

impl Experiment {
    /// The setting of the paper, on another mesh and with other steps.
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

    /// The same of second order, with monolithic coupling.
    #[must_use]
    pub fn of_second_order(self) -> Self {
        Self {
            rule: Iteration::Monolithic,
            midpoint: true,
            ..self
        }
    }

    /// The step size \[s\].
    pub fn step_size(&self) -> f64 {
        END / self.steps as f64
    }

    /// The number of steps to the end.
    pub fn count(&self) -> usize {
        (self.until * self.steps as f64).round() as usize
    }

    /// The name of its files.
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

    /// The estimated run time in arbitrary units: unknowns and problems of all steps.
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
