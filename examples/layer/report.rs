//! The computed and the exact solution side by side: in numbers, and as a picture.

use serde::Serialize;
use stickslip::problems::END;

use crate::common::plot::{Curve, DARK, PALE, Panel};
use crate::common::record::Run;
use crate::exact::Exact;
use crate::{Arguments, Law};

/// The displacement of the base, and its slip rate from shortly before the first event on.
pub(crate) fn panels<'a>(run: &Run, exact: &Exact) -> [Panel<'a>; 2] {
    let panel = |y, logarithmic, exact, computed| Panel {
        x: "time [s]",
        y,
        logarithmic,
        curves: vec![exact, computed],
    };
    let known = |label, points| Curve {
        label,
        color: PALE,
        width: 4,
        points,
    };
    let computed = |label, points| Curve {
        label,
        color: DARK,
        width: 2,
        points,
    };
    let start = 0.65 * END;
    let sliding = exact.samples.iter().filter(|s| s.time >= start);
    [
        panel(
            "displacement of the base [mm]",
            false,
            known(
                "exact",
                exact
                    .samples
                    .iter()
                    .map(|s| (s.time, 1e3 * s.displacement))
                    .collect(),
            ),
            computed(
                "computed",
                run.since(0.0)
                    .map(|s| (s.time, 1e3 * s.displacement))
                    .collect(),
            ),
        ),
        panel(
            "slip rate [m/s]",
            true,
            known("", sliding.map(|s| (s.time, s.slip_rate)).collect()),
            computed("", run.since(start).map(|s| (s.time, s.velocity)).collect()),
        ),
    ]
}

/// Both solutions in numbers: s, m, m/s.
#[derive(Serialize)]
pub(crate) struct Summary {
    law: Law,
    steps: usize,
    cells: usize,
    first_slip_time: Option<f64>,
    event_times: Vec<f64>,
    displacement_end: f64,
    peak_slip_rate: f64,
    exact_first_slip_time: Option<f64>,
    exact_event_times: Vec<f64>,
    exact_displacement_end: f64,
    exact_peak_slip_rate: f64,
    exact_transit_steps: usize,
    fixed_point_iterations_mean: f64,
    fixed_point_iterations_max: usize,
    solver_iterations_per_step: f64,
    milliseconds_per_step: f64,
    failure: Option<String>,
}

impl Summary {
    /// Puts both solutions side by side.
    pub(crate) fn new(arguments: &Arguments, run: &Run, exact: &Exact) -> Self {
        Self {
            law: arguments.law,
            steps: run.steps,
            cells: arguments.cells.get(),
            first_slip_time: run.first_slip(),
            event_times: run.events.times().to_vec(),
            displacement_end: run.displacement_end,
            peak_slip_rate: run.peak_slip_rate,
            exact_first_slip_time: exact.slips.times().first().copied(),
            exact_event_times: exact.events.times().to_vec(),
            exact_displacement_end: exact.displacement_end,
            exact_peak_slip_rate: exact.peak_slip_rate,
            exact_transit_steps: arguments.transit_steps.get(),
            fixed_point_iterations_mean: run.per_step(run.velocity_problems.0 as f64),
            fixed_point_iterations_max: run.velocity_problems.1,
            solver_iterations_per_step: run.per_step(run.solver_iterations.0 as f64),
            milliseconds_per_step: run.per_step(1e3 * run.seconds),
            failure: run.failure.as_ref().map(ToString::to_string),
        }
    }

    /// Prints both solutions and their difference.
    pub(crate) fn print(&self) {
        println!(
            "{:<28}{:>16}{:>16}{:>14}",
            "", "computed", "exact", "difference"
        );
        print_row(
            "first slip [s]",
            self.first_slip_time,
            self.exact_first_slip_time,
        );
        let (computed, exact) = (&self.event_times, &self.exact_event_times);
        for k in 0..computed.len().max(exact.len()) {
            let [computed, exact] = [computed, exact].map(|times| times.get(k).copied());
            print_row(&format!("event {} [s]", k + 1), computed, exact);
        }
        let (computed, exact) = (self.displacement_end, self.exact_displacement_end);
        print_row("displacement [mm]", Some(1e3 * computed), Some(1e3 * exact));
        let (computed, exact) = (self.peak_slip_rate, self.exact_peak_slip_rate);
        print_row(
            "largest slip rate [mm/s]",
            Some(1e3 * computed),
            Some(1e3 * exact),
        );
        println!(
            "{} steps, {:.3} ms each; coupling iterations a step: average {:.3}, maximum {}",
            self.steps,
            self.milliseconds_per_step,
            self.fixed_point_iterations_mean,
            self.fixed_point_iterations_max
        );
    }
}

fn print_row(what: &str, computed: Option<f64>, exact: Option<f64>) {
    let number = |x: Option<f64>| x.map_or("none".into(), |x| format!("{x:.6}"));
    let difference = computed
        .zip(exact)
        .map(|(computed, exact)| computed - exact);
    let difference = difference.map_or(String::new(), |x| format!("{x:+.2e}"));
    println!(
        "{what:<28}{:>16}{:>16}{difference:>14}",
        number(computed),
        number(exact)
    );
}
