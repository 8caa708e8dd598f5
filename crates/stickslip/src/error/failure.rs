//! A failed step: its cause, and where and when it failed.

use thiserror::Error;

use super::{Place, StepError};
use crate::Clock;

/// A failed step. The simulation remains at the last accepted one.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "step {step} at t = {} s: {cause}{}", twelve_digits(*.time),
    place.as_ref().map_or_else(String::new, |place| format!("; {place}"))
)]
#[non_exhaustive]
pub struct StepFailure {
    /// The number of the failed step, from 1.
    pub step: usize,
    /// The time at its end \[s\].
    pub time: f64,
    /// The cause.
    #[source]
    pub cause: StepError,
    /// The place of its [vertex](StepError::vertex), if that is a vertex of a contact.
    pub place: Option<Place>,
}

impl StepFailure {
    pub(crate) fn new(step: usize, time: f64, cause: StepError) -> Self {
        Self {
            step,
            time,
            cause,
            place: None,
        }
    }

    /// The failure of a step to a time.
    pub(crate) fn of(next: &Clock, cause: StepError) -> Self {
        Self::new(next.step(), next.time(), cause)
    }

    /// Adds the place of the vertex, unless it is known.
    pub(crate) fn placed(mut self, place: impl Fn(usize) -> Option<Place>) -> Self {
        if self.place.is_none() {
            self.place = self.cause.vertex().and_then(place);
        }
        self
    }
}

/// A time in 12 digits, without the rounding error of steps times step size and without hundreds of zeros.
fn twelve_digits(time: f64) -> String {
    let rounded = format!("{time:.11e}").parse().unwrap_or(time);
    if rounded == 0.0 || (1e-4..1e12).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
#[path = "../../tests/unit/messages.rs"]
mod tests;
