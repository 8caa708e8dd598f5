//! The fit of a record.

use crate::curve::Work;
use crate::error::{LabError, require};
use crate::evolution::Evolution;
use crate::fitted::Fitted;
use crate::least_squares::{Minimum, Stop, minimize};
use crate::load::LoadHistory;
use crate::model::{Model, Trend};
use crate::parameters::{Parameter, Parameters, StateParameters};
use crate::record::Record;
use crate::start::Features;

/// The local error of a step in `ln V` and each `ln theta`, and the end of iterations, in the choice among starts and
/// in the end.
const COARSE: f64 = 1e-4;
const FINE: f64 = 1e-8;
/// The largest relative offset at convergence, by the rule of Bates and Watts, and that at which the iteration ends.
const CONVERGED: f64 = 1e-3;
const OFFSET: f64 = 1e-6;
/// The relative offset and the number of steps at which an iteration from one of several starts is interrupted.
const ROUGH: f64 = 0.03;
const ROUGH_STEPS: usize = 20;
const MAX_STEPS: usize = 100;
/// The range of `a`, `L` and `k` about what the curve resolves: a value beyond it has no influence.
const RANGE: f64 = 1e3;

/// A least-squares fit of friction to the record of an experiment.
///
/// Fitted are `a`, `b` and `L` of each state, `mu0`, the stiffness unless it is fixed, and on demand a trend and the
/// initial states. The starts are computed from the curve.
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
    laws: Vec<Evolution<'a>>,
    trend: Option<Trend>,
    free_initial_state: bool,
    reference_velocity: Option<f64>,
    bounds: Vec<(Parameter, f64, f64)>,
    guess: Option<Parameters>,
}

