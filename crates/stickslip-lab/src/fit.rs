//! The fit of a record, or of several.

use crate::candidates::Shown;
use crate::course::{Course, Interrupt};
use crate::error::LabError;
use crate::evolution::Evolution;
use crate::experiment::Experiment;
use crate::fitted::Fitted;
use crate::joint::JointFit;
use crate::load::LoadHistory;
use crate::loss::Loss;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::record::Record;
use crate::search::Search;
use crate::trend::Trend;

/// A least-squares fit of friction to the record of an experiment, or to several at once.
///
/// Fitted are `a`, `b` and `L` of each state, `mu0`, the stiffness unless it is fixed, and on demand a trend, the
/// initial states, and parameters of state laws. The starts are computed from the curve.
///
/// ```
/// use stickslip_lab::{Evolution, Fit, LoadHistory, Parameter, Parameters, Record};
/// # use stickslip_friction::DieterichRuina;
///
/// let load = LoadHistory::new(1e-6, &[(50.0, 1e-5), (80.0, 0.0), (180.0, 1e-5)])?;
/// # let friction = DieterichRuina {
/// #     a: 0.008, b: 0.012, reference_friction: 0.6, reference_velocity: 1e-6, slip_distance: 1.5e-5,
/// # };
/// # let truth = Parameters::one_state(&friction, 1e3);
/// # let times: Vec<f64> = (0..=840).map(|n| 0.25 * f64::from(n)).collect();
/// # let friction = truth.curve(&[Evolution::Aging], &load, &times)?;
/// let record = Record::new(times, friction)?;
/// let fit = Fit::new(&[Evolution::Aging]).with_stiffness(1e3).run(&record, &load)?;
/// assert!((fit.value(Parameter::SlipDistance(0)) / 1.5e-5 - 1.0).abs() < 1e-6);
/// println!("{fit}");
/// # Ok::<(), stickslip_lab::LabError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Fit<'a> {
    pub(crate) laws: Vec<Evolution<'a>>,
    pub(crate) trend: Option<Trend>,
    pub(crate) free_initial_state: bool,
    pub(crate) step_offset: bool,
    pub(crate) loss: Loss,
    pub(crate) reference_velocity: Option<f64>,
    /// Bounds of parameters; equal bounds fix one.
    pub(crate) bounds: Vec<(Parameter, f64, f64)>,
    pub(crate) guess: Option<Parameters>,
    /// Guesses of single parameters.
    pub(crate) guesses: Vec<(Parameter, f64)>,
    /// Parameters of laws that are fitted.
    pub(crate) freed: Vec<Parameter>,
    pub(crate) interrupt: Option<Interrupt<'a>>,
}

