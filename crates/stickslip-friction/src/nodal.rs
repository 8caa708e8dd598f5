//! One value for the whole frictional boundary, or one a vertex.

use crate::FrictionError;

/// Data on the frictional boundary: the same everywhere, or a value at every vertex.
///
/// ```
/// # use stickslip_friction::{Nodal, Tresca};
/// let same: Nodal<Tresca> = Tresca { coefficient: 0.6 }.into();
/// assert_eq!(same.at(17).coefficient, 0.6);
/// let forces: Nodal<f64> = vec![1.0, 2.0, 1.0].into();
/// assert!(forces.check_len(3).is_ok());
/// assert!(forces.check_len(4).is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Nodal<T> {
    /// One value for all vertices.
    Uniform(T),
    /// The value of vertex `i` at position `i`.
    PerVertex(Vec<T>),
}

impl<T> Nodal<T> {
    /// The value at a vertex.
    ///
    /// # Panics
    ///
    /// If the values are per vertex and there is none for this one;
    /// [`check_len`](Self::check_len) excludes it.
    #[must_use]
    pub fn at(&self, vertex: usize) -> &T {
        match self {
            Self::Uniform(value) => value,
            Self::PerVertex(values) => &values[vertex],
        }
    }

    /// The values stored: a single one if uniform.
    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        match self {
            Self::Uniform(value) => std::slice::from_ref(value).iter(),
            Self::PerVertex(values) => values.iter(),
        }
    }

    /// Checks that there is a value for each of so many vertices, and none beyond.
    ///
    /// # Errors
    ///
    /// [`FrictionError::Length`] with both numbers.
    pub fn check_len(&self, vertices: usize) -> Result<(), FrictionError> {
        match self {
            Self::PerVertex(values) if values.len() != vertices => Err(FrictionError::Length {
                expected: vertices,
                found: values.len(),
            }),
            _ => Ok(()),
        }
    }
}

impl<T> From<T> for Nodal<T> {
    fn from(value: T) -> Self {
        Self::Uniform(value)
    }
}

impl<T> From<Vec<T>> for Nodal<T> {
    fn from(values: Vec<T>) -> Self {
        Self::PerVertex(values)
    }
}

impl<'a, T> IntoIterator for &'a Nodal<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
