//! Names for parts of the boundary and for groups of cells of a mesh.

use crate::groups::{listed, names};
use crate::{FemError, Mesh};

impl<const D: usize> Mesh<D> {
    /// Names a part of the boundary by its faces, each the D vertices in any order. Parts may overlap. Refined meshes
    /// have the same parts.
    ///
    /// # Errors
    ///
    /// [`FemError::NotOnBoundary`], [`FemError::Repeated`], [`FemError::Empty`], or
    /// [`FemError::RepeatedName`] if there is such a part or surface.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh, P1};
    ///
    /// let strip = Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising)?;
    /// let space = P1::new(strip.with_part("fault", &[[0, 2], [4, 2]])?).refined(3)?;
    /// assert_eq!(space.part("fault")?, space.trace(|x| x[1] == 0.0)?);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn with_part(
        mut self,
        name: impl Into<String>,
        faces: &[[u32; D]],
    ) -> Result<Self, FemError> {
        let part = name.into();
        let sorted = |mut face: [u32; D]| {
            face.sort_unstable();
            face
        };
        let mut wanted: Vec<([u32; D], usize)> = (faces.iter().enumerate())
            .map(|(index, &face)| (sorted(face), index))
            .collect();
        wanted.sort_unstable();
        if let Some(same) = wanted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let indices = [same[0].1, same[1].1];
            return Err(FemError::Repeated {
                what: "faces of the part",
                places: indices,
                name: part,
            });
        }
        let mut found = vec![false; wanted.len()];
        let mut members = Vec::with_capacity(wanted.len());
        for (place, &face) in self.boundary.iter().enumerate() {
            if let Ok(k) = wanted.binary_search_by_key(&sorted(face), |&(face, _)| face) {
                found[k] = true;
                members.push(place);
            }
        }
        let missing = wanted.iter().zip(&found).filter(|(_, found)| !**found);
        if let Some(index) = missing.map(|((_, index), _)| *index).min() {
            let has = |cell: &&[u32]| faces[index].iter().all(|p| cell.contains(p));
            return Err(FemError::NotOnBoundary {
                part,
                index,
                face: faces[index].to_vec(),
                cells: self.cells().filter(has).count(),
            });
        }
        if self.has_surface(&part) {
            return Err(FemError::RepeatedName { name: part });
        }
        self.groups.add_part(part, members)?;
        Ok(self)
    }

    /// Names a group of cells, a material for instance. Groups may overlap, and need not fill the mesh. In refined
    /// meshes the group has the children of its cells.
    ///
    /// # Errors
    ///
    /// [`FemError::OutOfRange`], [`FemError::Repeated`], [`FemError::Empty`], or
    /// [`FemError::RepeatedName`] if there is such a group of cells.
    pub fn with_material(
        mut self,
        name: impl Into<String>,
        cells: &[usize],
    ) -> Result<Self, FemError> {
        let material = name.into();
        let count = self.cell_count();
        if let Some(&cell) = cells.iter().find(|&&cell| cell >= count) {
            return Err(FemError::OutOfRange {
                what: "cell",
                index: cell,
                count,
                by: format!("material {material:?}"),
            });
        }
        let mut members = cells.to_vec();
        members.sort_unstable();
        if let Some(same) = members.windows(2).find(|pair| pair[0] == pair[1]) {
            let mut places = (0..cells.len()).filter(|&k| cells[k] == same[0]);
            let places = std::array::from_fn(|_| places.next().unwrap_or(0));
            return Err(FemError::Repeated {
                what: "cells of the material",
                places,
                name: material,
            });
        }
        self.groups.add_material(material, members)?;
        Ok(self)
    }

    /// The positions of the faces of a named part in the boundary, increasing.
    pub(crate) fn faces_of(&self, name: &str) -> Result<&[usize], FemError> {
        let Some((_, places)) = self.parts().find(|(part, _)| *part == name) else {
            return Err(FemError::Unknown {
                what: "part of the boundary",
                name: name.to_owned(),
                known: names(&self.groups.parts),
            });
        };
        Ok(places)
    }

    /// The named parts of the boundary: names, and positions in [`Mesh::boundary`], increasing.
    pub fn parts(&self) -> impl Iterator<Item = (&str, &[usize])> {
        listed(&self.groups.parts)
    }

    /// The named groups of cells: names, and cells, increasing.
    pub fn materials(&self) -> impl Iterator<Item = (&str, &[usize])> {
        listed(&self.groups.materials)
    }
}
