//! The plan of a run: step sizes, end and stops.

use crate::{ErrorControl, StepError};

/// Constant or adaptive steps, up to a time or a number of steps, with stops.
///
/// | | |
/// | --- | --- |
/// | [`constant`](Self::constant) | steps of one size, shortened before a stop or the end |
/// | [`adaptive`](Self::adaptive) | steps whose local error satisfies a tolerance |
/// | [`until`](Self::until), [`count`](Self::count) | the end, the first of both; without one the observer ends the run |
/// | [`without_substeps`](Self::without_substeps) | a failed constant step ends the run |
/// | [`stopping_at`](Self::stopping_at) | times at which a step ends: jumps and kinks of the data, output times |
///
/// A run continues at the end of the last one, also with another plan, scheme, solver or coupling. An adaptive run
/// continues with the step that the last one had planned.
///
/// Failed constant steps, those without a [unique solution](StepError::NotUnique) among them, are split into substeps.
/// Adaptive steps keep the error of each quantity of [`ErrorControl`] below a tolerance. A proportional-integral
/// controller sets the next step (K. Gustafsson, "Control-theoretic techniques for stepsize selection in implicit
/// Runge-Kutta methods", ACM TOMS 20 (1994)). A step that fails, or whose error exceeds the tolerance, is rejected and
/// repeated with a smaller size.
///
/// ```
/// use std::ops::ControlFlow;
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
///
/// # let slider = SpringSlider {
/// #     stiffness: 1e9,
/// #     normal_stress: 1e6,
/// #     mass: 5e3,
/// #     damping: 0.0,
/// #     load: LoadPath::steady(1e-6).then(5.0, 1e-5),
/// # };
/// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// // The load has a kink at 5 s: a step ends there. The observer ends the run at 2 um/s.
/// let steps = Steps::adaptive(1e-4).until(1000.0).stopping_at([5.0]);
/// let report = simulation.run(&steps, |at| {
///     if at.max_slip_rate() > 2e-6 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert!(simulation.snapshot().time > 5.0 && report.accepted > 0);
/// // It continues, with the step it had.
/// simulation.run(&steps, |_| ())?;
/// assert_eq!(simulation.snapshot().time, 1000.0);
/// assert!((simulation.snapshot().max_slip_rate() / 1e-5 - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    pub(super) size: StepSize,
    /// The end time \[s\].
    pub(super) until: Option<f64>,
    /// The number of accepted steps at the end.
    pub(super) count: Option<usize>,
    pub(super) stops: Vec<f64>,
    /// An option without meaning for steps of this kind.
    meaningless: Option<&'static str>,
}

/// The step size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StepSize {
    Constant(Constant),
    Adaptive(Adaptive),
}

/// The settings of constant steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Constant {
    pub(super) dt: f64,
    pub(super) substeps: bool,
}

/// The settings of adaptive steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Adaptive {
    pub(super) tolerance: f64,
    pub(super) control: ErrorControl,
    pub(super) first_step: Option<f64>,
    pub(super) min_step: f64,
    pub(super) max_step: f64,
    pub(super) max_steps: usize,
    pub(super) quantised: bool,
}

impl Steps {
    /// Steps of `dt` \[s\].
    pub fn constant(dt: f64) -> Self {
        Self::of_size(StepSize::Constant(Constant { dt, substeps: true }))
    }

    /// Steps whose local error satisfies a relative tolerance in slip rates, states and motion, with a floor per
    /// quantity: see [`ErrorControl`].
    pub fn adaptive(tolerance: f64) -> Self {
        Self::of_size(StepSize::Adaptive(Adaptive {
            tolerance,
            control: ErrorControl::default(),
            first_step: None,
            min_step: 0.0,
            max_step: f64::INFINITY,
            max_steps: 1_000_000,
            quantised: false,
        }))
    }

    fn of_size(size: StepSize) -> Self {
        Self {
            size,
            until: None,
            count: None,
            stops: Vec::new(),
            meaningless: None,
        }
    }

    /// Ends at a time \[s\]; the last step is shortened to it.
    #[must_use]
    pub fn until(mut self, time: f64) -> Self {
        self.until = Some(time);
        self
    }

    /// Ends after a number of accepted steps, the least of all given counts. A step that is split counts as one: a run
    /// in pieces, each by `plan.clone().count(1000)`, takes the steps of the whole run, bit for bit.
    #[must_use]
    pub fn count(mut self, steps: usize) -> Self {
        self.count = Some(self.count.map_or(steps, |count| count.min(steps)));
        self
    }

    /// Ends a step at each of these times \[s\] that lies ahead. Data can jump there: the step that ends at a stop sees
    /// prescribed velocities, loads and normal stresses from the left, the next one from the right.
    #[must_use]
    pub fn stopping_at(mut self, stops: impl IntoIterator<Item = f64>) -> Self {
        self.stops.extend(stops);
        self.stops.sort_unstable_by(f64::total_cmp);
        self
    }

