//! Error against run time on the slider.

use serde_json::{Value, json};

use super::experiment::{Iteration, Scheme};
use super::{Drawing, Experiment, Outcome};
use crate::cli::Problem;
use crate::output::{Output, number};
use crate::plot::{self, COLORS, Panel};

/// The time of the first slip by four methods, against their cost.
pub(super) struct Work {
    pub(super) quick: bool,
}

/// The share of the 15 s that includes the first slip.
const UNTIL: f64 = 0.7;

const METHODS: [&str; 5] = [
    "Newmark, fixed point (the paper's)",
    "Newmark, Aitken's rule",
    "Newmark, at once",
    "backward Euler, fixed point",
    "Newmark, midpoint state, at once",
];

impl Work {
    fn method(&self, k: usize, steps: usize) -> Experiment {
        let refinements = if self.quick { 2 } else { 4 };
        let paper = Experiment {
            until: UNTIL,
            ..Experiment::paper(refinements, steps)
        };
        let (rule, scheme) = (paper.rule, paper.scheme);
        let (rule, scheme) = match k {
            1 => (Iteration::Aitken, scheme),
            2 => (Iteration::Monolithic, scheme),
            3 => (rule, Scheme::BackwardEuler),
            4 => return paper.of_second_order(),
            _ => (rule, scheme),
        };
        Experiment {
            rule,
            scheme,
            ..paper
        }
    }

    fn steps(&self) -> &'static [usize] {
        if self.quick {
            &[5_000, 10_000, 20_000]
        } else {
            &[5_000, 10_000, 20_000, 40_000, 80_000]
        }
    }

    fn reference(&self) -> Experiment {
        self.method(4, if self.quick { 80_000 } else { 640_000 })
    }
}

impl Drawing for Work {
    fn experiments(&self) -> Vec<Experiment> {
        let methods = 0..METHODS.len();
        let runs =
            methods.flat_map(|k| self.steps().iter().map(move |&steps| self.method(k, steps)));
        runs.chain([self.reference()]).collect()
    }

    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem> {
        let (reference, outcomes) = outcomes.split_last().ok_or("no run")?;
        let exact = reference.first_slip.ok_or("the reference does not slip")?;
        let error = |outcome: &Outcome| {
            outcome
                .first_slip
                .map_or(f64::NAN, |time| (time - exact).abs())
        };
        let mut panel =
            Panel::new("run time [s]", "error of the first slip at x0 [s]").both_logarithmic();
        let shades = [6, 0, 2, 5, 4];
        let (mut rows, mut methods) = (Vec::new(), Vec::new());
        let groups = outcomes.chunks(self.steps().len());
        for ((name, of), shade) in METHODS.iter().zip(groups).zip(shades) {
            let points = of.iter().map(|o| (o.seconds, error(o)));
            panel = panel.with_dots(name, COLORS[shade], points.collect());
            rows.extend(of.iter().map(|o| {
                let steps = o.experiment.steps.to_string();
                [
                    (*name).into(),
                    steps.into(),
                    format!("{:.4}", o.seconds).into(),
                    number(error(o)),
                ]
            }));
            let runs = of.iter().map(|o| {
                json!({
                    "steps": o.experiment.steps,
                    "seconds": o.seconds,
                    "first_slip_time": o.first_slip,
                    "error": error(o),
                    "bridged_steps": o.substepped,
                })
            });
            methods.push(json!({"method": name, "runs": runs.collect::<Vec<_>>()}));
        }
        plot::print(output.folder(), "work", &[panel][..])?;
        output.table("work.csv", "method,steps,seconds,error", rows)?;
        Ok(json!({
            "claim": "the same error in less time: rate and state at once, and the state by the mean of both rates",
            "reference": {"steps": reference.experiment.steps, "first_slip_time": exact},
            "methods": methods,
        }))
    }
}
