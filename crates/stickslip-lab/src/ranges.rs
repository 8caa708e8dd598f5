//! The bounds of fitted parameters.

use crate::features::Features;
use crate::fit::Fit;
use crate::model::Model;
use crate::parameter::Parameter;

/// The range of `L` beside the distance of samples and the longest piece: a state that adapts within a tenth of a sample
/// is always steady, and over a tenth of `L` it changes linearly. And that of `a` and `k` about what the curve shows, of `Vc`
/// beside the slip rates, and of `c` about 1.
const DISTANCES: f64 = 10.0;
const RANGE: f64 = 100.0;

impl Fit<'_> {
    /// The bounds of the fitted parameters: those of the caller, else the range in which the curves can resolve them. Shared
    /// parameters are seen in all records, others in their own.
    pub(crate) fn ranges(
        &self,
        model: &Model<'_>,
        all: &Features,
        each: &[Features],
    ) -> Vec<(f64, f64)> {
        let free = model.free.iter();
        let range = free.map(|free| {
            let features = free.part.map_or(all, |part| &each[part]);
            let given = self.bounds.iter().find(|bound| bound.0 == free.parameter);
            let (low, high) = match (given, free.parameter) {
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
                    let part = &model.parts[free.part.unwrap_or(0)];
                    let shortest = part.shortest_phase();
                    (-0.5 * shortest, 0.5 * shortest)
                }
                (None, _) => (f64::NEG_INFINITY, f64::INFINITY),
            };
            if free.parameter.is_logarithmic() {
                (low.ln(), high.ln())
            } else {
                (low, high)
            }
        });
        range.collect()
    }
}
