//! Whether a record begins in a transient that is far from steady sliding.

use nalgebra::DVector;

use crate::doubts::EVIDENCE;
use crate::least_squares::{Minimum, Stop};
use crate::loss::Scale;
use crate::parameter::Parameter;
use crate::score::{Score, Tests, evidence};
use crate::search::{COARSE, DAMPING, ROUGH, ROUGH_STEPS, Search};
use crate::spread::Residuals;

impl Search<'_> {
    /// The test of a free beginning of a record by an iteration, where the linear approximation has no evidence, and the
    /// residuals are correlated or the first one exceeds two standard deviations: a load that rises behind a hold is far from
    /// steady sliding. It starts with the stress of the first sample.
    pub(crate) fn test_beginning(
        &mut self,
        number: usize,
        minimum: &Minimum,
        residual: &DVector<f64>,
        (statistics, scale): (&Residuals, Scale),
        tests: &mut Tests,
    ) {
        let (part, rows) = (&self.model.parts[number], &self.model.rows()[number]);
        let own = residual.rows(rows.start, rows.len());
        let first = part.roots.iter().position(|root| *root > 0.0);
        let doubtful =
            |first: &usize| statistics.correlated || own[*first].abs() > 2.0 * statistics.deviation;
        let known = |score: &Score| score.evidence > EVIDENCE;
        let (Some(first), false) = (
            first.filter(doubtful),
            tests.initial.as_ref().is_none_or(known),
        ) else {
            return;
        };
        let [_, beginning] = part.further();
        let mut values = minimum.parameters.clone();
        values.extend(beginning.iter().map(|parameter| match parameter {
            Parameter::InitialStress => -own[first] / part.roots[first],
            _ => 0.0,
        }));
        let mut bounds = self.bounds.to_vec();
        bounds.resize(values.len(), (f64::NEG_INFINITY, f64::INFINITY));
        let mut further = vec![Vec::new(); self.model.parts.len()];
        further[number].clone_from(&beginning);
        let extended = self.model.with(&further);
        let mut search = Search::new(&extended, &bounds, self.scale, self.course);
        let stop = Stop {
            offset: ROUGH,
            change: COARSE * self.scale,
            steps: ROUGH_STEPS,
            damping: DAMPING,
        };
        let end = search.descend(values, COARSE, stop);
        self.course.rejoin(&search.course);
        if let Ok(end) = end {
            let slopes = |residual: &DVector<f64>| residual.map(|r| scale.slope(r));
            let (before, behind) = (slopes(residual), slopes(&end.residual));
            let weighted = self.model.weighted();
            tests.initial = Some(Score {
                evidence: evidence(&before, &behind, beginning.len(), &weighted).0,
                estimates: Vec::new(),
            });
        }
    }
}
