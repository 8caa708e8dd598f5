//! Names for parts of the boundary and for groups of cells.

use crate::{FemError, Mesh, P1, Trace};

/// The names of a mesh; two empty lists without any.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Groups {
    parts: Vec<Group>,
    materials: Vec<Group>,
}

/// Positions in [`Mesh::boundary`] or cells, increasing.
#[derive(Clone, Debug, PartialEq)]
struct Group {
    name: String,
    members: Vec<usize>,
}

impl Groups {
    /// The same names on a mesh of children of these faces and cells, in the order of their parents here.
    pub(crate) fn inherited(
        &self,
        faces: impl Iterator<Item = usize> + Clone,
        cells: impl Iterator<Item = usize> + Clone,
    ) -> Self {
        Self {
            parts: (self.parts.iter())
                .map(|group| group.inherited(faces.clone()))
                .collect(),
            materials: (self.materials.iter())
                .map(|group| group.inherited(cells.clone()))
                .collect(),
        }
    }

    /// The same names on a mesh of some of these faces and cells, by their new positions.
    pub(crate) fn restricted(
        &self,
        face: impl Fn(usize) -> Option<usize>,
        cell: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        Self {
            parts: (self.parts.iter())
                .map(|group| group.restricted(&face))
                .collect(),
            materials: (self.materials.iter())
                .map(|group| group.restricted(&cell))
                .collect(),
        }
    }
}

impl Group {
    fn restricted(&self, position: impl Fn(usize) -> Option<usize>) -> Self {
        let mut members: Vec<usize> = (self.members.iter())
            .filter_map(|&old| position(old))
            .collect();
        members.sort_unstable();
        let name = self.name.clone();
        Self { name, members }
    }

    fn inherited(&self, parents: impl Iterator<Item = usize>) -> Self {
        let named = |parent: &usize| self.members.binary_search(parent).is_ok();
        Self {
            name: self.name.clone(),
            members: (parents.enumerate())
                .filter(|(_, parent)| named(parent))
                .map(|(child, _)| child)
                .collect(),
        }
    }
}

impl Groups {
    /// Names some faces of the boundary, by increasing position.
    pub(crate) fn add_part(&mut self, name: String, members: Vec<usize>) -> Result<(), FemError> {
        add(&mut self.parts, name, members)
    }
}

/// Names a list of positions, if the name is new and the list is not empty.
fn add(groups: &mut Vec<Group>, name: String, members: Vec<usize>) -> Result<(), FemError> {
    if members.is_empty() {
        let what = "members of the group";
        return Err(FemError::Empty { what, name });
    }
    if groups.iter().any(|group| group.name == name) {
        return Err(FemError::RepeatedName { name });
    }
    groups.push(Group { name, members });
    Ok(())
}

fn names(groups: &[Group]) -> Vec<String> {
    groups.iter().map(|group| group.name.clone()).collect()
}

fn listed(groups: &[Group]) -> impl Iterator<Item = (&str, &[usize])> {
    (groups.iter()).map(|group| (group.name.as_str(), group.members.as_slice()))
}

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
        add(&mut self.groups.materials, material, members)?;
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

impl<const D: usize> P1<D> {
    /// The part of the boundary named by [`Mesh::with_part`] or by the mesh generator.
    ///
    /// # Errors
    ///
    /// [`FemError::Unknown`], with the list of existing names.
    pub fn part(&self, name: &str) -> Result<Trace<D>, FemError> {
        let mesh = self.mesh();
        Trace::of_faces(mesh, mesh.faces_of(name)?)
    }
}
