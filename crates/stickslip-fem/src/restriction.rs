//! Restriction of a mesh to some of its cells.

use crate::bisection::Marks;
use crate::boundary::boundary_faces;
use crate::fingerprint::fingerprint;
use crate::groups::Groups;
use crate::surfaces::Surfaces;
use crate::{FemError, Mesh};

impl<const D: usize> Mesh<D> {
    /// The mesh of the kept cells, in their order, with their vertices in theirs.
    ///
    /// Both meshes are refined alike: a common cell has the same children. Faces to dropped cells belong to the
    /// boundary. Names of parts and surfaces are dropped.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh};
    ///
    /// let mesh = Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising)?;
    /// let left = mesh.restricted(|cell| cell < 2)?;
    /// assert_eq!((left.cell_count(), left.vertex_count(), left.boundary().len()), (2, 4, 4));
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Errors
    /// [`FemError::Empty`] if no cell is kept.
    pub fn restricted(&self, keep: impl Fn(usize) -> bool) -> Result<Self, FemError> {
        const UNUSED: u32 = u32::MAX;
        let kept: Vec<usize> = (0..self.cell_count()).filter(|&cell| keep(cell)).collect();
        if kept.is_empty() {
            return Err(FemError::empty("cells"));
        }
        let mut numbers = vec![UNUSED; self.vertex_count()];
        for &vertex in kept.iter().flat_map(|&cell| self.cell(cell)) {
            numbers[vertex as usize] = 0;
        }
        let mut vertices = Vec::new();
        for (number, &vertex) in numbers.iter_mut().zip(&self.vertices) {
            if *number != UNUSED {
                *number = vertices.len() as u32;
                vertices.push(vertex);
            }
        }
        let corners = kept.iter().flat_map(|&cell| self.cell(cell));
        let cells: Vec<u32> = corners.map(|&vertex| numbers[vertex as usize]).collect();
        let marks = match &self.marks {
            Marks::Reflected(mirrored) => {
                Marks::Reflected(kept.iter().map(|&cell| mirrored[cell]).collect())
            }
            Marks::Bisected(tags) => Marks::Bisected(kept.iter().map(|&cell| tags[cell]).collect()),
        };
        Ok(Self {
            fingerprint: fingerprint(&vertices, &cells),
            boundary: boundary_faces(&cells)?,
            vertices,
            cells,
            marks,
            groups: Groups::default(),
            surfaces: Surfaces::default(),
        })
    }
}
