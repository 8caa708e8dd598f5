//! The result of a fit as a table.

use std::fmt;

use crate::fitted::Fitted;
use crate::loss::Loss;
use crate::parameter::Parameter;
use crate::rounded::rounded;
use crate::told::told;
use crate::trend::Trend;

impl Fitted {
    /// The number of states and their laws.
    pub(crate) fn law(&self) -> String {
        match &self.laws[..] {
            [one, two] if one == two => format!("two states, {one} law"),
            [one, two] => format!("two states, {one} and {two} law"),
            _ => format!("one state, {} law", self.laws[0]),
        }
    }

    /// The unit of a parameter, behind a space.
    pub(crate) fn unit(&self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::SlipDistance(_) => " m",
            Parameter::Stiffness => " 1/m",
            Parameter::Trend if self.trend == Some(Trend::Time) => " 1/s",
            Parameter::Trend => " 1/m",
            Parameter::StepOffset => " s",
            Parameter::AgingVelocity(_) => " m/s",
            _ => "",
        }
    }
}

impl fmt::Display for Fitted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}, V0 = {:e} m/s, {} samples",
            self.law(),
            self.parameters.reference_velocity,
            self.residuals.len()
        )?;
        writeln!(f, "load point     {}", told(&self.load))?;
        for estimate in &self.estimates {
            let row = rounded(estimate.value, estimate.standard_error);
            writeln!(
                f,
                "{:<14} {row}{}",
                estimate.parameter,
                self.unit(estimate.parameter)
            )?;
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
