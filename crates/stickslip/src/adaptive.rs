//! Step sizes by the local error of rate and state.

use crate::{ErrorControl, Failure, Snapshot, StepError, Stepper};

/// Chooses step sizes so that each step's local error keeps to a tolerance.
///
/// The error is that of [`Stepper::step_estimated`]: the larger of the errors of `ln V` and of the
/// state, over the frictional boundary. A proportional-integral controller sets the next step
/// (K. Gustafsson, "Control-theoretic techniques for stepsize selection in implicit Runge-Kutta
/// methods", ACM TOMS 20 (1994)); a step with an error above the tolerance, or one that fails, is
/// taken back and tried again with a smaller one.
///
/// Friction without state can make the slip rate jump, which no step resolves: such a run ends in
/// [`StepError::StepTooSmall`].
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{Adaptive, Newmark, Point, Simulation, Stepper};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let slider = SpringSlider {
/// #     stiffness: 1e9,
/// #     normal_stress: 1e6,
/// #     mass: 5e3,
/// #     damping: 0.0,
/// #     load: LoadPath::steady(1e-6).then(5.0, 1e-5),
/// # };
/// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, Newmark::default(), Point)?;
/// // The load has a kink at 5 s: a step ends there.
/// let report = Adaptive::new(1e-4)
///     .with_stops([5.0])
///     .run(&mut simulation, 1000.0, &mut |_| ())?;
/// assert_eq!(simulation.snapshot().time, 1000.0);
/// assert!((simulation.snapshot().velocity[0][0] / 1e-5 - 1.0).abs() < 1e-3);
/// # assert!(report.accepted > 0);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Adaptive {
    tolerance: f64,
    control: ErrorControl,
    first_step: Option<f64>,
    min_step: f64,
    max_step: f64,
    max_steps: usize,
    quantised: bool,
    stops: Vec<f64>,
}

/// What a run with adaptive steps cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AdaptiveReport {
    /// Doubled steps accepted.
    pub accepted: usize,
    /// Doubled steps taken back because their error was too large.
    pub rejected: usize,
    /// Doubled steps that failed.
    pub failed: usize,
    /// The smallest and the largest doubled step accepted \[s\].
    pub step_range: [f64; 2],
}

/// The share of the tolerance that a step aims at.
const SAFETY: f64 = 0.8;
/// The largest and the smallest ratio of successive steps.
const GROWTH: f64 = 4.0;
const SHRINK: f64 = 0.1;
/// What is left of a step that failed.
const AFTER_FAILURE: f64 = 0.25;
/// The part of the distance to a stop that rounding may take.
const SLACK: f64 = 1e-9;

