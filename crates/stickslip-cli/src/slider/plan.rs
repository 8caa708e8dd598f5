//! The steps of the slider's run, and what identifies it.

use serde_json::{Value, json};
use stickslip::Steps;
use stickslip::problems::pipping_slider::END;

use super::Arguments;
use crate::checkpoints::Tags;
use crate::cli::Problem;

impl Arguments {
    /// The size of a step \[s\], the first one if it adapts.
    pub fn step_size(&self) -> f64 {
        END / self.steps.get() as f64
    }

    /// The number of steps of constant size.
    fn count(&self) -> usize {
        ((self.until * self.steps.get() as f64).round() as usize).max(1)
    }

    /// The end of the run \[s\].
    pub fn end(&self) -> f64 {
        match self.adaptive {
            Some(_) => self.until * END,
            None => self.count() as f64 * self.step_size(),
        }
    }

    /// The remaining steps after so many; refuses more than there are.
    pub fn plan(&self, taken: usize) -> Result<Steps, Problem> {
        let dt = self.step_size();
        if let Some(tolerance) = self.adaptive {
            let steps = Steps::adaptive(tolerance)
                .until(self.end())
                .with_max_steps(self.max_steps.get().saturating_sub(taken));
            // The velocity of the top has a kink there.
            let steps = steps.with_first_step(dt).in_powers_of_two();
            return Ok(steps.stopping_at([END / 4.0]));
        }
        let count = self.count();
        let Some(left) = count.checked_sub(taken) else {
            return Err(format!("the checkpoint is at step {taken}, --until at {count}").into());
        };
        let steps = Steps::constant(dt).count(left);
        Ok(if self.no_bridging {
            steps.without_substeps()
        } else {
            steps
        })
    }

    /// The tags that identify this run, without its length if that changes no step.
    pub fn tags(&self) -> Result<Tags, Problem> {
        let laws = self.laws()?;
        let chosen = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "law": laws.law,
            "friction": laws.friction,
            "coupling": self.coupling_name(),
            "state-update": self.update_name(),
            "until": self.adaptive.map(|_| self.until),
        });
        let given = serde_json::to_value(self)?;
        let entries = [chosen, given].into_iter().flat_map(|value| match value {
            Value::Object(entries) => entries.into_iter().collect(),
            _ => Vec::new(),
        });
        let text = |value: Value| match value {
            Value::String(text) => text,
            other => other.to_string(),
        };
        Ok(entries.map(|(name, value)| (name, text(value))).collect())
    }
}
