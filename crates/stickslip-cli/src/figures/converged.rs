//! The events of figure 6.3 by a method of second order, beside the paper's.

use serde_json::{Value, json};

use super::histories::{entry, setting, write};
use super::{Drawing, Experiment, Outcome};
use crate::cli::Problem;
use crate::output::Output;
use crate::plot::{self, COLORS, Panel};

/// The paper's pairing above, a second-order pairing below.
pub(super) struct Converged {
    pub(super) quick: bool,
}

impl Drawing for Converged {
    fn experiments(&self) -> Vec<Experiment> {
        let (refinements, steps) = setting(self.quick);
        let paper = steps.map(|steps| Experiment::paper(refinements, steps));
        [paper, paper.map(Experiment::of_second_order)].concat()
    }

    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem> {
        let (paper, second) = outcomes.split_at(outcomes.len() / 2);
        let labels = |of: &[Outcome], by: &str| -> Vec<String> {
            let label = |o: &Outcome| format!("{by}, N = {:e}", o.experiment.steps as f64);
            of.iter().map(label).collect()
        };
        let looks = [(COLORS[0], 3), (COLORS[1], 4), (COLORS[6], 2)];
        let panels = [(paper, "first order"), (second, "second order")].map(|(of, by)| {
            let labels = labels(of, by);
            (of, labels)
        });
        let panels: Vec<Panel<'_>> = (panels.iter())
            .map(|(of, labels)| {
                let panel = Panel::new("time [s]", "slip rate at x0 [m/s]").logarithmic();
                let curves = of.iter().zip(labels).zip(looks);
                curves.fold(panel, |panel, ((outcome, label), (color, width))| {
                    panel.with(label, color, width, outcome.since(0.75, |s| s.velocity))
                })
            })
            .collect();
        plot::print(output.folder(), "converged", &panels[..])?;
        write(output, "converged.csv", 0.75, second)?;
        let latest = second.last().ok_or("no run")?;
        let distance = |outcome: &Outcome| -> Vec<f64> {
            let pairs = outcome.events.iter().zip(&latest.events);
            pairs.map(|(a, b)| a - b).collect()
        };
        let entries = |of: &[Outcome]| -> Vec<Value> {
            let with = |outcome: &Outcome| {
                let mut entry = entry(outcome);
                entry["events_after_reference"] = json!(distance(outcome));
                entry
            };
            of.iter().map(with).collect()
        };
        Ok(json!({
            "claim": "with a method of second order the events hardly depend on the step size: the least steps lie nearer to \
                      the limit than ten times as many of the paper's pairing, whose events are off by an amount \
                      proportional to the step",
            "reference": "the second order with the most steps",
            "runs": entries(paper),
            "second_order": entries(second),
        }))
    }
}
