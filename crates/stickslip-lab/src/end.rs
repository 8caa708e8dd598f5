//! What the end of a search says about the data: residuals, standard errors, tests.

use crate::error::LabError;
use crate::least_squares::Minimum;
use crate::loss::{Loss, Scale};
use crate::model::Model;
use crate::score::Tests;
use crate::search::{ERRORS, FINE, Search};
use crate::spikes::{Spike, spikes};
use crate::spread::Spread;

/// The end of a search.
pub(crate) struct End {
    /// Data minus model at the samples.
    pub(crate) residuals: Vec<f64>,
    /// The sum of the weighted squares of the residuals, and that of their losses.
    pub(crate) squares: f64,
    pub(crate) losses: f64,
    pub(crate) spread: Spread,
    pub(crate) spikes: Vec<Spike>,
    pub(crate) tests: Tests,
    /// Whether the residuals are no more than the error of curves: the data have no noise.
    pub(crate) exact: bool,
}

impl Search<'_> {
    /// The end at a minimum.
    ///
    /// # Errors
    /// That of the curve.
    pub(crate) fn end(&mut self, minimum: &Minimum, loss: Loss) -> Result<End, LabError> {
        let model = self.model;
        let weighted = model.weighted();
        // The derivatives in the parameters that are tested cost no further curve; there may be none at other times.
        let further = model.further();
        let extended = model.with(&further);
        let zeros = further.iter().flatten().map(|_| 0.0);
        let all: Vec<f64> = minimum.parameters.iter().copied().chain(zeros).collect();
        let (mut all, tested) = match extended.linearised(&all, FINE, &mut self.work) {
            Ok(all) => (all, true),
            Err(_) => (
                model.linearised(&minimum.parameters, FINE, &mut self.work)?,
                false,
            ),
        };
        let residual = all.0.clone();
        let linearised = (residual, all.1.columns(0, model.free.len()).into_owned());
        let residual = &linearised.0;
        let scale = Scale::of(loss, residual.as_slice(), &weighted);
        let mut spread = Spread::new(&linearised, &weighted, scale);
        let gauge = self.gauge_errors(minimum, &linearised);
        if let Some(gauge) = &gauge {
            spread.covariance += &gauge.covariance;
        }
        let squares = residual.norm_squared();
        let largest = model.roots.iter().copied().fold(0.0, f64::max);
        let error = ERRORS * FINE * self.scale * largest;
        let exact = squares <= residual.len() as f64 * error * error;
        let mut tests = Tests::default();
        if tested && !exact {
            all.0.apply(|r| *r = scale.slope(*r));
            let values = minimum.parameters.iter().zip(self.bounds);
            let inside: Vec<bool> = values
                .map(|(value, &(low, high))| *value > low && *value < high)
                .collect();
            tests = Tests::new(&all, &inside, &further, &weighted);
            self.test_beginning(minimum, &linearised, &spread, scale, &mut tests);
        }
        let spikes = if exact {
            Vec::new()
        } else {
            let known = gauge.map_or_else(|| vec![0.0; residual.len()], |gauge| gauge.deviations);
            spikes(residual.as_slice(), &weighted, &known)
        };
        let residuals = self.residuals(minimum, residual.as_slice())?;
        let spike = |n: usize| Spike {
            time: model.record.times()[n],
            residual: residuals[n],
        };
        Ok(End {
            squares,
            losses: residual.iter().map(|r| scale.loss(*r)).sum(),
            spread,
            spikes: spikes.into_iter().map(spike).collect(),
            tests,
            exact,
            residuals,
        })
    }

    /// Data minus model, by the weighted residuals, model minus data; by the curve where there is no weight.
    fn residuals(&mut self, minimum: &Minimum, weighted: &[f64]) -> Result<Vec<f64>, LabError> {
        let model = self.model;
        let roots = &model.roots;
        let mut residuals: Vec<f64> = weighted
            .iter()
            .zip(roots)
            .map(|(r, root)| -r / root)
            .collect();
        if model.weighted().contains(&false) {
            let point = model.point(&minimum.parameters);
            let curve = model.friction(&point, FINE, &mut self.work)?;
            for (n, residual) in residuals.iter_mut().enumerate() {
                if roots[n] == 0.0 {
                    *residual = model.record.friction()[n] - curve[n];
                }
            }
        }
        Ok(residuals)
    }
}

impl Model<'_> {
    /// Whether each sample has a weight.
    pub(crate) fn weighted(&self) -> Vec<bool> {
        self.roots.iter().map(|root| *root > 0.0).collect()
    }
}