    /// Splits a failed step of constant size into substeps, down to 1/1024 of it. This is the default, see
    /// [`without_substeps`](Self::without_substeps). The observer also sees the substeps, and the report counts them.
    #[must_use]
    pub fn with_substeps(self) -> Self {
        self.splitting("with_substeps", true)
    }

    /// Ends the run with the error of a failed constant step.
    #[must_use]
    pub fn without_substeps(self) -> Self {
        self.splitting("without_substeps", false)
    }

    fn splitting(mut self, option: &'static str, splits: bool) -> Self {
        match &mut self.size {
            StepSize::Constant(constant) => constant.substeps = splits,
            StepSize::Adaptive(_) => self.meaningless = Some(option),
        }
        self
    }

    /// Sets the error measure and the extrapolation. It applies to adaptive steps, as do all options below.
    #[must_use]
    pub fn with_error_control(self, control: ErrorControl) -> Self {
        self.adapted("with_error_control", |adaptive| adaptive.control = control)
    }

    /// Begins with a step of `dt` \[s\] if no earlier run has planned one; a millionth of the run by default.
    #[must_use]
    pub fn with_first_step(self, dt: f64) -> Self {
        self.adapted("with_first_step", |adaptive| adaptive.first_step = Some(dt))
    }

    /// Fails if a step of less than `dt` \[s\] is needed; by default if the step does not advance the clock.
    #[must_use]
    pub fn with_min_step(self, dt: f64) -> Self {
        self.adapted("with_min_step", |adaptive| adaptive.min_step = dt)
    }

    /// Limits steps to at most `dt` \[s\].
    #[must_use]
    pub fn with_max_step(self, dt: f64) -> Self {
        self.adapted("with_max_step", |adaptive| adaptive.max_step = dt)
    }

    /// Limits the number of steps, accepted or not; a million by default. A run that exceeds it fails with the limiting
    /// quantity ([`StepError::TooManySteps`](crate::StepError::TooManySteps)).
    #[must_use]
    pub fn with_max_steps(self, max_steps: usize) -> Self {
        self.adapted("with_max_steps", |adaptive| adaptive.max_steps = max_steps)
    }

    /// Restricts step sizes to ratios of powers of two: a solver then reuses its factors.
    #[must_use]
    pub fn in_powers_of_two(self) -> Self {
        self.adapted("in_powers_of_two", |adaptive| adaptive.quantised = true)
    }

    fn adapted(mut self, option: &'static str, change: impl FnOnce(&mut Adaptive)) -> Self {
        match &mut self.size {
            StepSize::Adaptive(adaptive) => change(adaptive),
            StepSize::Constant(_) => self.meaningless = Some(option),
        }
        self
    }

    /// Refuses an inconsistent plan from `time` on.
    pub(crate) fn validate(&self, time: f64) -> Result<(), StepError> {
        let require = |what, requirement, value: f64, legal: bool| {
            if legal {
                Ok(())
            } else {
                Err(StepError::Control {
                    what,
                    requirement,
                    value,
                })
            }
        };
        if let Some(option) = self.meaningless {
            return Err(StepError::Option { option });
        }
        if let Some(end) = self.until {
            require(
                "end",
                "finite, and not before the present time",
                end,
                end.is_finite() && end >= time,
            )?;
        }
        let nan = self.stops.iter().find(|stop| stop.is_nan());
        require("stop", "a number", f64::NAN, nan.is_none())?;
        let StepSize::Adaptive(adaptive) = &self.size else {
            return Ok(());
        };
        let &Adaptive {
            tolerance,
            control,
            first_step,
            min_step,
            max_step,
            ..
        } = adaptive;
        let ErrorControl {
            slip_rate_floor: floor,
            relative_slip_rate_floor: relative,
            motion_floor,
            slip_floor,
            motion,
            ..
        } = control;
        require("tolerance", "positive", tolerance, tolerance > 0.0)?;
        let first = first_step.unwrap_or(1.0);
        require("first step", "positive", first, first > 0.0)?;
        let ordered = min_step >= 0.0 && min_step <= max_step;
        require(
            "smallest step",
            "at least 0 and at most the largest step",
            min_step,
            ordered,
        )?;
        require("largest step", "positive", max_step, max_step > 0.0)?;
        require("slip rate floor", "at least 0", floor, floor >= 0.0)?;
        let what = "relative slip rate floor";
        require(what, "at least 0", relative, relative >= 0.0)?;
        let what = "motion floor";
        require(what, "at least 0", motion_floor, motion_floor >= 0.0)?;
        require("slip floor", "at least 0", slip_floor, slip_floor >= 0.0)?;
        require(
            "weight of the motion",
            "from 0 to 1",
            motion,
            (0.0..=1.0).contains(&motion),
        )
    }
}