impl<'a> Fit<'a> {
    /// A fit with one or two states, one for each state law. The stiffness is free, the initial state steady.
    pub fn new(laws: &[Evolution<'a>]) -> Self {
        Self {
            laws: laws.to_vec(),
            trend: None,
            free_initial_state: false,
            reference_velocity: None,
            bounds: Vec::new(),
            guess: None,
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

    /// Fits the state at the first sample, where the slip rate is that of the load point; else it is steady.
    #[must_use]
    pub fn with_free_initial_state(mut self) -> Self {
        self.free_initial_state = true;
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
        let v0 = model.fixed.reference_velocity;
        let features = Features::new(record, load, v0, &model.trend);
        let bounds = self.ranges(&model, &features);
        let mut work = Work::default();
        let mut steps = 0;
        let mut descend = |start: Vec<f64>, tolerance: f64, stop: Stop, work: &mut Work| {
            let minimum = minimize(start, &bounds, stop, |values| {
                model.linearised(values, tolerance, work)
            });
            if let Ok(minimum) = &minimum {
                steps += minimum.steps;
            }
            minimum
        };
        let change = |tolerance: f64| tolerance * features.direct_effect;
        let start = match &self.guess {
            Some(guess) => model.values(guess),
            None => {
                let count = if self.laws.len() == 1 { 3 } else { 5 };
                let (starts, tried) = features.starts(&model, &bounds, count, &mut work);
                let stop = Stop {
                    offset: ROUGH,
                    change: change(COARSE),
                    steps: ROUGH_STEPS,
                };
                let ends = starts
                    .into_iter()
                    .filter_map(|start| descend(start, COARSE, stop, &mut work).ok());
                let squares = |end: &Minimum| end.residual.norm_squared();
                let best = ends.min_by(|one, two| squares(one).total_cmp(&squares(two)));
                best.ok_or(LabError::NoStart { starts: tried })?.parameters
            }
        };
        let stop = Stop {
            offset: OFFSET,
            change: change(FINE),
            steps: MAX_STEPS,
        };
        let minimum = descend(start, FINE, stop, &mut work)?;
        if minimum.offset > CONVERGED && !minimum.exact {
            return Err(LabError::NotConverged {
                steps: minimum.steps,
                offset: minimum.offset,
            });
        }
        Ok(Fitted::new(
            &model, self.trend, &bounds, minimum, steps, work,
        ))
    }

    /// The model of the experiment, after checks of all input.
    fn model<'m>(
        &'m self,
        record: &'m Record,
        load: &'m LoadHistory,
    ) -> Result<Model<'m>, LabError> {
        let states = self.laws.len();
        if !(1..=2).contains(&states) {
            return Err(LabError::States {
                expected: "1 or 2",
                found: states,
            });
        }
        let mut free = vec![Parameter::A];
        free.extend((0..states).map(Parameter::B));
        free.extend((0..states).map(Parameter::SlipDistance));
        free.push(Parameter::Stiffness);
        if self.free_initial_state {
            free.extend((0..states).map(Parameter::InitialState));
        }
        free.push(Parameter::ReferenceFriction);
        if self.trend.is_some() {
            free.push(Parameter::Trend);
        }
        for &(parameter, low, high) in &self.bounds {
            let floor = if parameter.is_logarithmic() {
                0.0
            } else {
                f64::NEG_INFINITY
            };
            let legal = low >= floor && low <= high && high > floor && low < f64::INFINITY;
            let exact = low < high || (low > floor && low.is_finite());
            let requirement = "in order, and positive for a, L and k";
            require(
                "lower bound of a parameter",
                requirement,
                0,
                low,
                legal && exact,
            )?;
            if let Parameter::B(i) | Parameter::SlipDistance(i) | Parameter::InitialState(i) =
                parameter
                && i >= states
            {
                return Err(LabError::States {
                    expected: "as many as there are state laws",
                    found: i + 1,
                });
            }
        }
        let fixed = |parameter: &Parameter| {
            self.bounds
                .iter()
                .any(|(other, low, high)| other == parameter && low == high)
        };
        free.retain(|parameter| !fixed(parameter));
        let times = record.times();
        let samples = record.weighted();
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(LabError::TooFewSamples {
                samples,
                parameters: free.len(),
            });
        };
        if samples <= free.len() {
            return Err(LabError::TooFewSamples {
                samples,
                parameters: free.len(),
            });
        }
        let velocity = load.velocity_before(first);
        let requirement = "positive: a record or window must begin while the load point moves";
        require(
            "velocity of the load point at the first sample [m/s]",
            requirement,
            0,
            velocity,
            velocity > 0.0,
        )?;
        if load
            .changes(first, last)
            .all(|(_, other)| other == velocity)
        {
            return Err(LabError::NoVelocityStep { velocity });
        }
        let guessed = self.guess.as_ref().map(|guess| guess.reference_velocity);
        let v0 = self.reference_velocity.or(guessed).unwrap_or(velocity);
        let mut parameters = self.guess.clone().unwrap_or_else(|| Parameters {
            a: 1.0,
            states: vec![StateParameters::steady(0.0, 1.0); states],
            reference_friction: 0.0,
            reference_velocity: v0,
            stiffness: 1.0,
            trend: 0.0,
        });
        parameters.reference_velocity = v0;
        if parameters.states.len() != states {
            return Err(LabError::States {
                expected: "as many as there are state laws",
                found: parameters.states.len(),
            });
        }
        for &(parameter, low, high) in &self.bounds {
            if low == high {
                parameter.set(&mut parameters, low);
            }
        }
        parameters.validate()?;
        let trend = match self.trend {
            Some(trend) => trend.basis(load, times),
            None => vec![0.0; times.len()],
        };
        Ok(Model {
            laws: &self.laws,
            load,
            record,
            fixed: parameters,
            free,
            trend,
        })
    }

    /// The bounds of the fitted parameters: those of the caller, else the range in which the curve can resolve them.
    fn ranges(&self, model: &Model<'_>, features: &Features) -> Vec<(f64, f64)> {
        let range = |parameter: &Parameter| {
            let given = self.bounds.iter().find(|bound| bound.0 == *parameter);
            let (low, high) = match (given, parameter) {
                (Some(&(_, low, high)), _) => (low, high),
                (None, Parameter::A) => (
                    features.direct_effect / RANGE,
                    features.direct_effect * RANGE,
                ),
                (None, Parameter::SlipDistance(_)) => {
                    (features.distances.0 / RANGE, features.distances.1 * RANGE)
                }
                (None, Parameter::Stiffness) => {
                    (features.stiffness / RANGE, features.stiffness * RANGE)
                }
                (None, _) => (f64::NEG_INFINITY, f64::INFINITY),
            };
            if parameter.is_logarithmic() {
                (low.ln(), high.ln())
            } else {
                (low, high)
            }
        };
        model.free.iter().map(range).collect()
    }
}
