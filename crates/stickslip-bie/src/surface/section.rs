//! Parts of surfaces as contacts.

use stickslip_solvers::MeshId;

use super::SurfaceFault;
use super::rock::Rock;
use crate::KernelError;

/// Some cells of a [`SurfaceFault`] as a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSection {
    vertices: Vec<usize>,
    points: Vec<[f64; 3]>,
    areas: Vec<f64>,
    surface: MeshId,
}

impl SurfaceSection {
    /// The cells, increasing: the vertices of the operators.
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The centroid of each cell \[m\].
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The area of each cell [m^2].
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The value of a function of position \[m\] at the centroid of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 3]) -> T) -> Vec<T> {
        self.points.iter().copied().map(value).collect()
    }

    /// The identity of the surface, see [`Triangles::identity`](crate::Triangles::identity), or of the system it is in.
    pub fn identity(&self) -> MeshId {
        self.surface
    }

    /// The same cells as vertices of a system, from `first` on.
    pub(crate) fn within(mut self, first: usize, system: MeshId) -> Self {
        self.vertices.iter_mut().for_each(|vertex| *vertex += first);
        self.surface = system;
        self
    }
}

impl<const C: usize> SurfaceFault<C> {
    pub(crate) fn elastic_rock(&self) -> Rock {
        self.rock
    }

    /// The cells whose centroids \[m\] are inside.
    ///
    /// # Errors
    /// [`KernelError`] if no centroid is inside.
    pub fn section(
        &self,
        mut inside: impl FnMut([f64; 3]) -> bool,
    ) -> Result<SurfaceSection, KernelError> {
        let cells = 0..self.cells.count();
        let vertices: Vec<_> = cells
            .filter(|&cell| inside(self.cells.centroid(cell)))
            .collect();
        if vertices.is_empty() {
            let what = "number of cells of a section";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        }
        let of = vertices.iter();
        Ok(SurfaceSection {
            points: of.clone().map(|&cell| self.cells.centroid(cell)).collect(),
            areas: of.map(|&cell| self.cells.area(cell)).collect(),
            vertices,
            surface: self.cells.identity(),
        })
    }
}
