//! The cells of a fault as sources.

use nalgebra::{Matrix3, Vector3};

use super::ReceiverError;
use super::blocks::Blocks;
use super::line::Lines;
use super::patches::Patches;
use crate::TriangularDislocation;

/// The least distance of a receiver from an edge of a cell, as a share of the longest edge.
const LEAST: f64 = 1e-9;

/// The cells of a fault as sources: what slip by 1 m of each cell and component does at any point.
///
/// Faults of this crate make them ([`OffFault`](crate::OffFault)). A fault of one's own makes them of triangles.
#[derive(Debug, Clone)]
pub struct Sources<const C: usize> {
    cells: Cells<C>,
    has_surface: bool,
    blocks: Option<Blocks<C>>,
}

#[derive(Debug, Clone)]
pub(crate) enum Cells<const C: usize> {
    Lines(Lines),
    Triangles(Patches<C, 3>),
    Rectangles(Patches<C, 4>),
    /// Rectangles, then triangles.
    Both(Patches<C, 4>, Patches<C, 3>),
}

impl<const C: usize> Cells<C> {
    fn count(&self) -> usize {
        match self {
            Self::Lines(lines) => lines.segments.len(),
            Self::Triangles(patches) => patches.cells.len(),
            Self::Rectangles(patches) => patches.cells.len(),
            Self::Both(rectangles, triangles) => rectangles.cells.len() + triangles.cells.len(),
        }
    }

    fn displacements(&self, cell: usize, at: &Vector3<f64>) -> [Vector3<f64>; C] {
        match self {
            Self::Lines(lines) => [lines.displacement(cell, at); C].map(Into::into),
            Self::Triangles(patches) => patches.displacements(cell, at),
            Self::Rectangles(patches) => patches.displacements(cell, at),
            Self::Both(rectangles, triangles) => match cell.checked_sub(rectangles.cells.len()) {
                Some(cell) => triangles.displacements(cell, at),
                None => rectangles.displacements(cell, at),
            },
        }
    }

    fn stresses(&self, cell: usize, at: &Vector3<f64>) -> [Matrix3<f64>; C] {
        match self {
            Self::Lines(lines) => [lines.stress(cell, at); C],
            Self::Triangles(patches) => patches.stresses(cell, at),
            Self::Rectangles(patches) => patches.stresses(cell, at),
            Self::Both(rectangles, triangles) => match cell.checked_sub(rectangles.cells.len()) {
                Some(cell) => triangles.stresses(cell, at),
                None => rectangles.stresses(cell, at),
            },
        }
    }

    fn length_and_distance(&self, cell: usize, at: &Vector3<f64>) -> [f64; 2] {
        match self {
            Self::Lines(lines) => lines.length_and_distance(cell, at),
            Self::Triangles(patches) => patches.length_and_distance(cell, at),
            Self::Rectangles(patches) => patches.length_and_distance(cell, at),
            Self::Both(rectangles, triangles) => match cell.checked_sub(rectangles.cells.len()) {
                Some(cell) => triangles.length_and_distance(cell, at),
                None => rectangles.length_and_distance(cell, at),
            },
        }
    }
}

impl<const C: usize> Sources<C> {
    pub(crate) fn new(cells: Cells<C>, has_surface: bool) -> Self {
        Self {
            cells,
            has_surface,
            blocks: None,
        }
    }

    /// The same cells as a part of an infinite plane.
    pub(crate) fn of_plane(self, blocks: Blocks<C>) -> Self {
        Self {
            blocks: Some(blocks),
            ..self
        }
    }

    /// Triangles in the same rock, each with the slip vectors of its components.
    ///
    /// ```
    /// use stickslip_bie::{Receivers, Sources, TriangularDislocation};
    ///
    /// let corners = [[0.0, 0.0, -5e3], [4e3, 0.0, -5e3], [0.0, 4e3, -5e3]];
    /// let triangle = TriangularDislocation::half_space(corners, 30e9, 0.25)?;
    /// let sources = Sources::triangles([(triangle, [[1.0, 0.0, 0.0]])]).ok_or("no triangle")?;
    /// let receivers = Receivers::of_sources(sources, &[[1e3, 1e3, 0.0]])?;
    /// let [moved] = receivers.displacement(&[[2.0].into()])?[..] else { panic!() };
    /// assert_eq!(moved, triangle.displacement([2.0, 0.0, 0.0], [1e3, 1e3, 0.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// `None` for no triangle, and for triangles in different rock.
    pub fn triangles(
        triangles: impl IntoIterator<Item = (TriangularDislocation, [[f64; 3]; C])>,
    ) -> Option<Self> {
        let mut triangles = triangles.into_iter().peekable();
        let rock = triangles.peek()?.0.rock();
        let cells = triangles.map(|(triangle, slips)| {
            let same = triangle.rock() == rock;
            same.then(|| (triangle.edges(), slips.map(Vector3::from)))
        });
        let cells = cells.collect::<Option<_>>()?;
        let has_surface = rock.has_surface();
        Some(Self::new(
            Cells::Triangles(Patches { rock, cells }),
            has_surface,
        ))
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.cells.count()
    }

    /// The displacement at a point of slip by 1 m of a cell, by component.
    ///
    /// # Panics
    /// For a cell that does not exist.
    pub fn displacements(&self, cell: usize, at: [f64; 3]) -> [[f64; 3]; C] {
        let moved = self.cells.displacements(cell, &at.into());
        moved.map(Into::into)
    }

    /// The stress at a point of slip by 1 m of a cell, by component [Pa/m], tension positive.
    ///
    /// # Panics
    /// For a cell that does not exist.
    pub fn stresses(&self, cell: usize, at: [f64; 3]) -> [Matrix3<f64>; C] {
        self.cells.stresses(cell, &at.into())
    }

    /// The displacement at a point of slip by 1 m of the whole plane; none if the cells are not on one.
    pub(super) fn displacements_of_plane(&self, at: [f64; 3]) -> Option<[[f64; 3]; C]> {
        let blocks = self.blocks.as_ref()?;
        Some(blocks.displacement(&at.into()).map(Into::into))
    }

    /// Refuses a receiver at which there is no displacement.
    pub(super) fn check(&self, receiver: usize, at: [f64; 3]) -> Result<(), ReceiverError> {
        if let Some(&value) = at.iter().find(|value| !value.is_finite()) {
            return Err(ReceiverError::NotFinite { receiver, value });
        }
        if self.has_surface && at[2] > 0.0 {
            let height = at[2];
            return Err(ReceiverError::AboveSurface { receiver, height });
        }
        let at = Vector3::from(at);
        for cell in 0..self.count() {
            let [length, distance] = self.cells.length_and_distance(cell, &at);
            let least = LEAST * length;
            if distance <= least {
                return Err(ReceiverError::AtEdge {
                    receiver,
                    cell,
                    distance,
                    least,
                });
            }
        }
        Ok(())
    }
}
