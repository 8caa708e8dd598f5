//! Minima with weights by the residuals: those of Huber's loss, and by the noise of each of several records.

use crate::error::LabError;
use crate::least_squares::{Minimum, Stop};
use crate::loss::{Loss, Scale};
use crate::model::Model;
use crate::search::{CONVERGED, DAMPING, ERRORS, FINE, MAX_STEPS, Search};

/// The largest number of times that weights are set: the distance to the minimum falls by the share of residuals beyond the
/// bound each time, at worst a half, so that twenty leave a millionth.
const ROUNDS: usize = 20;

impl<'a> Search<'a> {
    /// The minimum of losses over the noise of each record, from that of the squares on, and the noise of each record: 1 of a
    /// single one. The weights are by the residuals before, until the relative offset of the weighted squares is below a
    /// thousandth at once; if it is interrupted, where it is. Source: P. W. Holland, R. E. Welsch, "Robust regression using
    /// iteratively reweighted least-squares", Comm. Statist. A6 (1977).
    ///
    /// # Errors
    /// [`LabError::NotConverged`], and that of a curve.
    pub(crate) fn reweighted(
        &mut self,
        mut minimum: Minimum,
        loss: Loss,
    ) -> Result<(Minimum, Vec<f64>), LabError> {
        let model = self.model;
        let mut noise = vec![1.0; model.parts.len()];
        if loss == Loss::Squares && model.parts.len() == 1 {
            return Ok((minimum, noise));
        }
        for _ in 0..ROUNDS {
            let linearised = model.linearised(&minimum.parameters, FINE, &mut self.course);
            let (residual, _) = match linearised {
                Err(LabError::Interrupted) => return Ok((minimum, noise)),
                linearised => linearised?,
            };
            let scales = self.scales(loss, residual.as_slice());
            noise = self.noise(residual.as_slice(), &scales);
            let mut weighted = model.over_noise(&noise);
            for ((part, rows), scale) in weighted.parts.iter_mut().zip(model.rows()).zip(&scales) {
                for (root, r) in part.roots.iter_mut().zip(&residual.as_slice()[rows]) {
                    *root *= scale.weight(*r).sqrt();
                }
            }
            let mut search = Search::new(&weighted, self.bounds, self.scale, self.course);
            let stop = Stop {
                offset: CONVERGED,
                change: FINE * self.scale,
                steps: MAX_STEPS,
                damping: DAMPING,
            };
            let begin = minimum.parameters.clone();
            let end = search.descend(minimum.parameters, FINE, stop);
            self.steps += search.steps;
            self.course.rejoin(&search.course);
            minimum = match end {
                Err(LabError::Interrupted) => Minimum::at_start(begin),
                end => end?,
            };
            // They have other weights.
            minimum.linearised = None;
            if search.steps == 0 || self.course.is_interrupted() {
                return Ok((minimum, noise));
            }
        }
        Err(LabError::NotConverged {
            steps: self.steps,
            offset: minimum.offset,
        })
    }

    /// The scale of the loss of each record.
    pub(crate) fn scales(&self, loss: Loss, residual: &[f64]) -> Vec<Scale> {
        let parts = self.model.parts.iter().zip(self.model.rows());
        parts
            .map(|(part, rows)| Scale::of(loss, &residual[rows], &part.weighted()))
            .collect()
    }

    /// The standard deviations of the weighted residuals of records over their geometric mean, by the median if the loss is
    /// Huber's. They are at least the error of curves; that of a single record is 1.
    fn noise(&self, residual: &[f64], scales: &[Scale]) -> Vec<f64> {
        if self.model.parts.len() == 1 {
            return vec![1.0];
        }
        let parts = self.model.parts.iter().zip(self.model.rows()).zip(scales);
        let deviations = parts.map(|((part, rows), scale)| {
            let count = part.record.weighted() as f64;
            let squares: f64 = residual[rows].iter().map(|r| r * r).sum();
            let deviation = scale.deviation().unwrap_or((squares / count).sqrt());
            let largest = part.roots.iter().copied().fold(0.0, f64::max);
            deviation.max(ERRORS * FINE * self.scale * largest)
        });
        let deviations: Vec<f64> = deviations.collect();
        let logarithms = deviations.iter().map(|deviation| deviation.ln());
        let mean = (logarithms.sum::<f64>() / deviations.len() as f64).exp();
        deviations
            .iter()
            .map(|deviation| deviation / mean)
            .collect()
    }
}

impl<'a> Model<'a> {
    /// The model with residuals over the noise of each record.
    pub(crate) fn over_noise(&self, noise: &[f64]) -> Self {
        let mut model = self.clone();
        for (part, &noise) in model.parts.iter_mut().zip(noise) {
            part.noise = noise;
            for root in &mut part.roots {
                *root /= noise;
            }
        }
        model
    }
}
