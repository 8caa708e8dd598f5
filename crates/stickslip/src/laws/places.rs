//! The vertices that a contact keeps of its boundary part.

use stickslip_friction::Nodal;

use crate::SceneError;

/// Some places among the vertices of a boundary part, in the order of their vertices.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Places {
    /// The number of all vertices.
    pub(crate) count: usize,
    pub(crate) places: Vec<usize>,
}

impl Places {
    /// The values at the places among those of all vertices.
    pub(crate) fn select<T>(
        &self,
        what: &'static str,
        values: Nodal<T>,
    ) -> Result<Nodal<T>, SceneError> {
        let Nodal::PerVertex(values) = values else {
            return Ok(values);
        };
        if values.len() != self.count {
            return Err(SceneError::Length {
                what,
                expected: self.count,
                found: values.len(),
            });
        }
        let mut values: Vec<_> = values.into_iter().map(Some).collect();
        let kept = self.places.iter().filter_map(|&k| values[k].take());
        Ok(Nodal::PerVertex(kept.collect()))
    }

    /// The vertices at places among those at these.
    pub(crate) fn at(&self, places: &Self) -> Self {
        let places = places.places.iter().map(|&k| self.places[k]);
        Self {
            count: self.count,
            places: places.collect(),
        }
    }
}
