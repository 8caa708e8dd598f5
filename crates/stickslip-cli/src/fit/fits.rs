//! The fits of all files and windows, one by one or at once, until they are interrupted.

use serde_json::{Value, json};
use stickslip::lab::{Fit, Fitted, JointEstimate, JointFit, LabError};

use super::Arguments;
use super::report::summary;
use super::settings::{Job, Unread};
use crate::cli::Problem;
use crate::interrupt::{Interrupted, Watch};

/// The results.
pub(super) struct Fits {
    /// That of each file and window.
    pub(super) each: Vec<Result<Fitted, LabError>>,
    /// That of all, if they are fitted at once.
    joint: Option<JointFit>,
    interrupted: bool,
}

impl Fits {
    /// Fits all files and windows. Ctrl-C ends the fit that runs with the best parameters so far, and no other begins.
    ///
    /// # Errors
    /// Those of the settings and records, before the first fit, and of a joint fit.
    pub(super) fn new(arguments: &Arguments, fit: &Fit<'_>, jobs: &[Job]) -> Result<Self, Problem> {
        let watch = Watch::new()?;
        let pressed = || watch.is_pressed();
        let fit: Fit<'_> = fit.clone().with_interrupt(&pressed);
        let experiments: Vec<_> = jobs.iter().map(|job| arguments.machine(job)).collect();
        let (each, joint) = if arguments.joint {
            let joint = fit.run_joint(&experiments);
            let joint = joint.map_err(|error| named(error, jobs))?;
            (joint.records.iter().cloned().map(Ok).collect(), Some(joint))
        } else {
            let alone = experiments.iter().map(|experiment| {
                let mut joint = fit.run_joint(std::slice::from_ref(experiment))?;
                joint.records.pop().ok_or(LabError::NoRecord)
            });
            (alone.collect(), None)
        };
        Ok(Self {
            each,
            joint,
            interrupted: watch.is_pressed(),
        })
    }

    /// Prints the results: that of all files at once, or one by one.
    ///
    /// # Errors
    /// That of the output.
    pub(super) fn print(&self, jobs: &[Job]) -> Result<(), Problem> {
        for (number, (job, fitted)) in jobs.iter().zip(&self.each).enumerate() {
            let Ok(fitted) = fitted else { continue };
            if self.joint.is_some() {
                say!("record {}: {}", number + 1, job.name())?;
            } else {
                if jobs.len() > 1 {
                    say!("\n{}. {}", number + 1, job.name())?;
                }
                say!("{fitted}")?;
            }
            if let Some(note) = job.note() {
                say!("{note}")?;
            }
        }
        if let Some(joint) = &self.joint {
            say!("{joint}")?;
        }
        Ok(())
    }

    /// The results in JSON, with files that cannot be fitted: a list, or an object with the list as `records`.
    pub(super) fn summary(&self, jobs: &[Job], unread: &[Unread]) -> Value {
        let each = jobs.iter().zip(&self.each);
        let each = each.map(|(job, fit)| summary(job, fit));
        let records: Vec<_> = each.chain(unread.iter().map(Unread::summary)).collect();
        let Some(joint) = &self.joint else {
            return records.into();
        };
        let estimate = |estimate: &JointEstimate| {
            json!({
                "parameter": estimate.parameter.to_string(),
                "record": estimate.record.map(|record| record + 1),
                "value": estimate.value,
                "standard_error": estimate.standard_error,
            })
        };
        let correlation = joint.correlation.row_iter();
        let correlation = correlation.map(|row| row.iter().copied().collect::<Vec<f64>>());
        json!({
            "parameters": joint.estimates.iter().map(estimate).collect::<Vec<_>>(),
            "correlation": correlation.collect::<Vec<_>>(),
            "a_minus_b": {"value": joint.a_minus_b.0, "standard_error": joint.a_minus_b.1},
            "aic": joint.aic,
            "interrupted": joint.interrupted,
            "records": records,
        })
    }

    /// The failure of an interruption, unless all fits had ended before.
    pub(super) fn check_interrupt(&self) -> Result<(), Problem> {
        let cut = |fit: &Result<Fitted, LabError>| match fit {
            Ok(fitted) => fitted.interrupted,
            Err(error) => *error == LabError::Interrupted,
        };
        if self.interrupted && self.each.iter().any(cut) {
            return Err(Interrupted.into());
        }
        Ok(())
    }
}

/// Checks the settings and all records: those that are refused are left out, but of a joint fit, which needs all.
///
/// # Errors
/// In one line, with the file, of a joint fit.
pub(super) fn validate(
    arguments: &Arguments,
    fit: &Fit<'_>,
    jobs: &mut Vec<Job>,
    unread: &mut Vec<Unread>,
) -> Result<(), Problem> {
    if arguments.joint {
        if let Some(first) = unread.first() {
            return Err(first.error.clone().into());
        }
        let experiments: Vec<_> = jobs.iter().map(|job| arguments.machine(job)).collect();
        let valid = fit.validate_joint(&experiments);
        return valid.map_err(|error| named(error, jobs));
    }
    jobs.retain(|job| {
        let valid = fit.validate_joint(&[arguments.machine(job)]);
        valid
            .map_err(|error| unread.push(Unread::of(job, &error)))
            .is_ok()
    });
    Ok(())
}

/// An error with the file of the record that has it.
fn named(error: LabError, jobs: &[Job]) -> Problem {
    match error {
        LabError::Interrupted => Interrupted.into(),
        LabError::Record { number, cause } => match jobs.get(number - 1) {
            Some(job) => format!("{}: {cause}", job.name()).into(),
            None => cause.into(),
        },
        error => error.into(),
    }
}
