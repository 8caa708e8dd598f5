//! Measured error against run time.

use std::fmt::Display;
use std::time::Instant;

/// A table of errors and run times of several methods on one scene, against one reference.
///
/// Each method is a closure that runs the scene at a setting, a step size or a tolerance, and returns the number that
/// is compared with the reference. Methods run one after the other, each setting several times; the time is the median.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::work_precision::{WorkPrecision, observed_order};
/// use stickslip::{Newmark, Point, RungeKutta, Simulation, Steps};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let slider = SpringSlider {
///     stiffness: 1e9,
///     normal_stress: 1e6,
///     mass: 0.0,
///     damping: 5e6,
///     load: LoadPath::steady(1e-5),
/// };
/// let scene = || slider.steady(FRICTION, AGING, 1e-6);
/// let explicit = |tolerance: f64| -> Result<f64, Box<dyn std::error::Error>> {
///     let mut run = RungeKutta::new(scene()?)?;
///     run.run(&Steps::adaptive(tolerance).until(5.0), |_| ())?;
///     Ok(run.snapshot().velocity[0][0].ln())
/// };
/// let implicit = |dt: f64| -> Result<f64, Box<dyn std::error::Error>> {
///     let mut run = Simulation::new(scene()?, Newmark::default(), Point)?;
///     run.run(&Steps::constant(dt).until(5.0), |_| ())?;
///     Ok(run.snapshot().velocity[0][0].ln())
/// };
/// let table = WorkPrecision::against(explicit(1e-11)?)
///     .with_runs(1)
///     .method("Runge-Kutta", &[1e-4, 1e-6], explicit)
///     .method("Newmark, midpoint", &[1e-2, 5e-3], implicit)
///     .finish();
/// let error = |k: usize| table[k].error;
/// assert!(error(1) < error(0) && error(3) < 0.3 * error(2));
/// let order = observed_order(&table, "Newmark, midpoint");
/// assert!(order.is_some_and(|order| (order - 2.0).abs() < 0.1));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct WorkPrecision {
    reference: f64,
    runs: usize,
    measurements: Vec<Measurement>,
}

/// One method at one setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The name of the method.
    pub method: String,
    /// The step size or tolerance.
    pub setting: f64,
    /// The distance of the result from the reference; NaN if there is none.
    pub error: f64,
    /// The median of the run times \[s\].
    pub seconds: f64,
    /// The error message of a failed run.
    pub failure: Option<String>,
}

impl WorkPrecision {
    /// A table of errors against this number; three runs per setting.
    pub fn against(reference: f64) -> Self {
        Self {
            reference,
            runs: 3,
            measurements: Vec::new(),
        }
    }

    /// Sets the number of runs per setting, at least one; the table contains their median.
    #[must_use]
    pub fn with_runs(mut self, runs: usize) -> Self {
        self.runs = runs.max(1);
        self
    }

    /// Measures a method at each of the settings. A failed run is recorded as a failure.
    #[must_use]
    pub fn method<E: Display>(
        mut self,
        name: &str,
        settings: &[f64],
        mut run: impl FnMut(f64) -> Result<f64, E>,
    ) -> Self {
        for &setting in settings {
            let mut seconds = Vec::with_capacity(self.runs);
            let mut result = Ok(f64::NAN);
            for _ in 0..self.runs {
                let clock = Instant::now();
                result = run(setting);
                seconds.push(clock.elapsed().as_secs_f64());
                if result.is_err() {
                    break;
                }
            }
            seconds.sort_unstable_by(f64::total_cmp);
            let (error, failure) = match result {
                Ok(value) => ((value - self.reference).abs(), None),
                Err(problem) => (f64::NAN, Some(problem.to_string())),
            };
            self.measurements.push(Measurement {
                method: name.into(),
                setting,
                error,
                seconds: seconds[seconds.len() / 2],
                failure,
            });
        }
        self
    }

    /// The measurements, in the order of the calls.
    pub fn finish(self) -> Vec<Measurement> {
        self.measurements
    }
}

/// The time in which a method reaches an error \[s\]: from its cheapest measurement towards dearer ones,
/// log-linear between the last above the error and the first below; `None` where none is below.
pub fn seconds_to(measurements: &[Measurement], method: &str, error: f64) -> Option<f64> {
    let mut points: Vec<(f64, f64)> = measurements
        .iter()
        .filter(|m| m.method == method && m.error.is_finite())
        .map(|m| (m.seconds.ln(), m.error.max(f64::MIN_POSITIVE).ln()))
        .collect();
    points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let wanted = error.ln();
    let first = points.iter().position(|point| point.1 <= wanted)?;
    let (time, reached) = points[first];
    let Some(&(cheaper, missed)) = first.checked_sub(1).and_then(|k| points.get(k)) else {
        return Some(time.exp());
    };
    let share = (missed - wanted) / (missed - reached);
    Some((cheaper + share * (time - cheaper)).exp())
}

/// The observed order of a method: the power of the step size, or of the tolerance, with which its error
/// falls.
///
/// It is the median of the slopes between all pairs of its measurements (P. Sen, "Estimates of the regression
/// coefficient based on Kendall's tau", J. Amer. Statist. Assoc. 63 (1968)),
///
/// ```text
/// p = median of ln(e_i/e_j) / ln(h_i/h_j),   i < j,   h_i != h_j
/// ```
///
/// The result is exact for `e = c h^p`. An error that is small because it changes its sign there, or that the reference
/// limits, biases a least-squares line; the median tolerates such measurements below 29 % of all. Failed runs and
/// errors of zero have no slope and do not count; `None` for fewer than two remaining settings.
///
/// ```
/// use stickslip::work_precision::{WorkPrecision, observed_order};
///
/// // The trapezoidal rule for the integral of exp from 0 to 1.
/// let rule = |h: f64| -> Result<f64, String> {
///     let cells = (1.0 / h).round() as usize;
///     Ok((0..cells).map(|k| 0.5 * h * ((k as f64 * h).exp() + ((k + 1) as f64 * h).exp())).sum())
/// };
/// let table = WorkPrecision::against(1f64.exp_m1()).method("trapezoidal", &[0.2, 0.1, 0.05], rule);
/// let order = observed_order(&table.finish(), "trapezoidal");
/// assert!(order.is_some_and(|order| (order - 2.0).abs() < 1e-3));
/// ```
pub fn observed_order(measurements: &[Measurement], method: &str) -> Option<f64> {
    let points: Vec<(f64, f64)> = measurements
        .iter()
        .filter(|m| m.method == method && m.error > 0.0 && m.error.is_finite())
        .map(|m| (m.setting.ln(), m.error.ln()))
        .collect();
    let mut slopes = Vec::new();
    for (k, (setting, error)) in points.iter().enumerate() {
        let others = points[k + 1..].iter().filter(|other| other.0 != *setting);
        slopes.extend(others.map(|other| (error - other.1) / (setting - other.0)));
    }
    slopes.sort_unstable_by(f64::total_cmp);
    let last = slopes.len().checked_sub(1)?;
    Some(0.5 * (slopes[last / 2] + slopes[last.div_ceil(2)]))
}
