use crate::fingerprint::{PART, same_mesh};
use crate::identity::MeshIdentity;
use crate::{FemError, P1, Trace};

/// Dirichlet conditions: the prescribed components of each vertex.
///
/// ```
/// use stickslip_fem::{Constraints, P1};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let mut held = Constraints::<2>::none(&space);
/// held.fix(&space.trace(|x| x[1] == 1.0)?, [true, true])?;
/// held.fix(&space.trace(|x| x[1] == 0.0)?, [false, true])?;
/// assert_eq!(held.as_slice().iter().flatten().filter(|held| **held).count(), 18);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraints<const C: usize> {
    mesh: MeshIdentity,
    held: Vec<[bool; C]>,
}

impl<const C: usize> Constraints<C> {
    /// All components of all vertices free.
    pub fn none<const D: usize>(space: &P1<D>) -> Self {
        Self {
            mesh: space.mesh().identity(),
            held: vec![[false; C]; space.vertex_count()],
        }
    }

    /// Prescribes components on a part of the boundary, in addition to those prescribed already.
    ///
    /// # Errors
    ///
    /// [`FemError::Mesh`] for a part of another mesh.
    pub fn fix<const D: usize>(
        &mut self,
        trace: &Trace<D>,
        components: [bool; C],
    ) -> Result<(), FemError> {
        same_mesh(PART, self.mesh, trace.mesh())?;
        for &p in trace.vertices() {
            for (held, component) in self.held[p].iter_mut().zip(components) {
                *held |= component;
            }
        }
        Ok(())
    }

    /// The mask of prescribed components of each vertex.
    pub fn as_slice(&self) -> &[[bool; C]] {
        &self.held
    }
}
