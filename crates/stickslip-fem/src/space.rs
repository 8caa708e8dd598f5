use nalgebra::SVector;

use stickslip_core::compiled;

use crate::grid::kuhn;
use crate::numbering::bounding_box;
use crate::{FemError, Hierarchy, Mesh, MeshIdentity, Prolongation, Trace};

/// The space of continuous functions that are linear on each cell of the finest mesh of a hierarchy.
///
/// A field of C components has one `SVector<f64, C>` per vertex; vertex index, block index and row coincide.
///
/// ```
/// use stickslip_fem::P1;
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?.refined(4)?;
/// assert_eq!(space.vertex_count(), 81 * 17);
/// let bottom = space.trace(|x| x[1] == 0.0)?;
/// assert_eq!(bottom.vertices().len(), 81);
/// let centre = space.vertex_at([2.5, 0.0]);
/// assert!(centre.is_some_and(|p| bottom.vertices().contains(&p)));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug)]
#[doc(alias("finite element", "function space"))]
pub struct P1<const D: usize> {
    pub(crate) hierarchy: Hierarchy<D>,
}

/// Distance over diameter of the body up to which a vertex counts as found.
const NEAR: f64 = 1e-10;

impl<const D: usize> P1<D> {
    /// The space on a mesh, which may be refined.
    pub fn new(mesh: Mesh<D>) -> Self {
        on_mesh(mesh)
    }

    /// The part of the boundary named by [`Mesh::with_part`] or by the mesh generator.
    ///
    /// # Errors
    ///
    /// [`FemError::Unknown`], with the list of existing names.
    pub fn part(&self, name: &str) -> Result<Trace<D>, FemError> {
        let mesh = self.mesh();
        Trace::of_faces(mesh, mesh.faces_of(name)?)
    }

    /// The space on a box of the given size \[m\] and number of cells along each axis.
    ///
    /// The meshes are those of [`Mesh::<2>::grid`] with
    /// [`GridDiagonal::Rising`](crate::GridDiagonal::Rising) and of [`Mesh::<3>::grid`],
    /// and so are the errors.
    pub fn grid(size: [f64; D], cells: [usize; D]) -> Result<Self, FemError> {
        grid(size, cells, false)
    }

    /// The mirror image of [`grid`](Self::grid) under a reflection of the first axis: its diagonals fall where those of
    /// `grid` rise, in the plane as on the faces of bricks and inside them.
    ///
    /// # Errors
    /// Those of [`grid`](Self::grid).
    pub fn mirrored_grid(size: [f64; D], cells: [usize; D]) -> Result<Self, FemError> {
        grid(size, cells, true)
    }

    /// This space after so many uniform refinements; errors as [`Hierarchy::refined`].
    pub fn refined(self, levels: usize) -> Result<Self, FemError> {
        refined(self, levels)
    }

    /// This space with auxiliary levels for multigrid, if its first mesh is fine; errors and levels as
    /// [`Hierarchy::with_auxiliary_levels`].
    pub fn with_auxiliary_levels(self) -> Result<Self, FemError> {
        with_auxiliary_levels(self)
    }

    /// The finest mesh.
    pub fn mesh(&self) -> &Mesh<D> {
        self.hierarchy.finest()
    }

    /// All meshes and the transfers between them.
    pub fn hierarchy(&self) -> &Hierarchy<D> {
        &self.hierarchy
    }

    /// The input of multigrid: the finest mesh, and the interpolations up to it, coarsest first. A
    /// space without refinements or [auxiliary levels](P1::with_auxiliary_levels) has no interpolations.
    pub fn transfers(&self) -> (MeshIdentity, &[Prolongation]) {
        (self.mesh().identity(), self.hierarchy.prolongations())
    }

    /// Number of vertices of the finest mesh.
    pub fn vertex_count(&self) -> usize {
        self.mesh().vertex_count()
    }

    /// The part of the boundary of all faces whose vertices all satisfy the predicate.
    ///
    /// On a grid `x[1] == 0.0` and `x[1] == size[1]` are exact; elsewhere compare with a tolerance.
    ///
    /// # Errors
    ///
    /// [`FemError::Empty`] if there is no such face.
    pub fn trace(&self, on: impl Fn(&SVector<f64, D>) -> bool) -> Result<Trace<D>, FemError> {
        Trace::new(self.mesh(), &on)
    }

    /// The vertex at a point \[m\], up to rounding relative to the bounding box.
    pub fn vertex_at(&self, point: [f64; D]) -> Option<usize> {
        let point = SVector::from(point);
        let vertices = self.mesh().vertices();
        let (low, high) = bounding_box(vertices);
        let near = NEAR * (high - low).norm();
        vertices.iter().position(|x| (x - point).norm() <= near)
    }

    /// The nodal interpolant of `function`: its values at the vertices.
    pub fn interpolate<const C: usize>(
        &self,
        function: impl Fn(&SVector<f64, D>) -> SVector<f64, C>,
    ) -> Vec<SVector<f64, C>> {
        self.mesh().vertices().iter().map(function).collect()
    }
}

compiled! {
    fn on_mesh<D in 2, 3>(mesh: Mesh<D>) -> P1<D> {
        P1 {
            hierarchy: Hierarchy::new(mesh),
        }
    }

    fn grid<D in 2, 3>(size: [f64; D], cells: [usize; D], mirrored: bool) -> Result<P1<D>, FemError> {
        kuhn(size, cells, mirrored).map(P1::new)
    }

    fn refined<D in 2, 3>(space: P1<D>, levels: usize) -> Result<P1<D>, FemError> {
        Ok(P1 {
            hierarchy: space.hierarchy.refined(levels)?,
        })
    }

    fn with_auxiliary_levels<D in 2, 3>(space: P1<D>) -> Result<P1<D>, FemError> {
        Ok(P1 {
            hierarchy: space.hierarchy.with_auxiliary_levels()?,
        })
    }
}
