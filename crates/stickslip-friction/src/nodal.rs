//! Nodal values: one for the whole frictional boundary, or one per vertex.

/// Data on the frictional boundary: uniform, or one value per vertex.
///
/// ```
/// # use stickslip_friction::{Nodal, Tresca};
/// let same: Nodal<Tresca> = Tresca { coefficient: 0.6 }.into();
/// assert_eq!(same.at(17).coefficient, 0.6);
/// let forces: Nodal<f64> = vec![1.0, 2.0, 1.0].into();
/// assert_eq!((same.count(), forces.count()), (None, Some(3)));
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
    /// If the values are per vertex and this vertex has no value; [`count`](Self::count) returns the number of values.
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

    /// The number of vertices with a value of their own; `None` if uniform, which fits any number.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Uniform(_) => None,
            Self::PerVertex(values) => Some(values.len()),
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