impl Adaptive {
    /// Steps with a local error of `tolerance` in `ln V` and in the state.
    pub fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            control: ErrorControl::default(),
            first_step: None,
            min_step: 0.0,
            max_step: f64::INFINITY,
            max_steps: 10_000_000,
            quantised: false,
            stops: Vec::new(),
        }
    }

    /// Sets how the error is measured, and whether it is taken off the result.
    #[must_use]
    pub fn with_error_control(mut self, control: ErrorControl) -> Self {
        self.control = control;
        self
    }

    /// Begins with a step of `dt` \[s\]; a millionth of the run by default.
    #[must_use]
    pub fn with_first_step(mut self, dt: f64) -> Self {
        self.first_step = Some(dt);
        self
    }

    /// Keeps steps between two sizes \[s\]; a run that needs smaller ones fails.
    #[must_use]
    pub fn with_step_bounds(mut self, min_step: f64, max_step: f64) -> Self {
        (self.min_step, self.max_step) = (min_step, max_step);
        self
    }

    /// Gives up after so many steps, accepted or not; ten million by default.
    #[must_use]
    pub fn with_max_steps(mut self, max_steps: usize) -> Self {
        self.max_steps = max_steps;
        self
    }

    /// Uses step sizes that differ by powers of two, so that a solver can keep its factors.
    #[must_use]
    pub fn with_quantised_steps(mut self) -> Self {
        self.quantised = true;
        self
    }

    /// Ends a step at each of these times \[s\]: kinks of the data, times of output.
    #[must_use]
    pub fn with_stops(mut self, stops: impl IntoIterator<Item = f64>) -> Self {
        self.stops.extend(stops);
        self.stops.sort_unstable_by(f64::total_cmp);
        self
    }

    /// Runs to the time `until` \[s\], to which the last step is cut, and shows each accepted step to
    /// `observe`.
    ///
    /// # Errors
    /// A [`Failure`] with [`StepError::StepTooSmall`] where the tolerance, or the problem, asks for
    /// steps below the bound or below the resolution of time; with [`StepError::TooManySteps`]; with
    /// [`StepError::Control`] for a tolerance or bound that is no positive number, or a stop that is
    /// no number.
    pub fn run<const C: usize>(
        &self,
        stepper: &mut dyn Stepper<C>,
        until: f64,
        observe: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<AdaptiveReport, Failure> {
        self.validate(stepper, until)?;
        let mut report = AdaptiveReport {
            step_range: [f64::INFINITY, 0.0],
            ..AdaptiveReport::default()
        };
        let start = stepper.snapshot().time;
        let mut dt = self
            .first_step
            .unwrap_or(1e-6 * (until - start))
            .clamp(self.min_step, self.max_step);
        let exponent = 1.0 / stepper.error_order(&self.control) as f64;
        let halves = stepper.error_order(&self.control) <= 3;
        let mut last_error = SAFETY;
        let mut last_taken = f64::NAN;
        let mut stops = self.stops.iter().copied().peekable();
        loop {
            let time = stepper.snapshot().time;
            while stops
                .next_if(|&stop| stop <= time * (1.0 + f64::EPSILON))
                .is_some()
            {}
            let stop = stops.peek().map_or(until, |&stop| stop.min(until));
            let left = stepper.time_left(stop);
            if left <= SLACK * dt.min(left.abs() + until.abs() * f64::EPSILON) || time >= until {
                return Ok(report);
            }
            if report.accepted + report.rejected + report.failed >= self.max_steps {
                let snapshot = stepper.snapshot();
                return Err(Failure {
                    step: snapshot.step + 1,
                    time,
                    cause: StepError::TooManySteps {
                        steps: self.max_steps,
                        dt,
                    },
                });
            }
            // Neither beyond a stop nor to a sliver before it.
            let taken = if dt >= left * (1.0 - SLACK) {
                left
            } else if 2.0 * dt > left {
                0.5 * left
            } else {
                dt
            };
            let error = match stepper.step_estimated(taken, &self.control) {
                Ok(error) => error / self.tolerance,
                Err(failure) => {
                    report.failed += 1;
                    dt = AFTER_FAILURE * taken;
                    if self.too_small(dt, time) {
                        return Err(failure);
                    }
                    continue;
                }
            };
            if error <= 1.0 {
                report.accepted += 1;
                report.step_range = [
                    report.step_range[0].min(taken),
                    report.step_range[1].max(taken),
                ];
                observe(stepper.snapshot());
                let size = error.max(1e-8);
                let damped = (SAFETY / size).powf(0.7 * exponent)
                    * (last_error / SAFETY).powf(0.4 * exponent);
                // Steps that have to shrink again and again, as before an event: the trend goes on.
                let trend =
                    (taken / last_taken) * (SAFETY * last_error / (size * size)).powf(exponent);
                let ratio = damped.min(trend.max(SHRINK));
                last_taken = taken;
                last_error = size;
                let next = self.quantise(taken * ratio.clamp(SHRINK, GROWTH), taken);
                // A step cut short by a stop says nothing against the size that was planned.
                dt = if taken < dt { next.max(dt) } else { next }.min(self.max_step);
            } else {
                stepper.undo();
                report.rejected += 1;
                let ratio = (SAFETY / error).powf(exponent);
                let ratio = if ratio.is_finite() { ratio } else { SHRINK };
                // Of a step taken in two halves the first is known, and is the step to try next.
                let shorter = if halves && ratio > 0.25 {
                    0.5
                } else {
                    ratio.clamp(SHRINK, SAFETY)
                };
                dt = self.quantise(taken * shorter, taken);
                if self.too_small(dt, time) {
                    let snapshot = stepper.snapshot();
                    return Err(Failure {
                        step: snapshot.step + 1,
                        time: time + dt,
                        cause: StepError::StepTooSmall {
                            dt,
                            error: error * self.tolerance,
                            tolerance: self.tolerance,
                        },
                    });
                }
            }
        }
    }

    /// The largest size below `dt` that is a power of two times `base`, if asked for.
    fn quantise(&self, dt: f64, base: f64) -> f64 {
        if self.quantised {
            base * (dt / base).log2().floor().exp2()
        } else {
            dt
        }
    }

    fn too_small(&self, dt: f64, time: f64) -> bool {
        dt < self.min_step || dt <= 16.0 * f64::EPSILON * time.abs()
    }

    fn validate<const C: usize>(
        &self,
        stepper: &dyn Stepper<C>,
        until: f64,
    ) -> Result<(), Failure> {
        let snapshot = stepper.snapshot();
        for (what, value, legal) in [
            ("tolerance", self.tolerance, self.tolerance > 0.0),
            (
                "first step",
                self.first_step.unwrap_or(1.0),
                self.first_step.is_none_or(|dt| dt > 0.0),
            ),
            (
                "smallest step",
                self.min_step,
                self.min_step >= 0.0 && self.min_step <= self.max_step,
            ),
            ("largest step", self.max_step, self.max_step > 0.0),
            ("end", until, until.is_finite() && until >= snapshot.time),
            (
                "stop",
                f64::NAN,
                !self.stops.iter().any(|stop| stop.is_nan()),
            ),
            (
                "slip rate floor",
                self.control.slip_rate_floor,
                self.control.slip_rate_floor >= 0.0,
            ),
        ] {
            if !legal {
                return Err(Failure {
                    step: snapshot.step + 1,
                    time: snapshot.time,
                    cause: StepError::Control { what, value },
                });
            }
        }
        Ok(())
    }
}
