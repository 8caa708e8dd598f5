//! From the settings of a fit to its model: checks of all input, and bounds.

use crate::error::LabError;
use crate::features::Features;
use crate::fit::Fit;
use crate::load::LoadHistory;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::{Parameters, StateParameters};
use crate::point::Point;
use crate::record::Record;

/// The range of `L` beside the distance of samples and the longest piece: a state that adapts within a tenth of a sample
/// is always steady, and over a tenth of `L` it changes linearly. And that of `a` and `k` about what the curve shows, of `Vc`
/// beside the slip rates, and of `c` about 1.
const DISTANCES: f64 = 10.0;
const RANGE: f64 = 100.0;

impl Fit<'_> {
    /// The model of the experiment, after checks of all input.
    pub(crate) fn model<'m>(
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
        free.extend(self.law_parameters());
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
        for parameter in &self.freed {
            parameter.check(&self.laws)?;
        }
        for &(parameter, low, high) in &self.bounds {
            let floor = if parameter.is_logarithmic() {
                0.0
            } else {
                f64::NEG_INFINITY
            };
            let legal = low >= floor && low <= high && high > floor && low < f64::INFINITY;
            let exact = low < high || (low > floor && low.is_finite());
            let requirement = "in order, and positive for a, L, k, Vc and c";
            LabError::check(
                "lower bound of a parameter",
                requirement,
                0,
                low,
                legal && exact,
            )?;
            parameter.check(&self.laws)?;
        }
        for (position, &(parameter, value)) in self.guesses.iter().enumerate() {
            parameter.check(&self.laws)?;
            let legal = value.is_finite() && (value > 0.0 || !parameter.is_logarithmic());
            let (what, requirement) = (
                "guess of a parameter",
                "finite, and positive for a, L, k, Vc and c",
            );
            LabError::check(what, requirement, position, value, legal)?;
        }
        let is_fixed = |parameter: &Parameter| {
            self.bounds
                .iter()
                .any(|(other, low, high)| other == parameter && low == high)
        };
        free.retain(|parameter| !is_fixed(parameter));
        let requirement = "at least 1: Parameters::curve evaluates those that are known";
        let (what, count) = ("number of free parameters", free.len());
        LabError::check(what, requirement, 0, count as f64, count > 0)?;
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
        // The steps come later by an offset that is known.
        let known =
            |bound: &&(Parameter, f64, f64)| bound.0 == Parameter::StepOffset && bound.1 == bound.2;
        let offset = self.bounds.iter().find(known).map_or(0.0, |bound| bound.1);
        let (first, last) = (first - offset, last - offset);
        let velocity = load.velocity_before(first);
        let requirement = "positive: a record or window must begin while the load point moves";
        LabError::check(
            "velocity of the load point at the first sample [m/s]",
            requirement,
            0,
            velocity,
            load.phases(first, last)[0].velocity > 0.0,
        )?;
        if load
            .changes(first, last)
            .all(|(_, other)| other == velocity)
        {
            return Err(LabError::NoVelocityStep { velocity });
        }
        let constant = record.friction().windows(2).all(|pair| pair[0] == pair[1]);
        let (what, requirement) = ("friction coefficient", "another one in some samples");
        LabError::check(what, requirement, 0, record.friction()[0], !constant)?;
        let guessed = self.guess.as_ref().map(|guess| guess.reference_velocity);
        let v0 = self.reference_velocity.or(guessed).unwrap_or(velocity);
        let mut fixed = Point::new(self.guess.clone().unwrap_or_else(|| Parameters {
            a: 1.0,
            states: vec![StateParameters::steady(0.0, 1.0); states],
            reference_friction: 0.0,
            reference_velocity: v0,
            stiffness: 1.0,
            trend: 0.0,
        }));
        fixed.parameters.reference_velocity = v0;
        if fixed.parameters.states.len() != states {
            return Err(LabError::States {
                expected: "as many as there are state laws",
                found: fixed.parameters.states.len(),
            });
        }
        for &(parameter, low, high) in &self.bounds {
            if low == high {
                fixed.set(parameter, low);
            }
        }
        fixed.parameters.validate()?;
        let trend = match self.trend {
            Some(trend) => trend.basis(load, times),
            None => vec![0.0; times.len()],
        };
        Ok(Model {
            laws: &self.laws,
            load,
            record,
            fixed,
            free,
            trend,
            guesses: &self.guesses,
            roots: record
                .weights()
                .iter()
                .map(|weight| weight.sqrt())
                .collect(),
        })
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

    /// The bounds of the fitted parameters: those of the caller, else the range in which the curve can resolve them.
    pub(crate) fn ranges(&self, model: &Model<'_>, features: &Features) -> Vec<(f64, f64)> {
        let range = |parameter: &Parameter| {
            let given = self.bounds.iter().find(|bound| bound.0 == *parameter);
            let (low, high) = match (given, parameter) {
                (Some(&(_, low, high)), _) => (low, high),
                (None, Parameter::A) => (
                    features.direct_effect / RANGE,
                    features.direct_effect * RANGE,
                ),
                (None, Parameter::SlipDistance(_)) => (
                    features.distances.0 / DISTANCES,
                    features.distances.1 * DISTANCES,
                ),
                (None, Parameter::Stiffness) => {
                    (features.stiffness / RANGE, features.stiffness * RANGE)
                }
                (None, Parameter::AgingVelocity(_)) => {
                    (features.rates.0 / RANGE, features.rates.1 * RANGE)
                }
                (None, Parameter::StressWeight(_)) => (RANGE.recip(), RANGE),
                (None, Parameter::StepOffset) => {
                    let shortest = model.shortest_phase();
                    (-0.5 * shortest, 0.5 * shortest)
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
