//! Whether parameters that are not fitted would lower the sum of squares: score tests.

use nalgebra::DVector;

use crate::normal::{Linearised, Normal};
use crate::parameter::Parameter;
use crate::part::Part;
use crate::spread::{independent, neighbours};

/// The gain of a fit by further parameters, in the linear approximation at its minimum.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Score {
    /// The fall of Akaike's information criterion.
    pub(crate) evidence: f64,
    /// The value and the standard error of each further parameter.
    pub(crate) estimates: Vec<(f64, f64)>,
}

/// The score tests of a fit; none where the data have no noise, or the parameters are fitted or given.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Tests {
    pub(crate) step_offset: Option<Score>,
    /// The initial stress and the initial states.
    pub(crate) initial: Option<Score>,
}

impl Part<'_> {
    /// The parameters that are tested: those of the steps, and those of the beginning.
    pub(crate) fn further(&self) -> [Vec<Parameter>; 2] {
        let states = (0..self.laws.len()).map(Parameter::InitialState);
        let initial = std::iter::once(Parameter::InitialStress).chain(states);
        [vec![Parameter::StepOffset], initial.collect()].map(|further: Vec<Parameter>| {
            let known = |parameter: &Parameter| {
                self.free.contains(parameter) || self.fixed.value(*parameter) != 0.0
            };
            if further.iter().any(known) {
                Vec::new()
            } else {
                further
            }
        })
    }
}

impl Tests {
    /// The tests of further parameters of each record, whose derivatives follow those of the fitted ones, record by record; of
    /// these the ones `inside` their bounds would move. Samples without weight do not count.
    pub(crate) fn of_each(
        linearised: &Linearised,
        inside: &[bool],
        further: &[[Vec<Parameter>; 2]],
        weighted: &[bool],
    ) -> Vec<Self> {
        let normal = Normal::new(linearised);
        let all: usize = further.iter().flatten().map(Vec::len).sum();
        let mut skip = 0;
        let mut next = |count: usize| {
            let tested = skip..skip + count;
            skip += count;
            let mut free = inside.to_vec();
            free.extend((0..all).map(|k| tested.contains(&k)));
            (count > 0).then(|| Score::new(linearised, &normal, &free, count, weighted))
        };
        let records = further.iter().map(|[steps, beginning]| Self {
            step_offset: next(steps.len()),
            initial: next(beginning.len()),
        });
        records.collect()
    }
}

impl Score {
    /// The test of the last `count` of the parameters that are `free`, of which the others are at their minimum. Samples count as many
    /// independent ones as the residuals that are left say: those of the fit are correlated by what is tested. Source: C. R.
    /// Rao, "Large sample tests of statistical hypotheses concerning several parameters", Math. Proc. Camb. Phil. Soc. 44
    /// (1948).
    fn new(
        (residual, jacobian): &Linearised,
        normal: &Normal,
        free: &[bool],
        count: usize,
        weighted: &[bool],
    ) -> Self {
        let normal = normal.with(free);
        let (step, inverse) = (normal.to_minimum(), normal.inverse());
        let mut rest = residual.clone();
        let columns = (0..free.len()).filter(|&k| free[k]);
        for (k, by) in columns.zip(&step) {
            rest.axpy(*by, &jacobian.column(k), 1.0);
        }
        let (evidence, samples) = evidence(residual, &rest, count, weighted);
        let variance = rest.norm_squared() / (samples - step.len() as f64);
        let last = step.len() - count..step.len();
        Self {
            evidence,
            estimates: last
                .map(|k| (step[k], (variance * inverse[(k, k)]).sqrt()))
                .collect(),
        }
    }
}

/// By how much Akaike's information criterion falls with `count` further parameters, which leave the residuals `rest`, and the
/// number of independent samples by these.
pub(crate) fn evidence(
    residual: &DVector<f64>,
    rest: &DVector<f64>,
    count: usize,
    weighted: &[bool],
) -> (f64, f64) {
    let kept = rest.iter().zip(weighted).filter(|(_, weighted)| **weighted);
    let kept: Vec<f64> = kept.map(|(r, _)| *r).collect();
    let samples = independent(kept.len() as f64, neighbours(&kept));
    let gain = (residual.norm_squared() / rest.norm_squared()).ln();
    (samples * gain - 2.0 * count as f64, samples)
}
