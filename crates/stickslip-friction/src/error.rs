//! What can be wrong with a friction law, with the numbers that are.

/// A friction law with unusable parameters, or nodal data of the wrong length.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrictionError {
    /// A parameter that must be finite and positive is not.
    #[error("{parameter} = {value:e} is not finite and positive")]
    NotPositive {
        /// The field of the law.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter that must be finite and non-negative is not.
    #[error("{parameter} = {value:e} is not finite and non-negative")]
    Negative {
        /// The field of the law.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// Data given per vertex do not match the vertices.
    #[error("{found} values for {expected} vertices")]
    Length {
        /// The number of vertices.
        expected: usize,
        /// The number of values.
        found: usize,
    },
}

impl FrictionError {
    /// Passes a parameter that is finite and positive.
    ///
    /// # Errors
    ///
    /// [`NotPositive`](Self::NotPositive) otherwise.
    pub fn check_positive(parameter: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() && value > 0.0 {
            Ok(())
        } else {
            Err(Self::NotPositive { parameter, value })
        }
    }

    /// Passes a parameter that is finite and non-negative.
    ///
    /// # Errors
    ///
    /// [`Negative`](Self::Negative) otherwise.
    pub fn check_non_negative(parameter: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() && value >= 0.0 {
            Ok(())
        } else {
            Err(Self::Negative { parameter, value })
        }
    }
}
