//! Parameters that vary along a fault.

/// A value of all vertices, or one of each in their order; of cells likewise.
///
/// ```
/// use stickslip_fields::PerVertex;
///
/// let uniform: PerVertex = 1e-6.into();
/// let each: PerVertex = vec![1e-6, 2e-6].into();
/// assert_ne!(uniform, each);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum PerVertex {
    /// One value.
    Uniform(f64),
    /// One value per vertex.
    Each(Vec<f64>),
}

impl From<f64> for PerVertex {
    fn from(value: f64) -> Self {
        Self::Uniform(value)
    }
}

impl From<Vec<f64>> for PerVertex {
    fn from(values: Vec<f64>) -> Self {
        Self::Each(values)
    }
}

impl From<&[f64]> for PerVertex {
    fn from(values: &[f64]) -> Self {
        Self::Each(values.to_vec())
    }
}

impl PerVertex {
    /// The value at a vertex.
    pub(crate) fn at(&self, vertex: usize) -> f64 {
        match self {
            Self::Uniform(value) => *value,
            Self::Each(values) => values[vertex],
        }
    }
}
