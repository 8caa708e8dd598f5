//! Checks of the settings of a fit, and of its records.

use crate::error::LabError;
use crate::experiment::Experiment;
use crate::fit::Fit;
use crate::parameter::Parameter;

/// The requirement of the value of a parameter.
const LEGAL: &str = "finite, and positive for a, L, k, Vc and c";

impl Fit<'_> {
    /// Requires one or two state laws, and legal values of parameters of these.
    pub(crate) fn check_settings(&self) -> Result<(), LabError> {
        let states = self.laws.len();
        if !(1..=2).contains(&states) {
            return Err(LabError::States {
                expected: "1 or 2",
                found: states,
            });
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
            let what = "lower bound of a parameter";
            LabError::check(what, requirement, 0, low, legal && exact)?;
            parameter.check(&self.laws)?;
        }
        for (position, &(parameter, value)) in self.guesses.iter().enumerate() {
            parameter.check(&self.laws)?;
            let what = "guess of a parameter";
            LabError::check(what, LEGAL, position, value, is_legal(parameter, value))?;
        }
        if let Some(guess) = &self.guess
            && guess.states.len() != states
        {
            return Err(LabError::States {
                expected: "as many as there are state laws",
                found: guess.states.len(),
            });
        }
        Ok(())
    }

    /// Requires samples, a load point that moves at first and changes its velocity, and friction that is not constant; the
    /// steps come later by an offset \[s\].
    pub(crate) fn check_record(
        &self,
        experiment: &Experiment<'_>,
        parameters: usize,
        offset: f64,
    ) -> Result<(), LabError> {
        let (record, load) = (experiment.record, experiment.load);
        for (position, &(parameter, value)) in experiment.fixed.iter().enumerate() {
            if parameter.is_shared() {
                return Err(LabError::Shared { parameter });
            }
            parameter.check(&self.laws)?;
            let what = "fixed parameter of a record";
            LabError::check(what, LEGAL, position, value, is_legal(parameter, value))?;
        }
        let (times, samples) = (record.times(), record.weighted());
        let few = LabError::TooFewSamples {
            samples,
            parameters,
        };
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(few);
        };
        if samples <= parameters {
            return Err(few);
        }
        let (first, last) = (first - offset, last - offset);
        let velocity = load.velocity_before(first);
        LabError::check(
            "velocity of the load point at the first sample [m/s]",
            "positive: a record or window must begin while the load point moves",
            0,
            velocity,
            load.phases(first, last)[0].velocity > 0.0,
        )?;
        let mut changes = load.changes(first, last);
        if changes.all(|(_, other)| other == velocity) {
            return Err(LabError::NoVelocityStep { velocity });
        }
        let constant = record.friction().windows(2).all(|pair| pair[0] == pair[1]);
        let (what, requirement) = ("friction coefficient", "another one in some samples");
        LabError::check(what, requirement, 0, record.friction()[0], !constant)
    }
}

fn is_legal(parameter: Parameter, value: f64) -> bool {
    value.is_finite() && (value > 0.0 || !parameter.is_logarithmic())
}
