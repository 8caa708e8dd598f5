//! Whether a record begins in a transient that is far from steady sliding.

use crate::doubts::EVIDENCE;
use crate::least_squares::{Minimum, Stop};
use crate::loss::Scale;
use crate::normal::Linearised;
use crate::parameter::Parameter;
use crate::score::{Score, Tests, evidence};
use crate::search::{COARSE, DAMPING, ROUGH, ROUGH_STEPS, Search};
use crate::spread::Spread;

impl Search<'_> {
    /// The test of a free beginning by an iteration, where the linear approximation has no evidence, and the residuals are
    /// correlated or the first one exceeds two standard deviations: a load that rises behind a hold is far from steady
    /// sliding. It starts with the stress of the first sample.
    pub(crate) fn test_beginning(
        &mut self,
        minimum: &Minimum,
        (residual, _): &Linearised,
        spread: &Spread,
        scale: Scale,
        tests: &mut Tests,
    ) {
        let weighted = self.model.weighted();
        let first = weighted.iter().position(|weighted| *weighted);
        let doubtful =
            |first: &usize| spread.correlated || residual[*first].abs() > 2.0 * spread.deviation;
        let known = |score: &Score| score.evidence > EVIDENCE;
        let (Some(first), false) = (
            first.filter(doubtful),
            tests.initial.as_ref().is_none_or(known),
        ) else {
            return;
        };
        let model = self.model;
        let [_, beginning] = model.further();
        let mut values = minimum.parameters.clone();
        values.extend(beginning.iter().map(|parameter| match parameter {
            Parameter::InitialStress => -residual[first] / model.roots[first],
            _ => 0.0,
        }));
        let mut bounds = self.bounds.to_vec();
        bounds.resize(values.len(), (f64::NEG_INFINITY, f64::INFINITY));
        let extended = model.with(&[Vec::new(), beginning.clone()]);
        let mut search = Search::new(&extended, &bounds, self.scale);
        let stop = Stop {
            offset: ROUGH,
            change: COARSE * self.scale,
            steps: ROUGH_STEPS,
            damping: DAMPING,
        };
        let end = search.descend(values, COARSE, stop);
        self.work.integrations += search.work.integrations;
        self.work.steps += search.work.steps;
        if let Ok(end) = end {
            let slopes = |residual: &nalgebra::DVector<f64>| residual.map(|r| scale.slope(r));
            tests.initial = Some(Score {
                evidence: evidence(
                    &slopes(residual),
                    &slopes(&end.residual),
                    beginning.len(),
                    &weighted,
                )
                .0,
                estimates: Vec::new(),
            });
        }
    }
}
