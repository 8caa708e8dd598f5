//! Named surfaces inside a mesh, along which it can be split.

use nalgebra::SVector;

use crate::boundary::face;
use crate::surfaces::{Surface, sorted};
use crate::{FemError, Mesh};

/// The cells at a face: the places of its opposite vertices in the list of cells, and their number, of which more than
/// two are not listed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sides {
    pub(crate) places: [usize; 2],
    pub(crate) count: usize,
}

impl<const D: usize> Mesh<D> {
    /// The sides of faces, which are sorted, in their order.
    pub(crate) fn sides(&self, faces: &[[u32; D]]) -> Vec<Sides> {
        let mut on = vec![false; self.vertex_count()];
        for &p in faces.iter().flatten() {
            if let Some(on) = on.get_mut(p as usize) {
                *on = true;
            }
        }
        let mut sides = vec![Sides::default(); faces.len()];
        for (cell, corners) in self.cells().enumerate() {
            if corners.iter().filter(|&&p| on[p as usize]).count() < D {
                continue;
            }
            for place in cell * (D + 1)..(cell + 1) * (D + 1) {
                if let Ok(k) = faces.binary_search(&sorted(face(&self.cells, place))) {
                    let sides = &mut sides[k];
                    if let Some(free) = sides.places.get_mut(sides.count) {
                        *free = place;
                    }
                    sides.count += 1;
                }
            }
        }
        sides
    }

    /// The faces of the boundary that are no sides of cuts.
    pub(crate) fn outer_faces(&self) -> impl Iterator<Item = &[u32; D]> {
        let mut outer = vec![true; self.boundary.len()];
        for &place in self
            .surfaces
            .cuts
            .iter()
            .flat_map(|cut| cut.twins.iter().flatten())
        {
            outer[place] = false;
        }
        let faces = self.boundary.iter().zip(outer);
        faces.filter(|(_, outer)| *outer).map(|(face, _)| face)
    }

    /// Names a surface inside the body by its faces, each the D vertices in any order: a fault along which the mesh can
    /// be [split](Mesh::split), or an interface. Surfaces may overlap and cross. Refined meshes have the same surfaces.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh, P1};
    ///
    /// // Two squares with a fault between them.
    /// let mesh = Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising)?.with_surface("fault", &[[2, 3]])?;
    /// assert_eq!(mesh.surfaces().next(), Some(("fault", &[[2, 3]][..])));
    /// let space = P1::new(mesh.split("fault")?).refined(3)?;
    /// assert_eq!(space.part("fault+")?.points(), space.part("fault-")?.points());
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`FemError::NotInside`], [`FemError::Repeated`], [`FemError::Empty`], or [`FemError::RepeatedName`] if there
    /// is such a surface or part of the boundary.
    #[doc(alias("interface", "inner surface", "fault"))]
    pub fn with_surface(
        self,
        name: impl Into<String>,
        faces: &[[u32; D]],
    ) -> Result<Self, FemError> {
        let name = name.into();
        if self.parts().any(|(part, _)| part == name) {
            return Err(FemError::RepeatedName { name });
        }
        self.with_surface_beside(name, faces)
    }

    /// The same, where a part of the boundary may have the name: that of the faces of one group there.
    pub(crate) fn with_surface_beside(
        self,
        name: String,
        faces: &[[u32; D]],
    ) -> Result<Self, FemError> {
        let mut wanted: Vec<([u32; D], usize)> = (faces.iter().enumerate())
            .map(|(index, &face)| (sorted(face), index))
            .collect();
        wanted.sort_unstable();
        if let Some(same) = wanted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(FemError::Repeated {
                what: "faces of the surface",
                places: [same[0].1, same[1].1],
                name,
            });
        }
        let keys: Vec<[u32; D]> = wanted.iter().map(|&(face, _)| face).collect();
        let sides = self.sides(&keys);
        let missing = wanted.iter().zip(&sides).filter(|(_, s)| s.count != 2);
        if let Some((index, sides)) = missing.map(|(w, s)| (w.1, s)).min_by_key(|m| m.0) {
            return Err(FemError::NotInside {
                surface: name,
                index,
                face: faces[index].to_vec(),
                cells: sides.count,
            });
        }
        self.with_inner_faces(name, keys)
    }

    /// Names a surface inside the body by position \[m\]: all inner faces whose vertices all satisfy the predicate.
    ///
    /// On a grid coordinates of the form size * k / n are exact; elsewhere compare with a tolerance.
    ///
    /// # Errors
    ///
    /// [`FemError::Empty`] if there is no such face, or [`FemError::RepeatedName`] if there is such a surface or part
    /// of the boundary.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh};
    ///
    /// // A vertical fault that ends inside the body.
    /// let mesh = Mesh::<2>::grid([2.0, 1.0], [8, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[0] == 1.0 && x[1] >= 0.5)?;
    /// assert_eq!(mesh.surfaces().map(|(_, faces)| faces.len()).sum::<usize>(), 2);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn with_surface_where(
        self,
        name: impl Into<String>,
        on: impl Fn(&SVector<f64, D>) -> bool,
    ) -> Result<Self, FemError> {
        let on: Vec<bool> = self.vertices.iter().map(on).collect();
        let mut found = Vec::new();
        for (cell, corners) in self.cells().enumerate() {
            if corners.iter().filter(|&&p| on[p as usize]).count() < D {
                continue;
            }
            let places = cell * (D + 1)..(cell + 1) * (D + 1);
            let faces = places.map(|place| sorted(face(&self.cells, place)));
            found.extend(faces.filter(|face| face.iter().all(|&p| on[p as usize])));
        }
        found.sort_unstable();
        // Faces of the boundary are there once.
        let inner = found.chunk_by(|a, b| a == b).filter(|same| same.len() == 2);
        let faces: Vec<[u32; D]> = inner.map(|same| same[0]).collect();
        let name = name.into();
        if self.parts().any(|(part, _)| part == name) {
            return Err(FemError::RepeatedName { name });
        }
        if faces.is_empty() {
            return Err(FemError::Empty {
                what: "inner faces whose vertices satisfy the predicate of the surface",
                name,
            });
        }
        self.with_inner_faces(name, faces)
    }

    /// Adds a surface of faces that are sorted and lie inside.
    fn with_inner_faces(mut self, name: String, faces: Vec<[u32; D]>) -> Result<Self, FemError> {
        if faces.is_empty() {
            let what = "members of the group";
            return Err(FemError::Empty { what, name });
        }
        if self.has_surface(&name) {
            return Err(FemError::RepeatedName { name });
        }
        self.surfaces.inner.push(Surface { name, faces });
        Ok(self)
    }

    pub(crate) fn has_surface(&self, name: &str) -> bool {
        self.surfaces().any(|(surface, _)| surface == name)
    }

    /// The named surfaces inside the body along which it has not been split: names, and faces of increasing vertices.
    pub fn surfaces(&self) -> impl Iterator<Item = (&str, &[[u32; D]])> {
        let inner = self.surfaces.inner.iter();
        inner.map(|surface| (surface.name.as_str(), surface.faces.as_slice()))
    }
}
