//! What the end of a search says about the data: residuals, standard errors, tests.

use crate::error::LabError;
use crate::least_squares::Minimum;
use crate::loss::{Loss, Scale};
use crate::part::Part;
use crate::score::Tests;
use crate::search::{ERRORS, FINE, Search};
use crate::spikes::{Spike, spikes};
use crate::spread::Spread;

/// The end of a search.
pub(crate) struct End {
    pub(crate) spread: Spread,
    pub(crate) parts: Vec<PartEnd>,
    /// Akaike's information criterion.
    pub(crate) aic: f64,
}

/// The end of a search for one record.
#[derive(Default)]
pub(crate) struct PartEnd {
    /// Data minus model at the samples.
    pub(crate) residuals: Vec<f64>,
    /// The sum of the weighted squares of the residuals, and that of their losses.
    pub(crate) squares: f64,
    pub(crate) losses: f64,
    pub(crate) spikes: Vec<Spike>,
    pub(crate) tests: Tests,
    /// Whether the residuals are no more than the error of curves: the data have no noise.
    pub(crate) exact: bool,
}

impl Search<'_> {
    /// The end at a minimum. One that was interrupted has no tests of further parameters, no errors of the gauge and no spikes.
    ///
    /// # Errors
    /// That of the curves.
    pub(crate) fn end(&mut self, minimum: &Minimum, loss: Loss) -> Result<End, LabError> {
        let model = self.model;
        let interrupted = self.course.is_interrupted();
        self.course.resume();
        // The derivatives in the parameters that are tested cost no further curve; there may be none at other times.
        let further: Vec<_> = model.parts.iter().map(Part::further).collect();
        let each: Vec<_> = further.iter().map(|further| further.concat()).collect();
        let zeros = each.iter().flatten().map(|_| 0.0);
        let all: Vec<f64> = minimum.parameters.iter().copied().chain(zeros).collect();
        let extended = (!interrupted).then(|| model.with(&each));
        let extended = extended.and_then(|extended| {
            let all = extended.linearised(&all, FINE, &mut self.course);
            all.ok()
        });
        let linearised = match &extended {
            Some((residual, jacobian)) => (
                residual.clone(),
                jacobian.columns(0, model.free.len()).into_owned(),
            ),
            None => match &minimum.linearised {
                Some(here) => here.clone(),
                None => model.linearised(&minimum.parameters, FINE, &mut self.course)?,
            },
        };
        let residual = linearised.0.as_slice();
        let weighted = model.weighted();
        let scales = self.scales(loss, residual);
        let records: Vec<_> = model.rows().into_iter().zip(scales).collect();
        let mut spread = Spread::new(&linearised, &weighted, &records);
        let mut tests = Vec::new();
        if let Some(mut all) = extended {
            for (rows, scale) in &records {
                let mut rows = all.0.rows_mut(rows.start, rows.len());
                rows.apply(|r| *r = scale.slope(*r));
            }
            let inside = self.inside(minimum);
            tests = Tests::of_each(&all, &inside, &further, &weighted);
        }
        let mut ends = Vec::new();
        for (number, (rows, scale)) in records.iter().enumerate() {
            let mut end = self.part_end(number, &residual[rows.clone()], *scale);
            let gauge = if interrupted {
                None
            } else {
                self.gauge_errors(number, minimum, &linearised)
            };
            if !end.exact
                && let Some(tests) = tests.get_mut(number)
            {
                let statistics = (&spread.parts[number], *scale);
                self.test_beginning(number, minimum, &linearised.0, statistics, tests);
                end.tests = std::mem::take(tests);
            }
            end.residuals = self.residuals(number, minimum, &residual[rows.clone()])?;
            if !(end.exact || interrupted) {
                let known = gauge.as_ref().map(|gauge| gauge.deviations.clone());
                let known = known.unwrap_or_else(|| vec![0.0; rows.len()]);
                let part = &model.parts[number];
                let far = spikes(&residual[rows.clone()], &part.weighted(), &known);
                let spike = |n: usize| Spike {
                    time: part.record.times()[n],
                    residual: end.residuals[n],
                };
                end.spikes = far.into_iter().map(spike).collect();
            }
            if let Some(gauge) = gauge {
                spread.covariance += gauge.covariance;
            }
            ends.push(end);
        }
        let aic = self.criterion(&ends);
        Ok(End {
            spread,
            parts: ends,
            aic,
        })
    }

    /// The sums of the residuals of a record, without what follows from other curves.
    fn part_end(&self, number: usize, residual: &[f64], scale: Scale) -> PartEnd {
        let part = &self.model.parts[number];
        let squares: f64 = residual.iter().map(|r| r * r).sum();
        let largest = part.roots.iter().copied().fold(0.0, f64::max);
        let error = ERRORS * FINE * self.scale * largest;
        let unit = part.noise * part.noise;
        PartEnd {
            squares: unit * squares,
            losses: unit * residual.iter().map(|r| scale.loss(*r)).sum::<f64>(),
            exact: squares <= residual.len() as f64 * error * error,
            ..PartEnd::default()
        }
    }

    /// Akaike's information criterion, with the noise of each record as a parameter.
    fn criterion(&self, ends: &[PartEnd]) -> f64 {
        let records = self.model.parts.iter().zip(ends).map(|(part, end)| {
            let samples = part.record.weighted() as f64;
            samples * (end.losses / samples).ln()
        });
        records.sum::<f64>() + 2.0 * (self.model.free.len() + ends.len()) as f64
    }

    /// Whether each value is inside its bounds.
    fn inside(&self, minimum: &Minimum) -> Vec<bool> {
        let values = minimum.parameters.iter().zip(self.bounds);
        values
            .map(|(value, &(low, high))| *value > low && *value < high)
            .collect()
    }

    /// Data minus model of a record, by the weighted residuals, model minus data; by the curve where there is no weight.
    fn residuals(
        &mut self,
        number: usize,
        minimum: &Minimum,
        weighted: &[f64],
    ) -> Result<Vec<f64>, LabError> {
        let part = &self.model.parts[number];
        let roots = &part.roots;
        let mut residuals: Vec<f64> = weighted
            .iter()
            .zip(roots)
            .map(|(r, root)| -r / root)
            .collect();
        if part.weighted().contains(&false) {
            let point = part.point(&self.model.of_part(number, &minimum.parameters));
            let curve = part.friction(&point, FINE, &mut self.course)?;
            for (n, residual) in residuals.iter_mut().enumerate() {
                if roots[n] == 0.0 {
                    *residual = part.record.friction()[n] - curve[n];
                }
            }
        }
        Ok(residuals)
    }
}
