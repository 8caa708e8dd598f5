//! The result of a fit as a table.

use std::fmt;

use crate::fitted::Fitted;
use crate::loss::Loss;
use crate::model::Trend;
use crate::parameter::Parameter;
use crate::rounded::rounded;

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
                Parameter::AgingVelocity(_) => " m/s",
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
