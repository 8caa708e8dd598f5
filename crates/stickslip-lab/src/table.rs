//! The result of a fit as a table.

use std::fmt;

use crate::fitted::Fitted;
use crate::loss::Loss;
use crate::model::Trend;
use crate::parameters::Parameter;

impl fmt::Display for Fitted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let law = match &self.laws[..] {
            [one, two] if one == two => format!("two states, {one} law"),
            [one, two] => format!("two states, {one} and {two} law"),
            _ => format!("one state, {} law", self.laws[0]),
        };
        writeln!(
            f,
            "{law}, V0 = {:e} m/s, {} samples",
            self.parameters.reference_velocity,
            self.residuals.len()
        )?;
        for estimate in &self.estimates {
            let unit = match estimate.parameter {
                Parameter::SlipDistance(_) => " m",
                Parameter::Stiffness => " 1/m",
                Parameter::Trend if self.trend == Some(Trend::Time) => " 1/s",
                Parameter::Trend => " 1/m",
                Parameter::StepOffset => " s",
                _ => "",
            };
            let row = rounded(estimate.value, estimate.standard_error);
            writeln!(f, "{:<14} {row}{unit}", estimate.parameter)?;
        }
        let (value, error) = self.a_minus_b;
        writeln!(f, "{:<14} {}", "a - b", rounded(value, error))?;
        write!(f, "{:<14} {:.2e}, AIC {:.1}", "rms", self.rms, self.aic)?;
        if self.loss == Loss::Huber {
            write!(f, ", Huber's loss beside {:.2e}", self.deviation)?;
        }
        for warning in &self.warnings {
            write!(f, "\nwarning: {warning}")?;
        }
        Ok(())
    }
}

/// A value and its standard error, with two digits of the latter.
pub(crate) fn rounded(value: f64, error: f64) -> String {
    if !(error.is_finite() && error > 0.0) {
        return format!("{value:.4e} +- {error}");
    }
    let largest = value.abs().max(error);
    let digits = (largest.log10().floor() - error.log10().floor() + 1.0).clamp(0.0, 12.0) as usize;
    let exponent = largest.log10().floor() as i32;
    let mut scale = 10_f64.powi(exponent);
    let mut suffix = format!("e{exponent}");
    if (-3..4).contains(&exponent) {
        scale = 1.0;
        suffix.clear();
    }
    let digits = if scale == 1.0 {
        (digits as i32 - exponent).max(0) as usize
    } else {
        digits
    };
    format!(
        "({:.digits$} +- {:.digits$}){suffix}",
        value / scale,
        error / scale
    )
}
