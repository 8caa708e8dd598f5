//! The result of a fit of several records.

use std::fmt;

use nalgebra::DMatrix;

use crate::end::End;
use crate::fit::Fit;
use crate::fitted::{Fitted, a_minus_b, correlation, covariance};
use crate::least_squares::Minimum;
use crate::parameter::Parameter;
use crate::rounded::rounded;
use crate::search::Search;
use crate::told::told;
use crate::warning::Warning;

/// A parameter that was fitted to several records.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointEstimate {
    /// The parameter.
    pub parameter: Parameter,
    /// The record that has it, from 0 on; none of a parameter that all records share.
    pub record: Option<usize>,
    /// Its value, in SI units.
    pub value: f64,
    /// Its standard error, in the unit of the value; infinite if the data do not depend on it.
    pub standard_error: f64,
}

/// The result of a fit of [several records](Fit::run_joint). It prints as a table.
///
/// Each record counts by its noise, which is estimated from its residuals.
#[derive(Debug, Clone)]
pub struct JointFit {
    /// The fitted parameters with their standard errors: first those that all records share, then those of each record.
    pub estimates: Vec<JointEstimate>,
    /// The correlations of the fitted parameters, in the order of `estimates`; NaN where a standard error is infinite.
    pub correlation: DMatrix<f64>,
    /// `a - sum b_i` and its standard error.
    pub a_minus_b: (f64, f64),
    /// Akaike's information criterion, `sum_r N_r ln(sum of squares/N_r) + 2 (P + R)` of `R` records, up to a constant of the
    /// data.
    pub aic: f64,
    /// Whether the fit was [interrupted](Fit::with_interrupt): the parameters are the best so far, which are no minimum.
    pub interrupted: bool,
    /// The result for each record: its parameters with standard errors by all records, its curve and its warnings. Their
    /// `aic`, `steps`, `offset` and `work` are those of the whole fit.
    pub records: Vec<Fitted>,
}

impl JointFit {
    pub(crate) fn new(search: &Search<'_>, fit: &Fit<'_>, minimum: &Minimum, end: &End) -> Self {
        let model = search.model;
        let points = model.points(&minimum.parameters);
        let covariance = covariance(model, minimum, end);
        let estimates = model
            .free
            .iter()
            .enumerate()
            .map(|(k, free)| JointEstimate {
                parameter: free.parameter,
                record: free.part,
                value: points[free.part.unwrap_or(0)].value(free.parameter),
                standard_error: covariance[(k, k)].sqrt(),
            });
        let records = 0..model.parts.len();
        Self {
            estimates: estimates.collect(),
            correlation: correlation(&covariance),
            a_minus_b: a_minus_b(search, &points[0], end),
            aic: end.aic,
            interrupted: search.course.is_interrupted(),
            records: records
                .map(|number| Fitted::new(search, fit, minimum, end, number))
                .collect(),
        }
    }

    /// The warnings that all records have, and the others with the number of their record, from 0 on.
    pub fn warnings(&self) -> Vec<(Option<usize>, Warning)> {
        let everywhere = |warning: &Warning| {
            let mut records = self.records.iter();
            records.all(|record| record.warnings.contains(warning))
        };
        let first = self.records.first().into_iter();
        let shared = first.flat_map(|record| &record.warnings);
        let shared = shared.filter(|warning| everywhere(warning));
        let mut all: Vec<_> = shared.map(|warning| (None, *warning)).collect();
        for (number, record) in self.records.iter().enumerate() {
            let own = record
                .warnings
                .iter()
                .filter(|warning| !everywhere(warning));
            all.extend(own.map(|warning| (Some(number), *warning)));
        }
        all
    }
}

impl fmt::Display for JointFit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(first) = self.records.first() else {
            return Ok(());
        };
        let samples: usize = self
            .records
            .iter()
            .map(|record| record.residuals.len())
            .sum();
        writeln!(
            f,
            "{} records, {}, V0 = {:e} m/s, {samples} samples",
            self.records.len(),
            first.law(),
            first.parameters.reference_velocity,
        )?;
        for estimate in self
            .estimates
            .iter()
            .filter(|estimate| estimate.record.is_none())
        {
            let row = rounded(estimate.value, estimate.standard_error);
            writeln!(
                f,
                "{:<14} {row}{}",
                estimate.parameter,
                first.unit(estimate.parameter)
            )?;
        }
        let (value, error) = self.a_minus_b;
        writeln!(f, "{:<14} {}", "a - b", rounded(value, error))?;
        for (number, record) in self.records.iter().enumerate() {
            writeln!(
                f,
                "record {}, {} samples",
                number + 1,
                record.residuals.len()
            )?;
            writeln!(f, "  load point   {}", told(&record.load))?;
            for estimate in self
                .estimates
                .iter()
                .filter(|estimate| estimate.record == Some(number))
            {
                let row = rounded(estimate.value, estimate.standard_error);
                writeln!(
                    f,
                    "  {:<12} {row}{}",
                    estimate.parameter,
                    record.unit(estimate.parameter)
                )?;
            }
            writeln!(f, "  {:<12} {:.2e}", "rms", record.rms)?;
        }
        write!(f, "AIC {:.1}", self.aic)?;
        for (record, warning) in self.warnings() {
            match record {
                None => write!(f, "\nwarning: {warning}")?,
                Some(number) => write!(f, "\nwarning: record {}: {warning}", number + 1)?,
            }
        }
        Ok(())
    }
}
