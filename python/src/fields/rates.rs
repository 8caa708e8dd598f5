//! Rates of injection in time.

use pyo3::prelude::*;
use stickslip::fields::RateHistory;

use crate::arguments::{Numbers, finite};
use crate::errors::{Bare, argument};

/// Times, rates and what is between them.
pub(super) struct Rates {
    pub(super) times: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) interpolation: String,
    pub(super) history: RateHistory,
}

impl Rates {
    /// Those of Python, each checked.
    pub(super) fn new(
        Numbers(times): Numbers,
        Numbers(rates): Numbers,
        interpolation: String,
    ) -> PyResult<Self> {
        if times.is_empty() {
            return Err(argument("times", "of at least one time", times));
        }
        if rates.len() != times.len() {
            let requirement = format!("one for each of {} times", times.len());
            let given = Bare(format!("{} of them", rates.len()));
            return Err(argument("rates", &requirement, given));
        }
        let mut last = f64::NEG_INFINITY;
        for (n, (&time, &rate)) in times.iter().zip(&rates).enumerate() {
            if !(time.is_finite() && time >= last) {
                let requirement = "finite and not before the time before it";
                return Err(argument(&format!("times[{n}]"), requirement, time));
            }
            finite(&format!("rates[{n}]"), rate)?;
            last = time;
        }
        let rows: Vec<_> = times.iter().copied().zip(rates.iter().copied()).collect();
        let history = match interpolation.as_str() {
            "constant" => RateHistory::constant_between(&rows),
            "linear" => RateHistory::linear_between(&rows),
            _ => {
                let names = "\"constant\" or \"linear\"";
                return Err(argument("interpolation", names, interpolation));
            }
        };
        let history = history.map_err(super::diffusion::refused("times"))?;
        Ok(Self {
            times,
            rates,
            interpolation,
            history,
        })
    }
}
