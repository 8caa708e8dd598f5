//! An experiment in numbers and as a picture.

use serde::Serialize;

use crate::arguments::{Friction, Preset};
use crate::common::plot::{Curve, DARK, Panel};
use crate::common::state_law::Law;
use crate::experiment::{Experiment, Steps};
use crate::integrate::{EVENT, Run, Sample};

/// The run in numbers: s, m, m/s.
#[derive(Serialize)]
pub(crate) struct Summary {
    preset: Preset,
    law: Law,
    friction: Friction,
    method: &'static str,
    step_size: Option<f64>,
    tolerance: Option<f64>,
    stiffness: f64,
    critical_stiffness: f64,
    steps: usize,
    local_problems: usize,
    time_end: f64,
    displacement_end: f64,
    slip_rate_end: f64,
    friction_end: f64,
    friction_min: f64,
    friction_max: f64,
    peak_slip_rate: f64,
    event_times: Vec<f64>,
    /// Between successive events.
    periods: Vec<f64>,
    milliseconds: f64,
    failure: Option<String>,
}

impl Summary {
    pub(crate) fn new(experiment: &Experiment, run: &Run, slip_distance: f64) -> Self {
        let last = run.samples[run.samples.len() - 1];
        let (step_size, tolerance) = match experiment.steps {
            Steps::Constant(dt) => (Some(dt), None),
            Steps::Adaptive(tolerance) => (None, Some(tolerance)),
        };
        let over = |value: fn(&Sample) -> f64, pick: fn(f64, f64) -> f64| {
            run.samples.iter().map(value).fold(value(&last), pick)
        };
        let times = run.events.times().to_vec();
        Self {
            preset: experiment.preset,
            law: experiment.law,
            friction: experiment.friction,
            method: run.method,
            step_size,
            tolerance,
            stiffness: experiment.slider.stiffness,
            critical_stiffness: stickslip::problems::SpringSlider::critical_stiffness(
                experiment.slider.normal_stress,
                experiment.a,
                experiment.b,
                slip_distance,
            ),
            steps: run.samples.len() - 1,
            local_problems: run.solves,
            time_end: last.time,
            displacement_end: last.displacement,
            slip_rate_end: last.slip_rate,
            friction_end: last.friction,
            friction_min: over(|s| s.friction, f64::min),
            friction_max: over(|s| s.friction, f64::max),
            peak_slip_rate: over(|s| s.slip_rate.abs(), f64::max),
            periods: times.windows(2).map(|pair| pair[1] - pair[0]).collect(),
            event_times: times,
            milliseconds: 1e3 * run.seconds,
            failure: run.failure.as_ref().map(ToString::to_string),
        }
    }

    pub(crate) fn print(&self) {
        println!(
            "{} steps ({}), {} local problems to t = {:.5} s in {:.3} ms",
            self.steps, self.method, self.local_problems, self.time_end, self.milliseconds
        );
        println!(
            "friction from {:.8} to {:.8}, {:.8} in the end; slip {:.6e} m",
            self.friction_min, self.friction_max, self.friction_end, self.displacement_end
        );
        if !self.event_times.is_empty() {
            println!(
                "{} events (V above {:e} m/s), periods {:?} s, largest slip rate {:.4e} m/s",
                self.event_times.len(),
                EVENT.0,
                self.periods,
                self.peak_slip_rate
            );
        }
    }
}

/// Friction over displacement, as experiments are drawn, and the slip rate over time.
pub(crate) fn panels<'a>(run: &Run) -> [Panel<'a>; 2] {
    let panel = |x, y, logarithmic, point: fn(&Sample) -> (f64, f64)| Panel {
        x,
        y,
        logarithmic,
        curves: vec![Curve {
            label: "",
            color: DARK,
            width: 3,
            points: run.samples.iter().map(point).collect(),
        }],
    };
    [
        panel("displacement [mm]", "coefficient of friction", false, |s| {
            (1e3 * s.displacement, s.friction)
        }),
        panel("time [s]", "slip rate [m/s]", true, |s| {
            (s.time, s.slip_rate)
        }),
    ]
}
