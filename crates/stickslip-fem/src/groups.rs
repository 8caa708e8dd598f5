//! Groups of faces of the boundary and of cells, by name.

use crate::FemError;

/// The names of a mesh; two empty lists without any.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Groups {
    pub(crate) parts: Vec<Group>,
    pub(crate) materials: Vec<Group>,
}

/// Positions in the [boundary](crate::Mesh::boundary) or of cells, increasing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Group {
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

    /// Names some cells, increasing.
    pub(crate) fn add_material(
        &mut self,
        name: String,
        members: Vec<usize>,
    ) -> Result<(), FemError> {
        add(&mut self.materials, name, members)
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

pub(crate) fn names(groups: &[Group]) -> Vec<String> {
    groups.iter().map(|group| group.name.clone()).collect()
}

pub(crate) fn listed(groups: &[Group]) -> impl Iterator<Item = (&str, &[usize])> {
    (groups.iter()).map(|group| (group.name.as_str(), group.members.as_slice()))
}
