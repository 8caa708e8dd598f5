//! An experiment in numbers and as a picture.

use crate::cli::{Problem, expect};
use crate::output::{Output, number};
use crate::plot::{self, DARK, Panel};
use serde_json::json;
use stickslip::StepFailure;
use stickslip::problems::spring_slider::SpringSlider;

use super::arguments::PUBLISHED;
use super::record::EVENT;
use super::{Arguments, Experiment, Record, Sample};

/// The run time below which runs are repeated for their timing \[s\].
const SHORT: f64 = 0.05;
const RUNS: usize = 9;

const HISTORY: &str = "history.csv";
const COLUMNS: &str = "time,load_point_velocity,slip_rate,displacement,theta,friction";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

impl Record {
    /// Writes and prints the results; a short run is timed by the median of several.
    pub fn report(
        &mut self,
        arguments: &Arguments,
        experiment: &Experiment,
        failure: Option<StepFailure>,
        again: impl Fn() -> Result<f64, Problem>,
    ) -> Result<(), Problem> {
        let output = arguments
            .files
            .create("spring_slider", &[HISTORY, PICTURE, SUMMARY])?;
        if failure.is_none() && self.seconds < SHORT {
            let mut seconds = [0.0; RUNS];
            for seconds in &mut seconds {
                *seconds = again()?;
            }
            seconds.sort_unstable_by(f64::total_cmp);
            self.seconds = seconds[RUNS / 2];
        }
        self.write_history(experiment, &output)?;
        let curve = |point: fn(&Sample) -> (f64, f64)| self.kept().map(point).collect();
        let friction = curve(|s| (1e3 * s.displacement, s.friction));
        let slip_rate = curve(|s| (s.time, s.slip_rate));
        let panels = [
            Panel::new("displacement [mm]", "coefficient of friction").with("", DARK, 3, friction),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 3, slip_rate),
        ];
        plot::draw(&output.path(PICTURE), &panels)?;
        self.write_summary(experiment, &output, failure.as_ref())?;
        self.print()?;
        say!("{}", output.told(&[HISTORY, PICTURE, SUMMARY]))?;
        if let Some(failure) = failure {
            return Err(failure.into());
        }
        match self.at.1 {
            Some(friction) if arguments.is_default() => {
                expect("friction at 11 s", friction, PUBLISHED.1, 2e-6)
            }
            _ => Ok(()),
        }
    }

    fn write_history(&self, experiment: &Experiment, output: &Output) -> Result<(), Problem> {
        let rows = self.kept().map(|s| {
            let load_velocity = experiment.slider.load.velocity(s.time);
            [
                s.time,
                load_velocity,
                s.slip_rate,
                s.displacement,
                s.theta,
                s.friction,
            ]
            .map(number)
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
        let last = self.end()?;
        let periods = self.periods();
        let [least, most] = self.friction;
        let parameters = laws.parameters;
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
                "steps": self.count - 1,
                "local_problems": self.solves,
                "time_end": last.time,
                "displacement_end": last.displacement,
                "slip_rate_end": last.slip_rate,
                "friction_end": last.friction,
                "friction_min": least,
                "friction_max": most,
                "peak_slip_rate": self.peak_slip_rate,
                "event_times": self.events.times(),
                "periods": periods,
                "milliseconds": 1e3 * self.seconds,
                "failure": failure.map(ToString::to_string),
            }),
        )
    }

    fn end(&self) -> Result<Sample, Problem> {
        Ok(self.last.ok_or("no step was taken")?)
    }

    fn periods(&self) -> Vec<f64> {
        let times = self.events.times();
        times.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    fn print(&self) -> Result<(), Problem> {
        let last = self.end()?;
        say!(
            "{} steps ({}), {} local problems to t = {:.5} s in {:.3} ms",
            self.count - 1,
            self.method,
            self.solves,
            last.time,
            1e3 * self.seconds
        )?;
        let [least, most] = self.friction;
        say!(
            "friction from {least:.8} to {most:.8}, {:.8} in the end; slip {:.6e} m",
            last.friction,
            last.displacement
        )?;
        let count = self.events.times().len();
        if count > 0 {
            say!(
                "{count} events (V above {:e} m/s), {}, largest slip rate {:.4e} m/s",
                EVENT.0,
                told(&self.periods()),
                self.peak_slip_rate
            )?;
        }
        Ok(())
    }
}

/// Periods for a reader: each of a few, of many their number, their mean and their ends.
fn told(periods: &[f64]) -> String {
    const FEW: usize = 8;
    let count = periods.len();
    if count <= FEW {
        return format!("periods {periods:.6?} s");
    }
    let mean = periods.iter().sum::<f64>() / count as f64;
    let least = periods.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = periods.iter().copied().fold(0.0, f64::max);
    format!("{count} periods of {mean:.6} s in the mean, from {least:.6} to {largest:.6} s")
}
