//! Figures 6.2 to 6.4: displacement and slip rate at the centre through the last events.

use serde_json::{Map, Value, json};
use stickslip::problems::pipping_slider::END;

use super::experiment::Scheme;
use super::outcome::FRACTIONS;
use super::{Drawing, Experiment, Figure, Outcome};
use crate::cli::Problem;
use crate::output::{Output, number};
use crate::plot::{self, COLORS, Panel};
use crate::sample::Sample;

/// Three step sizes in one picture.
pub(super) struct Histories {
    figure: Figure,
    quick: bool,
}

impl Histories {
    pub(super) fn new(figure: Figure, quick: bool) -> Self {
        Self { figure, quick }
    }

    fn scheme(&self) -> Scheme {
        match self.figure {
            Figure::Damped => Scheme::BackwardEuler,
            _ => Scheme::Newmark,
        }
    }

    /// The claim of the paper.
    fn claim(&self) -> &'static str {
        match self.figure {
            Figure::Displacement => {
                "the body sticks and slips; the displacement grows from 9e-4 m to 12e-4 m in the last tenth, and steps of \
                 1/1e5 and 1/1e6 of T agree"
            }
            Figure::Velocity => {
                "events are quasi-periodic, slip rates lie between 1e-6 m/s and 1e-2 m/s, and differ between the step \
                 sizes by little but an offset in time"
            }
            _ => {
                "backward Euler damps what Newmark's scheme keeps, and agrees with it for small steps"
            }
        }
    }
}

/// The setting of figures 6.2 to 6.5: refinements, and the three numbers of steps.
pub(super) fn setting(quick: bool) -> (usize, [usize; 3]) {
    if quick {
        (2, [5_000, 10_000, 20_000])
    } else {
        (4, [10_000, 100_000, 1_000_000])
    }
}

/// The samples at the shares of the 15 s, by their names.
pub(super) fn at_fractions(outcome: &Outcome, value: fn(&Sample) -> f64) -> Value {
    let entry = |fraction: f64| (fraction.to_string(), json!(outcome.at(fraction).map(value)));
    Value::Object(FRACTIONS.map(entry).into_iter().collect::<Map<_, _>>())
}

/// A run as an entry of summary.json.
pub(super) fn entry(outcome: &Outcome) -> Value {
    json!({
        "steps": outcome.experiment.steps,
        "scheme": outcome.experiment.scheme,
        "displacement": at_fractions(outcome, |s| s.displacement),
        "velocity": at_fractions(outcome, |s| s.velocity),
        "state": at_fractions(outcome, |s| s.state),
        "first_slip_time": outcome.first_slip,
        "event_times": outcome.events,
        "peak_slip_rate": outcome.cost.peak_slip_rate,
        "bridged_steps": outcome.substepped,
        "seconds": outcome.seconds,
    })
}

/// Writes the samples of all runs.
pub(super) fn write(
    output: &Output,
    name: &str,
    since: f64,
    outcomes: &[Outcome],
) -> Result<(), Problem> {
    let rows = outcomes.iter().flat_map(|outcome| {
        let samples = outcome
            .history
            .iter()
            .filter(move |s| s.time >= since * END);
        samples.map(|s| {
            let steps = outcome.experiment.steps.to_string();
            [
                steps.into(),
                number(s.time),
                number(s.displacement),
                number(s.velocity),
                number(s.state),
            ]
        })
    });
    output.table(name, "steps,time,displacement,velocity,alpha", rows)
}

impl Drawing for Histories {
    fn experiments(&self) -> Vec<Experiment> {
        let (refinements, steps) = setting(self.quick);
        let with = |steps| Experiment {
            scheme: self.scheme(),
            ..Experiment::paper(refinements, steps)
        };
        steps.map(with).to_vec()
    }

    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem> {
        let name = self.figure.name();
        let displacement = self.figure == Figure::Displacement;
        let since = if displacement { 0.9 } else { 0.75 };
        let mut panel = if displacement {
            Panel::new("time [s]", "displacement at x0 [mm]")
        } else {
            Panel::new("time [s]", "slip rate at x0 [m/s]").logarithmic()
        };
        let labels = outcomes
            .iter()
            .map(|o| format!("N = {:e}", o.experiment.steps as f64));
        let labels: Vec<String> = labels.collect();
        let looks = [(COLORS[0], 3), (COLORS[1], 4), (COLORS[6], 2)];
        for ((outcome, label), (color, width)) in outcomes.iter().zip(&labels).zip(looks) {
            let points = outcome.since(
                since,
                match displacement {
                    true => |s| 1e3 * s.displacement,
                    false => |s| s.velocity,
                },
            );
            panel = panel.with(label, color, width, points);
        }
        plot::print(output.folder(), &name, &[panel][..])?;
        write(output, &format!("{name}.csv"), since, outcomes)?;
        Ok(json!({
            "claim": self.claim(),
            "refinements": setting(self.quick).0,
            "runs": outcomes.iter().map(entry).collect::<Vec<_>>(),
        }))
    }
}
