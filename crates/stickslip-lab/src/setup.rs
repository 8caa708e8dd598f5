//! From the settings of a fit and its records to the model.

use crate::error::LabError;
use crate::experiment::Experiment;
use crate::fit::Fit;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::{Parameters, StateParameters};
use crate::part::Part;
use crate::point::Point;

impl Fit<'_> {
    /// The model of experiments, after checks of all input.
    ///
    /// # Errors
    /// [`LabError::Record`] for one of several records, with its number.
    pub(crate) fn model<'m>(
        &'m self,
        experiments: &[Experiment<'m>],
    ) -> Result<Model<'m>, LabError> {
        self.check_settings()?;
        let Some(first) = experiments.first() else {
            return Err(LabError::NoRecord);
        };
        let v0 = self.velocity(first);
        let mut parts = Vec::with_capacity(experiments.len());
        for (position, experiment) in experiments.iter().enumerate() {
            let part = self.part(experiment, v0, experiments.len() > 1);
            parts.push(part.map_err(|cause| {
                if experiments.len() == 1 {
                    return cause;
                }
                LabError::Record {
                    number: position + 1,
                    cause: Box::new(cause),
                }
            })?);
        }
        let model = Model::new(parts);
        let (samples, parameters) = (model.samples(), model.free.len());
        let requirement = "at least 1: Parameters::curve evaluates those that are known";
        let what = "number of free parameters";
        LabError::check(what, requirement, 0, parameters as f64, parameters > 0)?;
        if samples <= parameters {
            return Err(LabError::TooFewSamples {
                samples,
                parameters,
            });
        }
        Ok(model)
    }

    /// `V0`: that which is set, that of a guess, or the first velocity of the first record.
    fn velocity(&self, first: &Experiment<'_>) -> f64 {
        let guessed = self.guess.as_ref().map(|guess| guess.reference_velocity);
        let times = first.record.times();
        let start = || {
            let offset = self.fixed_of(first, Parameter::StepOffset).unwrap_or(0.0);
            let time = times.first().map_or(0.0, |time| time - offset);
            first.load.velocity_before(time)
        };
        self.reference_velocity.or(guessed).unwrap_or_else(start)
    }

    /// The value at which a parameter of a record is fixed.
    fn fixed_of(&self, experiment: &Experiment<'_>, parameter: Parameter) -> Option<f64> {
        let own = experiment.fixed.iter().find(|fixed| fixed.0 == parameter);
        let bound = self.bounds.iter();
        let mut bound = bound.filter(|bound| bound.0 == parameter && bound.1 == bound.2);
        own.map(|fixed| fixed.1)
            .or_else(|| bound.next().map(|bound| bound.1))
    }

    /// The parameters that are fitted to a record, shared ones first.
    fn free(&self, experiment: &Experiment<'_>) -> Vec<Parameter> {
        let states = self.laws.len();
        let mut free = vec![Parameter::A];
        free.extend((0..states).map(Parameter::B));
        free.extend((0..states).map(Parameter::SlipDistance));
        free.extend(self.law_parameters());
        free.push(Parameter::Stiffness);
        if self.free_initial_state {
            free.extend((0..states).map(Parameter::InitialState));
            free.push(Parameter::InitialStress);
        }
        free.push(Parameter::ReferenceFriction);
        if self.trend.is_some() {
            free.push(Parameter::Trend);
        }
        if self.step_offset {
            free.push(Parameter::StepOffset);
        }
        free.retain(|&parameter| self.fixed_of(experiment, parameter).is_none());
        free
    }

    /// The parameters of laws that are fitted: those that are freed, bounded or guessed.
    fn law_parameters(&self) -> impl Iterator<Item = Parameter> {
        let all = self.laws.iter().enumerate();
        let all = all.filter_map(|(i, law)| law.parameter(i));
        all.filter(|parameter| {
            self.freed.contains(parameter)
                || self.bounds.iter().any(|bound| bound.0 == *parameter)
                || self.guesses.iter().any(|guess| guess.0 == *parameter)
        })
    }

    /// One record; of several ones the samples must determine its own parameters alone.
    fn part<'m>(
        &'m self,
        experiment: &Experiment<'m>,
        v0: f64,
        several: bool,
    ) -> Result<Part<'m>, LabError> {
        let states = self.laws.len();
        let free = self.free(experiment);
        let own = |parameter: &&Parameter| !(several && parameter.is_shared());
        let offset = self.fixed_of(experiment, Parameter::StepOffset);
        self.check_record(
            experiment,
            free.iter().filter(own).count(),
            offset.unwrap_or(0.0),
        )?;
        let mut fixed = Point::new(self.guess.clone().unwrap_or_else(|| Parameters {
            a: 1.0,
            states: vec![StateParameters::steady(0.0, 1.0); states],
            reference_friction: 0.0,
            reference_velocity: v0,
            stiffness: 1.0,
            trend: 0.0,
        }));
        fixed.parameters.reference_velocity = v0;
        for &(parameter, low, high) in &self.bounds {
            if low == high {
                fixed.set(parameter, low);
            }
        }
        for &(parameter, value) in &experiment.fixed {
            fixed.set(parameter, value);
        }
        fixed.parameters.validate()?;
        let (record, load) = (experiment.record, experiment.load);
        let trend = match self.trend {
            Some(trend) => trend.basis(load, record.times()),
            None => vec![0.0; record.times().len()],
        };
        Ok(Part {
            laws: &self.laws,
            load,
            record,
            fixed,
            free,
            places: Vec::new(),
            trend,
            guesses: &self.guesses,
            noise: 1.0,
            roots: record
                .weights()
                .iter()
                .map(|weight| weight.sqrt())
                .collect(),
        })
    }
}
