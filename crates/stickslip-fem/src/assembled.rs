use std::ops::{Deref, DerefMut, Mul};
use std::sync::Arc;

use crate::fingerprint::same_mesh;
use crate::identity::MeshIdentity;
use crate::{BlockMatrix, FemError, Mesh, SplitSurface};

/// A matrix with the identity of its mesh, by which a scene refuses parts and matrices of another mesh.
///
/// It dereferences to its [`BlockMatrix`], and may be changed like it: additions still act on the vertices of that
/// mesh. The sum of two has no mesh; a scene adds viscosities itself.
///
/// ```
/// use stickslip_fem::{BlockMatrix, P1, antiplane};
///
/// let space = P1::grid([2.0, 2.0], [2, 2])?;
/// let mut stiffness = antiplane(&space, 1.0)?;
/// // A spring to the ground at vertex 4.
/// if let Some(diagonal) = stiffness.get_mut(4, 4) {
///     diagonal[0] += 1.0;
/// }
/// assert_eq!(stiffness.mesh(), space.mesh().identity());
/// let twice: BlockMatrix<1> = (&stiffness * 2.0).into_matrix();
/// assert_eq!(twice.get(4, 4).map(|block| block[0]), Some(10.0));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled<const C: usize> {
    matrix: BlockMatrix<C>,
    mesh: MeshIdentity,
    splits: Arc<[SplitSurface]>,
}

impl<const C: usize> Assembled<C> {
    pub(crate) fn on<const D: usize>(mesh: &Mesh<D>, matrix: BlockMatrix<C>) -> Self {
        Self {
            matrix,
            mesh: mesh.identity(),
            splits: mesh.split_surfaces().into(),
        }
    }

    /// Another matrix on the same mesh.
    pub(crate) fn with<const B: usize>(&self, matrix: BlockMatrix<B>) -> Assembled<B> {
        Assembled {
            matrix,
            mesh: self.mesh,
            splits: Arc::clone(&self.splits),
        }
    }

    /// The [identity](Mesh::identity) of its mesh.
    pub fn mesh(&self) -> MeshIdentity {
        self.mesh
    }

    /// The surfaces along which the mesh was split.
    pub fn split_surfaces(&self) -> &[SplitSurface] {
        &self.splits
    }

    /// Refuses a mesh other than its own.
    ///
    /// # Errors
    ///
    /// [`FemError::Mesh`].
    pub fn check_mesh<const D: usize>(&self, mesh: &Mesh<D>) -> Result<(), FemError> {
        same_mesh("matrix", mesh.identity(), self.mesh)
    }

    /// The matrix alone.
    pub fn into_matrix(self) -> BlockMatrix<C> {
        self.matrix
    }
}

impl<const C: usize> Deref for Assembled<C> {
    type Target = BlockMatrix<C>;

    fn deref(&self) -> &BlockMatrix<C> {
        &self.matrix
    }
}

impl<const C: usize> DerefMut for Assembled<C> {
    fn deref_mut(&mut self) -> &mut BlockMatrix<C> {
        &mut self.matrix
    }
}

/// The multiple on the same mesh: Rayleigh's damping is `&mass * alpha` and `&stiffness * beta`.
impl<const C: usize> Mul<f64> for &Assembled<C> {
    type Output = Assembled<C>;

    fn mul(self, factor: f64) -> Assembled<C> {
        let mut product = self.clone();
        for block in product.data_mut() {
            *block *= factor;
        }
        product
    }
}
