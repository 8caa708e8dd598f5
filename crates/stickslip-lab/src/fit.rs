//! The fit of a record.

use crate::error::LabError;
use crate::evolution::Evolution;
use crate::features::Features;
use crate::fitted::Fitted;
use crate::load::LoadHistory;
use crate::loss::Loss;
use crate::model::Trend;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::point::Point;
use crate::record::Record;
use crate::search::Search;

/// A least-squares fit of friction to the record of an experiment.
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

    /// Checks the settings, the record and the history, without a fit.
    ///
    /// # Errors
    /// [`LabError::States`], [`LabError::Value`], [`LabError::TooFewSamples`] and [`LabError::NoVelocityStep`] as of
    /// [`run`](Self::run).
    pub fn validate(&self, record: &Record, load: &LoadHistory) -> Result<(), LabError> {
        self.model(record, load).map(|_| ())
    }

    /// Fits the parameters.
    ///
    /// The sum of the weighted squares of the residuals is minimised by the method of Levenberg and Marquardt from the
    /// best of several starts. The derivatives are sensitivities of the curve, integrated with it.
    ///
    /// # Errors
    /// [`LabError::States`], [`LabError::Value`] and [`LabError::TooFewSamples`] for wrong input,
    /// [`LabError::NoVelocityStep`] for a load point that keeps its velocity, [`LabError::NoStart`] if no start has a
    /// stable curve, [`LabError::Unstable`] if a guess has none, and [`LabError::NotConverged`]. Parameters that the
    /// data do not determine are no error: see [`Fitted::warnings`].
    pub fn run(&self, record: &Record, load: &LoadHistory) -> Result<Fitted, LabError> {
        let model = self.model(record, load)?;
        let v0 = model.fixed.parameters.reference_velocity;
        let known = model.known(Parameter::Stiffness);
        let features = Features::new(record, load, v0, &model.trend, known);
        let bounds = self.ranges(&model, &features);
        let mut search = Search::new(&model, &bounds, features.direct_effect);
        let mut minimum = match &self.guess {
            Some(guess) => {
                let mut start = Point::new(guess.clone());
                for &(parameter, value) in model.guesses {
                    start.set(parameter, value);
                }
                search.from(model.values(&start))?
            }
            None => search.among(&features)?,
        };
        if self.loss == Loss::Huber {
            minimum = search.robust(minimum)?;
        }
        let end = search.end(&minimum, self.loss)?;
        Ok(Fitted::new(&search, self, minimum, end))
    }
}
