//! Restriction of a mesh to some of its cells.

use std::collections::{HashMap, HashSet};

use crate::boundary::boundary_faces;
use crate::cut::Cut;
use crate::fingerprint::fingerprint;
use crate::marks::Marks;
use crate::surfaces::{Surfaces, sorted};
use crate::{FemError, Mesh};

impl<const D: usize> Mesh<D> {
    /// The mesh of the kept cells, in their order, with their vertices in theirs.
    ///
    /// Both meshes are refined alike: a common cell has the same children. Faces to dropped cells belong to the
    /// boundary. Parts and materials keep their names, also those of which nothing is left. The sides of a fault keep the
    /// faces of which both sides are left. Surfaces inside are dropped: split the mesh before.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh};
    ///
    /// let mesh = Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising)?.with_part("base", &[[0, 2], [2, 4]])?;
    /// let left = mesh.restricted(|cell| cell < 2)?;
    /// assert_eq!((left.cell_count(), left.vertex_count(), left.boundary().len()), (2, 4, 4));
    /// let base: Vec<_> = left.parts().map(|(name, faces)| (name, faces.len())).collect();
    /// assert_eq!(base, [("base", 1)]);
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
        let boundary: Vec<[u32; D]> = boundary_faces(&cells)?;
        let places: HashMap<[u32; D], usize> = (boundary.iter().enumerate())
            .map(|(place, &face)| (sorted(face), place))
            .collect();
        let place = |old: usize| {
            let face = self.boundary[old].map(|vertex| numbers[vertex as usize]);
            places.get(&sorted(face)).copied()
        };
        let cuts: Vec<_> = (self.surfaces.cuts.iter())
            .map(|cut| cut.restricted(&boundary, place, |vertex| numbers[vertex as usize]))
            .collect();
        // Faces of a side that have lost the opposite one are in no part.
        let sides = |cuts: &[Cut]| -> HashSet<usize> {
            let twins = cuts.iter().flat_map(|cut| &cut.twins);
            twins.flatten().copied().collect()
        };
        let (before, after) = (sides(&self.surfaces.cuts), sides(&cuts));
        let whole = |old: usize| {
            let lost = |place: &usize| before.contains(&old) && !after.contains(place);
            place(old).filter(|place| !lost(place))
        };
        let groups = (self.groups).restricted(whole, |cell| kept.binary_search(&cell).ok());
        Ok(Self {
            fingerprint: fingerprint(&vertices, &cells),
            boundary,
            vertices,
            cells,
            marks,
            groups,
            surfaces: Surfaces {
                inner: Vec::new(),
                cuts,
            },
        })
    }
}