impl<'a> Fit<'a> {
    /// A fit with one or two states, one for each state law. The stiffness is free, the initial state steady.
    pub fn new(laws: &[Evolution<'a>]) -> Self {
        Self {
            laws: laws.to_vec(),
            trend: None,
            free_initial_state: false,
            step_offset: false,
            loss: Loss::Squares,
            reference_velocity: None,
            bounds: Vec::new(),
            guess: None,
            guesses: Vec::new(),
            freed: Vec::new(),
            interrupt: None,
        }
    }

    /// Fixes `K/sigma_n` > 0 [1/m], the stiffness of machine and sample [Pa/m] over the normal stress \[Pa\].
    #[must_use]
    pub fn with_stiffness(self, stiffness: f64) -> Self {
        self.with_fixed(Parameter::Stiffness, stiffness)
    }

    /// Fixes a parameter at a value.
    #[must_use]
    pub fn with_fixed(self, parameter: Parameter, value: f64) -> Self {
        self.with_bounds(parameter, value, value)
    }

    /// Fits a parameter of a state law, too: `Vc` of Kato and Tullis, `c` of Nagata. It is held at the published value else,
    /// unless it has bounds or a guess. Other parameters are fitted anyway.
    ///
    /// ```
    /// use stickslip_lab::{Evolution, Fit, Parameter};
    ///
    /// let fit = Fit::new(&[Evolution::Nagata]).with_free(Parameter::StressWeight(0));
    /// ```
    #[must_use]
    pub fn with_free(mut self, parameter: Parameter) -> Self {
        self.freed.push(parameter);
        self
    }

    /// Keeps a parameter between two values, both included; the last call for a parameter counts.
    #[must_use]
    pub fn with_bounds(mut self, parameter: Parameter, low: f64, high: f64) -> Self {
        self.bounds.retain(|bound| bound.0 != parameter);
        self.bounds.push((parameter, low, high));
        self
    }

    /// Fits a linear trend of friction, too.
    #[must_use]
    #[doc(alias = "detrend")]
    pub fn with_trend(mut self, trend: Trend) -> Self {
        self.trend = Some(trend);
        self
    }

    /// Fits the beginning, too: the states at the first sample, and the shear stress above that at which the block slides with
    /// the load point. Else the block slides steadily with the load point, and a
    /// record that begins in a transient has a [warning](crate::Warning::Transient).
    #[must_use]
    pub fn with_free_initial_state(mut self) -> Self {
        self.free_initial_state = true;
        self
    }

    /// Sets the loss of residuals, by default their squares; that of Huber bounds the influence of spikes.
    #[must_use]
    #[doc(alias = "robust")]
    pub fn with_loss(mut self, loss: Loss) -> Self {
        self.loss = loss;
        self
    }

    /// Fits the time by which all velocity changes are later than the load history says, too: one for the record \[s\].
    ///
    /// Its range is half the shortest time between two changes, or between a change and an end of the record. A trend
    /// keeps the times of the history.
    #[must_use]
    #[doc(alias = "time shift")]
    pub fn with_step_offset(mut self) -> Self {
        self.step_offset = true;
        self
    }

    /// Sets `V0` > 0 [m/s], by default the velocity of the load point at the first sample.
    #[must_use]
    pub fn with_reference_velocity(mut self, velocity: f64) -> Self {
        self.reference_velocity = Some(velocity);
        self
    }

    /// Starts from these parameters alone. Prefer a characteristic slip distance that is too large.
    ///
    /// Their `V0` is that of the fit unless another is set. A stiffness is fitted from here unless it is fixed.
    #[must_use]
    pub fn with_guess(mut self, guess: Parameters) -> Self {
        self.guess = Some(guess);
        self
    }

    /// Starts from this value of one parameter; the starts of the others are computed from the curve. The last call for a
    /// parameter counts, and that of one that is fixed does not. `mu0` and the trend follow from the others.
    ///
    /// ```
    /// use stickslip_lab::{Evolution, Fit, Parameter};
    ///
    /// let fit = Fit::new(&[Evolution::Aging]).with_guess_of(Parameter::SlipDistance(0), 5e-5);
    /// ```
    #[must_use]
    pub fn with_guess_of(mut self, parameter: Parameter, value: f64) -> Self {
        self.guesses.retain(|guess| guess.0 != parameter);
        self.guesses.push((parameter, value));
        self
    }

    /// Ends the fit where it is once a function is true: it is called every few microseconds, inside curves, too. The result is
    /// that of the best parameters so far, and [says so](Fitted::interrupted).
    ///
    /// ```
    /// use std::sync::atomic::{AtomicBool, Ordering};
    /// use stickslip_lab::{Evolution, Fit};
    ///
    /// let pressed = AtomicBool::new(false); // set by a signal or by another thread
    /// let asked = || pressed.load(Ordering::Relaxed);
    /// let fit = Fit::new(&[Evolution::Aging]).with_interrupt(&asked);
    /// ```
    #[must_use]
    #[doc(alias("cancel", "stop", "Ctrl-C"))]
    pub fn with_interrupt(mut self, interrupt: &'a (dyn Fn() -> bool + Sync)) -> Self {
        self.interrupt = Some(Interrupt(interrupt));
        self
    }

    /// Checks the settings, the record and the history, without a fit.
    ///
    /// # Errors
    /// [`LabError::States`], [`LabError::Value`], [`LabError::TooFewSamples`] and [`LabError::NoVelocityStep`] as of
    /// [`run`](Self::run).
    pub fn validate(&self, record: &Record, load: &LoadHistory) -> Result<(), LabError> {
        self.validate_joint(&[Experiment::new(record, load)])
    }

    /// Checks the settings, the records and their histories, without a fit.
    ///
    /// # Errors
    /// Those of [`validate`](Self::validate), in [`LabError::Record`] with the number of one of several records.
    pub fn validate_joint(&self, experiments: &[Experiment<'_>]) -> Result<(), LabError> {
        self.model(experiments).map(|_| ())
    }

    /// Fits the parameters.
    ///
    /// The sum of the weighted squares of the residuals is minimised by the method of Levenberg and Marquardt from the
    /// best of several starts. The derivatives are sensitivities of the curve, integrated with it.
    ///
    /// # Errors
    /// [`LabError::States`], [`LabError::Value`] and [`LabError::TooFewSamples`] for wrong input,
    /// [`LabError::NoVelocityStep`] for a load point that keeps its velocity, [`LabError::NoStart`] if no start has a
    /// stable curve, [`LabError::Unstable`] if a guess has none, [`LabError::NotConverged`], and
    /// [`LabError::Interrupted`] before the first curve. Parameters that the data do not determine are no error: see
    /// [`Fitted::warnings`].
    pub fn run(&self, record: &Record, load: &LoadHistory) -> Result<Fitted, LabError> {
        let mut joint = self.run_joint(&[Experiment::new(record, load)])?;
        joint.records.pop().ok_or(LabError::NoRecord)
    }

    /// Fits several records at once: they share `a`, `b` and `L` of each state and the parameters of state laws. Each has its own
    /// stiffness, `mu0`, trend, step offset and beginning. Bounds and guesses of these are for each record.
    ///
    /// A record counts by its noise, which is estimated from its residuals.
    ///
    /// ```
    /// use stickslip_lab::{Evolution, Experiment, Fit, LoadHistory, Parameters, Record};
    /// # use stickslip_friction::DieterichRuina;
    /// # let friction = DieterichRuina {
    /// #     a: 0.008, b: 0.012, reference_friction: 0.6, reference_velocity: 1e-6, slip_distance: 1.5e-5,
    /// # };
    /// let load = LoadHistory::velocity_steps(&[1e-6, 1e-5], 3e-4)?;
    /// let times = load.samples(200);
    /// // The same rock on two machines.
    /// let on = |stiffness: f64| {
    ///     let machine = Parameters::one_state(&friction, stiffness);
    ///     Record::new(times.clone(), machine.curve(&[Evolution::Aging], &load, &times)?)
    /// };
    /// let (soft, stiff) = (on(1e3)?, on(3e3)?);
    /// let joint = Fit::new(&[Evolution::Aging])
    ///     .run_joint(&[Experiment::new(&soft, &load), Experiment::new(&stiff, &load)])?;
    /// assert!((joint.records[1].parameters.stiffness / 3e3 - 1.0).abs() < 1e-4);
    /// println!("{joint}");
    /// # Ok::<(), stickslip_lab::LabError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`run`](Self::run), in [`LabError::Record`] with the number of one of several records, [`LabError::NoRecord`],
    /// and [`LabError::Shared`] for a shared parameter that is fixed for one record.
    pub fn run_joint(&self, experiments: &[Experiment<'_>]) -> Result<JointFit, LabError> {
        let model = self.model(experiments)?;
        let shown = Shown::new(&model);
        let bounds = self.ranges(&model, &shown.all, &shown.each);
        let course = Course::new(self.interrupt);
        let mut search = Search::new(&model, &bounds, shown.all.direct_effect, course);
        let minimum = match &self.guess {
            Some(guess) => search.from(model.guessed(guess))?,
            None => search.among(&shown)?,
        };
        let (minimum, noise) = search.reweighted(minimum, self.loss)?;
        let model = model.over_noise(&noise);
        let mut search = Search {
            model: &model,
            ..search
        };
        let end = search.end(&minimum, self.loss)?;
        Ok(JointFit::new(&search, self, &minimum, &end))
    }
}
