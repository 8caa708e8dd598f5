//! Minima of Huber's losses by least squares with weights.

use crate::error::LabError;
use crate::least_squares::{Minimum, Stop};
use crate::loss::{Loss, Scale};
use crate::model::Model;
use crate::search::{CONVERGED, DAMPING, FINE, MAX_STEPS, Search};

/// The largest number of times that weights are set: the distance to the minimum falls by the share of residuals beyond the
/// bound each time, at worst a half, so that twenty leave a millionth.
const ROUNDS: usize = 20;

impl Search<'_> {
    /// The minimum of Huber's losses from that of the squares on: the weights are those of the residuals before, until the
    /// relative offset of the weighted squares is below a thousandth at once. Source: P. W. Holland, R. E. Welsch,
    /// "Robust regression using iteratively reweighted least-squares", Comm. Statist. A6 (1977).
    ///
    /// # Errors
    /// [`LabError::NotConverged`], and that of a curve.
    pub(crate) fn robust(&mut self, mut minimum: Minimum) -> Result<Minimum, LabError> {
        let model = self.model;
        let weighted = model.weighted();
        for _ in 0..ROUNDS {
            let (residual, _) = model.linearised(&minimum.parameters, FINE, &mut self.work)?;
            let scale = Scale::of(Loss::Huber, residual.as_slice(), &weighted);
            let roots = model.roots.iter().zip(&residual);
            let robust = Model {
                free: model.free.clone(),
                fixed: model.fixed.clone(),
                trend: model.trend.clone(),
                roots: roots
                    .map(|(root, r)| root * scale.weight(*r).sqrt())
                    .collect(),
                ..*model
            };
            let mut search = Search::new(&robust, self.bounds, self.scale);
            let stop = Stop {
                offset: CONVERGED,
                change: FINE * self.scale,
                steps: MAX_STEPS,
                damping: DAMPING,
            };
            minimum = search.descend(minimum.parameters, FINE, stop)?;
            self.steps += search.steps;
            self.work.integrations += search.work.integrations;
            self.work.steps += search.work.steps;
            if search.steps == 0 {
                return Ok(minimum);
            }
        }
        Err(LabError::NotConverged {
            steps: self.steps,
            offset: minimum.offset,
        })
    }
}
