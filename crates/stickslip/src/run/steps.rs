//! The plan of a run: step sizes, where it ends, where it stops on the way.

use crate::{ErrorControl, StepError};

/// Constant or adaptive steps, to a time or so many, with stops.
///
/// | | |
/// | --- | --- |
/// | [`constant`](Self::constant) | steps of one size; cut where a stop or the end is nearer |
/// | [`adaptive`](Self::adaptive) | each step's local error keeps to a tolerance |
/// | [`until`](Self::until), [`count`](Self::count) | the end, the first of both; without one the observer ends the run |
/// | [`bridging`](Self::bridging) | a constant step that fails is taken in parts |
/// | [`stopping_at`](Self::stopping_at) | times at which a step ends: kinks of the data, times of output |
///
/// A run goes on where the last one ended: another plan, scheme, solver or coupling may follow. An adaptive
/// run goes on with the step that the last one had planned.
///
/// Adaptive steps control the error of [`ErrorControl`]: the largest of the errors of `ln V` and of the state,
/// over the contacts, and of the motion of the body. A proportional-integral controller sets the next step (K. Gustafsson,
/// "Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods", ACM TOMS 20 (1994));
/// a step with an error above the tolerance, or one that fails, is taken back and tried again with a smaller
/// one. A run that would not get to its end within [the steps allowed](Self::with_max_steps) is given up early, with what
/// limits its steps.
///
/// ```
/// use std::ops::ControlFlow;
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{Newmark, Point, Simulation, Steps};
///
/// # let slider = SpringSlider {
/// #     stiffness: 1e9,
/// #     normal_stress: 1e6,
/// #     mass: 5e3,
/// #     damping: 0.0,
/// #     load: LoadPath::steady(1e-6).then(5.0, 1e-5),
/// # };
/// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, Newmark::default(), Point)?;
/// // The load has a kink at 5 s: a step ends there. The observer ends the run at 2 um/s.
/// let steps = Steps::adaptive(1e-4).until(1000.0).stopping_at([5.0]);
/// let report = simulation.run(&steps, |at| {
///     if at.max_slip_rate() > 2e-6 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert!(simulation.snapshot().time > 5.0 && report.accepted > 0);
/// // It goes on, with the step it had.
/// simulation.run(&steps, |_| ())?;
/// assert_eq!(simulation.snapshot().time, 1000.0);
/// assert!((simulation.snapshot().max_slip_rate() / 1e-5 - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    pub(super) size: StepSize,
    /// The time of the end \[s\].
    pub(super) until: Option<f64>,
    /// The accepted steps after which it ends.
    pub(super) count: Option<usize>,
    pub(super) stops: Vec<f64>,
    pub(super) bridging: bool,
}

