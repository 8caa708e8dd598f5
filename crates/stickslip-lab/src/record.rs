//! Measured friction.

use crate::error::LabError;
use crate::load::ascending;

/// Coefficients of friction over time, with weights.
///
/// ```
/// use stickslip_lab::Record;
///
/// let record = Record::new(vec![0.0, 1.0, 2.5], vec![0.60, 0.61, 0.60])?;
/// assert_eq!(record.window(0.5, 3.0).times(), [1.0, 2.5]);
/// # Ok::<(), stickslip_lab::LabError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    times: Vec<f64>,
    friction: Vec<f64>,
    weights: Vec<f64>,
}

impl Record {
    /// Friction coefficients at times \[s\] in order, evenly spaced or not.
    ///
    /// # Errors
    /// [`LabError::Length`] for lists of different length, [`LabError::Value`] for times out of order and for
    /// values that are not finite.
    pub fn new(times: Vec<f64>, friction: Vec<f64>) -> Result<Self, LabError> {
        same_length("friction coefficients", times.len(), friction.len())?;
        ascending(&times)?;
        for (position, &mu) in friction.iter().enumerate() {
            LabError::check_finite("friction coefficient", position, mu)?;
        }
        let weights = vec![1.0; times.len()];
        Ok(Self {
            times,
            friction,
            weights,
        })
    }

    /// Weights the squares of the residuals, by default each with 1: a sample with the standard deviation `s` has the
    /// weight `1/s^2`, up to a common factor.
    ///
    /// # Errors
    /// [`LabError::Length`] unless there is one per sample, [`LabError::Value`] for a negative or an infinite one.
    pub fn with_weights(mut self, weights: Vec<f64>) -> Result<Self, LabError> {
        same_length("weights", self.times.len(), weights.len())?;
        for (position, &weight) in weights.iter().enumerate() {
            let legal = weight >= 0.0 && weight.is_finite();
            LabError::check("weight", "finite and non-negative", position, weight, legal)?;
        }
        self.weights = weights;
        Ok(self)
    }

    /// The samples from one time to another \[s\], both included.
    #[must_use]
    pub fn window(&self, from: f64, to: f64) -> Self {
        let first = self.times.partition_point(|&time| time < from);
        let last = self.times.partition_point(|&time| time <= to).max(first);
        Self {
            times: self.times[first..last].to_vec(),
            friction: self.friction[first..last].to_vec(),
            weights: self.weights[first..last].to_vec(),
        }
    }

    /// The times \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The coefficients of friction.
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// The weights.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The number of samples with a weight.
    pub(crate) fn weighted(&self) -> usize {
        self.weights.iter().filter(|weight| **weight > 0.0).count()
    }
}

fn same_length(what: &'static str, expected: usize, found: usize) -> Result<(), LabError> {
    if expected == found {
        return Ok(());
    }
    Err(LabError::Length {
        what,
        expected,
        found,
    })
}
