//! Figure 6.1: fixed-point iterations over refinements.

use serde_json::{Value, json};

use super::experiment::{Iteration, Law};
use super::{Drawing, Experiment, Outcome};
use crate::cli::Problem;
use crate::output::Output;
use crate::plot::{self, COLORS, Panel};

/// Velocity problems per step by both laws and three rules.
pub(super) struct Iterations {
    pub(super) refinements: Vec<usize>,
    pub(super) steps: usize,
}

const LAWS: [Law; 2] = [Law::Dieterich, Law::Ruina];
const RULES: [(Iteration, &str); 3] = [
    (Iteration::Paper, "paper's rule"),
    (Iteration::Aitken, "Aitken's rule"),
    (Iteration::Monolithic, "at once"),
];

impl Iterations {
    pub(super) fn new(quick: bool, finest: bool) -> Self {
        let (refinements, steps) = match (quick, finest) {
            (true, _) => (2..=3, 5_000),
            (false, false) => (2..=7, 10_000),
            (false, true) => (2..=8, 10_000),
        };
        Self {
            refinements: refinements.collect(),
            steps,
        }
    }
}

impl Drawing for Iterations {
    fn experiments(&self) -> Vec<Experiment> {
        let mut experiments = Vec::new();
        for &refinements in &self.refinements {
            for law in LAWS {
                experiments.extend(RULES.map(|(rule, _)| Experiment {
                    law,
                    rule,
                    ..Experiment::paper(refinements, self.steps)
                }));
            }
        }
        experiments
    }

    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem> {
        let mean = |o: &Outcome| o.cost.per_step(o.cost.velocity_problems);
        let most = |o: &Outcome| o.cost.velocity_problems.most;
        let panel = |name| Panel::new("refinements", name);
        let mut panels = [
            panel("velocity problems a step, average"),
            panel("velocity problems a step, maximum"),
        ];
        let labels = LAWS.map(|law| RULES.map(|rule| format!("{law:?}, {}", rule.1)));
        for ((law, labels), shades) in LAWS.iter().zip(&labels).zip([[3, 0, 5], [2, 1, 4]]) {
            for ((rule, label), shade) in RULES.iter().zip(labels).zip(shades) {
                let chosen = |o: &&Outcome| o.experiment.law == *law && o.experiment.rule == rule.0;
                let over = |value: &dyn Fn(&Outcome) -> f64| {
                    let points = outcomes.iter().filter(chosen);
                    let points = points.map(|o| (o.experiment.refinements as f64, value(o)));
                    points.collect()
                };
                let [average, maximum] = panels;
                panels = [
                    average.with_dots(label, COLORS[shade], over(&mean)),
                    maximum.with_dots(label, COLORS[shade], over(&|o| most(o) as f64)),
                ];
            }
        }
        plot::print(output.folder(), "6.1", &panels[..])?;
        let columns =
            "law,refinements,rule,mean,max,solver_iterations_mean,fallbacks,bridged,seconds";
        let rows = outcomes.iter().map(|o| {
            [
                format!("{:?}", o.experiment.law).to_lowercase(),
                o.experiment.refinements.to_string(),
                format!("{:?}", o.experiment.rule).to_lowercase(),
                mean(o).to_string(),
                most(o).to_string(),
                o.cost.per_step(o.cost.solver_iterations).to_string(),
                o.cost.fallbacks.to_string(),
                o.substepped.to_string(),
                format!("{:.2}", o.seconds),
            ]
        });
        output.table("6.1.csv", columns, rows)?;
        let entries = outcomes.iter().map(|o| {
            json!({
                "law": o.experiment.law,
                "refinements": o.experiment.refinements,
                "rule": o.experiment.rule,
                "mean": mean(o),
                "max": most(o),
                "fallbacks": o.cost.fallbacks,
                "bridged_steps": o.substepped,
                "seconds": o.seconds,
            })
        });
        Ok(json!({
            "claim": "the number of fixed-point iterations does not depend on the mesh",
            "steps": self.steps,
            "iterations": entries.collect::<Vec<_>>(),
        }))
    }
}