/// How large a step is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StepSize {
    Constant(f64),
    Adaptive(Adaptive),
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
        Self::of_size(StepSize::Constant(dt))
    }

    /// Steps with a local error of `tolerance` in `ln V`, in the state, and in the motion relative to itself.
    pub fn adaptive(tolerance: f64) -> Self {
        Self::of_size(StepSize::Adaptive(Adaptive {
            tolerance,
            control: ErrorControl::default(),
            first_step: None,
            min_step: 0.0,
            max_step: f64::INFINITY,
            max_steps: 10_000_000,
            quantised: false,
        }))
    }

    fn of_size(size: StepSize) -> Self {
        Self {
            size,
            until: None,
            count: None,
            stops: Vec::new(),
            bridging: false,
        }
    }

    /// Ends at a time \[s\], to which the last step is cut.
    #[must_use]
    pub fn until(mut self, time: f64) -> Self {
        self.until = Some(time);
        self
    }

    /// Ends after so many accepted steps, the least of all counts given. A step that is bridged counts as one: a
    /// run in pieces, each by `plan.clone().count(1000)`, takes the steps of the whole one, bit for bit.
    #[must_use]
    pub fn count(mut self, steps: usize) -> Self {
        self.count = Some(self.count.map_or(steps, |count| count.min(steps)));
        self
    }

    /// Ends a step at each of these times \[s\] that lies ahead.
    #[must_use]
    pub fn stopping_at(mut self, stops: impl IntoIterator<Item = f64>) -> Self {
        self.stops.extend(stops);
        self.stops.sort_unstable_by(f64::total_cmp);
        self
    }

    /// Bridges a step of constant size that fails by smaller ones, down to a thousandth; the observer sees those
    /// too, and the report counts the steps bridged.
    #[must_use]
    pub fn bridging(mut self) -> Self {
        self.bridging = true;
        self
    }

    /// Sets how the error is measured, and whether it is taken off the result. Of adaptive steps, as all that
    /// follows.
    #[must_use]
    pub fn with_error_control(self, control: ErrorControl) -> Self {
        self.adapted(|adaptive| adaptive.control = control)
    }

    /// Begins with a step of `dt` \[s\] where no earlier run has planned one; a millionth of the run by default.
    #[must_use]
    pub fn with_first_step(self, dt: f64) -> Self {
        self.adapted(|adaptive| adaptive.first_step = Some(dt))
    }

    /// Keeps steps between two sizes \[s\]; a run that needs smaller ones fails.
    #[must_use]
    pub fn with_step_bounds(self, min_step: f64, max_step: f64) -> Self {
        self.adapted(|adaptive| (adaptive.min_step, adaptive.max_step) = (min_step, max_step))
    }

    /// Gives up after so many steps, accepted or not; ten million by default. Where one in forty of these has failed, and
    /// more than 200, it is [`StepError::TooManyFailures`](crate::StepError::TooManyFailures).
    ///
    /// A run that is bound for that is told early, by [`StepError::TooSlow`](crate::StepError::TooSlow): where each of
    /// the last ten blocks of a thousandth of these steps, or of five hundred if that is more (one that fails counts as
    /// twenty), led equally far to a factor of 4, and more steps than are left would lead to the end, even if the
    /// growth over these blocks went on linearly, or blocks came again that led as far as any after a shorter one. A run
    /// that ends within ten blocks is never given up, nor one whose events keep its step size on the move, nor one that
    /// goes from event to event. A run whose first phase of equal steps takes ten blocks or more, as waves without damping
    /// need, and a quick rest may be: it takes a larger number here. Without an [end](Self::until) nothing is foreseen,
    /// nor on the way to a [crossing](crate::Run::run_to_crossing).
    #[must_use]
    pub fn with_max_steps(self, max_steps: usize) -> Self {
        self.adapted(|adaptive| adaptive.max_steps = max_steps)
    }

    /// Uses step sizes that differ by powers of two, so that a solver can keep its factors.
    #[must_use]
    pub fn quantised(self) -> Self {
        self.adapted(|adaptive| adaptive.quantised = true)
    }

    fn adapted(mut self, change: impl FnOnce(&mut Adaptive)) -> Self {
        if let StepSize::Adaptive(adaptive) = &mut self.size {
            change(adaptive);
        }
        self
    }

    /// Refuses a plan that makes no sense from `time` on.
    pub(super) fn validate(&self, time: f64) -> Result<(), StepError> {
        let require = |what, value: f64, legal: bool| {
            if legal {
                Ok(())
            } else {
                Err(StepError::Control { what, value })
            }
        };
        if let Some(end) = self.until {
            require("end", end, end.is_finite() && end >= time)?;
        }
        let nan = self.stops.iter().find(|stop| stop.is_nan());
        require("stop", f64::NAN, nan.is_none())?;
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
            rest,
            motion,
            ..
        } = control;
        require("tolerance", tolerance, tolerance > 0.0)?;
        let first = first_step.unwrap_or(1.0);
        require("first step", first, first > 0.0)?;
        let ordered = min_step >= 0.0 && min_step <= max_step;
        require("smallest step", min_step, ordered)?;
        require("largest step", max_step, max_step > 0.0)?;
        require("slip rate floor", floor, floor >= 0.0)?;
        require("share of the velocity that is rest", rest, rest >= 0.0)?;
        require(
            "weight of the motion",
            motion,
            (0.0..=1.0).contains(&motion),
        )
    }
}
