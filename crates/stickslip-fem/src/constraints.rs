use crate::{FemError, Trace};

/// Which components of which vertices are prescribed.
///
/// ```
/// use stickslip_fem::{Constraints, P1};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let mut held = Constraints::<2>::none(space.vertex_count());
/// held.hold(&space.trace(|x| x[1] == 1.0)?, [true, true])?;
/// held.hold(&space.trace(|x| x[1] == 0.0)?, [false, true])?;
/// assert_eq!(held.as_slice().iter().flatten().filter(|held| **held).count(), 18);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraints<const C: usize> {
    held: Vec<[bool; C]>,
}

impl<const C: usize> Constraints<C> {
    /// All components of so many vertices free.
    pub fn none(vertices: usize) -> Self {
        Self {
            held: vec![[false; C]; vertices],
        }
    }

    /// Prescribes components on a part of the boundary, in addition to what is prescribed already.
    ///
    /// # Errors
    ///
    /// [`FemError::VertexCount`] if the trace is of a mesh with another number of vertices.
    pub fn hold<const D: usize>(
        &mut self,
        trace: &Trace<D>,
        components: [bool; C],
    ) -> Result<(), FemError> {
        if trace.space_vertex_count() != self.held.len() {
            return Err(FemError::VertexCount {
                expected: self.held.len(),
                found: trace.space_vertex_count(),
            });
        }
        for &p in trace.vertices() {
            for (held, component) in self.held[p].iter_mut().zip(components) {
                *held |= component;
            }
        }
        Ok(())
    }

    /// For each vertex, which of its components are prescribed.
    pub fn as_slice(&self) -> &[[bool; C]] {
        &self.held
    }
}
