//! Whether parameters that are not fitted would lower the sum of squares: score tests.

use crate::curve::Work;
use crate::least_squares::{Minimum, Normal};
use crate::model::Model;
use crate::parameters::Parameter;
use crate::search::FINE;

/// What a fit would gain by further parameters, in the linear approximation at its minimum.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Score {
    /// By how much Akaike's information criterion would fall.
    pub(crate) evidence: f64,
    /// The value and the standard error of each further parameter.
    pub(crate) estimates: Vec<(f64, f64)>,
}

/// The score tests of a fit; none where the data have no noise, or the parameters are given.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Tests {
    pub(crate) step_offset: Option<Score>,
}

impl Model<'_> {
    /// The score tests at a minimum; samples count as `samples` independent ones.
    pub(crate) fn tests(
        &self,
        minimum: &Minimum,
        bounds: &[(f64, f64)],
        samples: f64,
        work: &mut Work,
    ) -> Tests {
        let given = self.fixed.step_offset != 0.0;
        let step_offset = (!given)
            .then(|| self.score(minimum, bounds, &[Parameter::StepOffset], samples, work))
            .flatten();
        Tests { step_offset }
    }

    /// The score test of further parameters at a minimum of this model, whose samples count as `samples` independent ones;
    /// `None` for parameters that are fitted, and where there is no curve. Source: C. R. Rao, "Large sample tests of
    /// statistical hypotheses concerning several parameters", Math. Proc. Camb. Phil. Soc. 44 (1948).
    pub(crate) fn score(
        &self,
        minimum: &Minimum,
        bounds: &[(f64, f64)],
        further: &[Parameter],
        samples: f64,
        work: &mut Work,
    ) -> Option<Score> {
        if further
            .iter()
            .any(|parameter| self.free.contains(parameter))
        {
            return None;
        }
        let mut values = minimum.parameters.clone();
        values.extend(further.iter().map(|&parameter| self.fixed.value(parameter)));
        let extended = Model {
            free: [&self.free, further].concat(),
            fixed: self.fixed.clone(),
            trend: self.trend.clone(),
            ..*self
        };
        let linearised = extended.linearised(&values, FINE, work).ok()?;
        let squares = linearised.0.norm_squared();
        // Parameters at a bound stay there.
        let inside = minimum.parameters.iter().zip(bounds);
        let mut free: Vec<bool> = inside
            .map(|(value, &(low, high))| *value > low && *value < high)
            .collect();
        free.resize(values.len(), true);
        let normal = Normal::new(&linearised).with(&free);
        let left = squares - normal.removable();
        let step = normal.to_minimum();
        let inverse = normal.inverse();
        let fitted = step.len() - further.len();
        let variance = left / (samples - step.len() as f64);
        let estimates = (0..further.len()).map(|k| {
            let place = fitted + k;
            let value = values[self.free.len() + k] + step[place];
            (value, (variance * inverse[(place, place)]).sqrt())
        });
        Some(Score {
            evidence: samples * (squares / left).ln() - 2.0 * further.len() as f64,
            estimates: estimates.collect(),
        })
    }
}
