//! An experiment in numbers and as a picture.

use crate::cli::{Problem, expect};
use crate::onsets::Onsets;
use crate::output::{Output, digits};
use crate::plot::{self, DARK, Panel};
use serde_json::json;
use stickslip::StepFailure;
use stickslip::problems::spring_slider::SpringSlider;

use super::{Arguments, Experiment};

/// The slip rates [m/s] for the start and the end of an event.
const EVENT: (f64, f64) = (1e-3, 1e-5);
/// A time and the coefficient of friction in the default setting at that time, a second after the step, as published
/// with another code.
const PUBLISHED: (f64, f64) = (11.0, 0.607_204_85);
/// The run time below which runs are repeated for their timing \[s\].
const SHORT: f64 = 0.05;
const RUNS: usize = 9;

const HISTORY: &str = "history.csv";
const COLUMNS: &str = "time,load_point_velocity,slip_rate,displacement,theta,friction";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// A sample at one time.
#[derive(Clone, Copy)]
pub struct Sample {
    /// \[s\].
    pub time: f64,
    /// \[m/s\].
    pub slip_rate: f64,
    /// The displacement since the beginning \[m\].
    pub displacement: f64,
    /// The state \[s\].
    pub theta: f64,
    /// The coefficient of friction.
    pub friction: f64,
    /// The number of local problems.
    pub solves: usize,
}

/// A history and its cost.
pub struct Record {
    method: &'static str,
    samples: Vec<Sample>,
    events: Onsets,
    /// The wall time of the run \[s\].
    pub seconds: f64,
}

impl Record {
    /// An empty record of a run with that method.
    pub fn new(method: &'static str) -> Self {
        Self {
            method,
            samples: Vec::with_capacity(1 << 16),
            events: Onsets::new(EVENT.0, EVENT.1),
            seconds: 0.0,
        }
    }

    /// Appends a sample.
    pub fn add(&mut self, sample: Sample) {
        self.events.record(sample.time, sample.slip_rate);
        self.samples.push(sample);
    }

    /// Writes and prints the results; a short run is timed by the median of several.
    pub fn report(
        &mut self,
        arguments: &Arguments,
        experiment: &Experiment,
        failure: Option<StepFailure>,
        again: impl Fn() -> Result<f64, Problem>,
    ) -> Result<(), Problem> {
        let output = Output::create(&arguments.out, &[HISTORY, PICTURE, SUMMARY])?;
        if failure.is_none() && self.seconds < SHORT {
            let mut seconds = [0.0; RUNS];
            for seconds in &mut seconds {
                *seconds = again()?;
            }
            seconds.sort_unstable_by(f64::total_cmp);
            self.seconds = seconds[RUNS / 2];
        }
        self.write_history(experiment, &output, arguments.every.get())?;
        self.write_summary(experiment, &output, failure.as_ref())?;
        let curve = |point: fn(&Sample) -> (f64, f64)| self.samples.iter().map(point).collect();
        let friction = curve(|s| (1e3 * s.displacement, s.friction));
        let slip_rate = curve(|s| (s.time, s.slip_rate));
        let panels = [
            Panel::new("displacement [mm]", "coefficient of friction").with("", DARK, 3, friction),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 3, slip_rate),
        ];
        plot::draw(&output.path(PICTURE), &panels)?;
        println!(
            "{HISTORY}, {PICTURE}, {SUMMARY} in {}",
            output.folder().display()
        );
        if let Some(failure) = failure {
            return Err(failure.into());
        }
        let (time, published) = PUBLISHED;
        let mut samples = self.samples.iter();
        match samples.find(|sample| (sample.time - time).abs() < 1e-9) {
            Some(sample) if arguments.is_default() => {
                expect("friction at 11 s", sample.friction, published, 2e-6)
            }
            _ => Ok(()),
        }
    }

    fn write_history(
        &self,
        experiment: &Experiment,
        output: &Output,
        every: usize,
    ) -> Result<(), Problem> {
        let last = self.samples.len() - 1;
        let kept = self.samples.iter().enumerate();
        let kept = kept.filter(|&(i, _)| i % every == 0 || i == last);
        let rows = kept.map(|(_, s)| {
            let load_velocity = experiment.slider.load.velocity(s.time);
            [
                s.time,
                load_velocity,
                s.slip_rate,
                s.displacement,
                s.theta,
                s.friction,
            ]
            .map(digits)
        });
        output.table(HISTORY, COLUMNS, rows)
    }

    fn write_summary(
        &self,
        experiment: &Experiment,
        output: &Output,
        failure: Option<&StepFailure>,
    ) -> Result<(), Problem> {
        let Experiment {
            slider,
            laws,
            step_size,
            ..
        } = experiment;
        let (steps, last) = (self.samples.len() - 1, self.samples[self.samples.len() - 1]);
        let largest =
            |value: fn(&Sample) -> f64| self.samples.iter().map(value).fold(f64::MIN, f64::max);
        let (least, most) = (-largest(|s| -s.friction), largest(|s| s.friction));
        let solves: usize = self.samples.iter().map(|s| s.solves).sum();
        let (times, milliseconds) = (self.events.times(), 1e3 * self.seconds);
        let periods: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (peak, parameters) = (largest(|s| s.slip_rate.abs()), laws.parameters);
        output.json(
            SUMMARY,
            &json!({
                "preset": experiment.preset,
                "law": laws.law,
                "friction": laws.friction,
                "method": self.method,
                "step_size": step_size,
                "tolerance": step_size.is_none().then_some(experiment.tolerance),
                "stiffness": slider.stiffness,
                "critical_stiffness": SpringSlider::critical_stiffness(slider.normal_stress, parameters.a, parameters.b, parameters.slip_distance),
                "steps": steps,
                "local_problems": solves,
                "time_end": last.time,
                "displacement_end": last.displacement,
                "slip_rate_end": last.slip_rate,
                "friction_end": last.friction,
                "friction_min": least,
                "friction_max": most,
                "peak_slip_rate": peak,
                "event_times": times,
                "periods": periods,
                "milliseconds": milliseconds,
                "failure": failure.map(ToString::to_string),
            }),
        )?;
        println!(
            "{steps} steps ({}), {solves} local problems to t = {:.5} s in {milliseconds:.3} ms",
            self.method, last.time
        );
        println!(
            "friction from {least:.8} to {most:.8}, {:.8} in the end; slip {:.6e} m",
            last.friction, last.displacement
        );
        if !times.is_empty() {
            println!(
                "{} events (V above {:e} m/s), periods {periods:?} s, largest slip rate {peak:.4e} m/s",
                times.len(),
                EVENT.0
            );
        }
        Ok(())
    }
}
