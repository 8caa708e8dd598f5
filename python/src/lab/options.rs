//! What is fitted, by which law and loss.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use stickslip::lab::{Fit, Loss, Parameter, Trend};

use super::names::{Names, refused};
use crate::errors::argument;

/// The options of a fit.
pub(super) struct Options {
    pub(super) law: Names,
    pub(super) states: usize,
    pub(super) trend: Option<String>,
    pub(super) free_initial_state: bool,
    pub(super) loss: String,
    pub(super) step_offset: bool,
    pub(super) reference_velocity: Option<f64>,
    pub(super) free: Vec<String>,
    pub(super) fixed: BTreeMap<String, f64>,
    pub(super) bounds: BTreeMap<String, (f64, f64)>,
    pub(super) guess: BTreeMap<String, f64>,
}

impl Options {
    /// The fit; whether the stiffness of a record is given.
    pub(super) fn fit(self, py: Python<'_>, with_stiffness: bool) -> PyResult<Fit<'static>> {
        let mut fit = Fit::new(&self.law.laws(self.states)?);
        fit = match self.trend.as_deref() {
            None => fit,
            Some("time") => fit.with_trend(Trend::Time),
            Some("displacement") => fit.with_trend(Trend::Displacement),
            Some(other) => {
                let names = "None, \"time\" or \"displacement\"";
                return Err(argument("trend", names, other));
            }
        };
        if self.free_initial_state {
            fit = fit.with_free_initial_state();
        }
        fit = match self.loss.as_str() {
            "squares" => fit,
            "huber" => fit.with_loss(Loss::Huber),
            other => return Err(argument("loss", "\"squares\" or \"huber\"", other)),
        };
        if self.step_offset {
            fit = fit.with_step_offset();
        }
        if let Some(velocity) = self.reference_velocity {
            fit = fit.with_reference_velocity(velocity);
        }
        for name in &self.free {
            fit = fit.with_free(refused(py, name.parse::<Parameter>())?);
        }
        let mut given = Vec::new();
        if with_stiffness {
            given.push(Parameter::Stiffness);
        }
        let mut parameter = |what: &'static str, name: &str| {
            let parameter = refused(py, name.parse::<Parameter>())?;
            if given.contains(&parameter) {
                let once = "a parameter that is given once: by k, fixed or bounds";
                return Err(argument(what, once, name));
            }
            given.push(parameter);
            Ok(parameter)
        };
        for (name, value) in &self.fixed {
            fit = fit.with_fixed(parameter("fixed", name)?, *value);
        }
        for (name, (low, high)) in &self.bounds {
            fit = fit.with_bounds(parameter("bounds", name)?, *low, *high);
        }
        for (name, value) in &self.guess {
            fit = fit.with_guess_of(refused(py, name.parse::<Parameter>())?, *value);
        }
        Ok(fit)
    }
}
