//! Parts of planes as contacts.

use stickslip_solvers::MeshId;

use super::FaultSystem;
use crate::{KernelError, Rectangles, Section};

/// Some cells of a plane of a [`FaultSystem`] as a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemSection {
    plane: usize,
    section: Section<Rectangles>,
    vertices: Vec<usize>,
    points: Vec<[f64; 3]>,
    system: MeshId,
}

impl SystemSection {
    /// The plane, from 0.
    pub fn plane(&self) -> usize {
        self.plane
    }

    /// The vertices of the system's operators, increasing.
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The cells of the plane.
    pub fn cells(&self) -> &Rectangles {
        self.section.cells()
    }

    /// The centre of each cell, east, north and up from the surface \[m\].
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The value of a function of position on the plane \[m\], along strike and down dip, at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 2]) -> T) -> Vec<T> {
        self.section.map(value)
    }

    /// The identity of the system, see [`FaultSystem::identity`].
    pub fn identity(&self) -> MeshId {
        self.system
    }
}

impl<const C: usize> FaultSystem<C> {
    /// The cells of a plane whose centres \[m\] are inside, by their positions along strike and down dip.
    ///
    /// # Errors
    /// [`KernelError`] if no centre is inside, and for a plane that does not exist.
    pub fn section(
        &self,
        plane: usize,
        inside: impl FnMut([f64; 2]) -> bool,
    ) -> Result<SystemSection, KernelError> {
        let Some(of_plane) = self.planes.get(plane) else {
            let what = "number of a section's plane";
            let error = KernelError::new(what, "less than", plane as f64);
            return Err(error.bound(self.planes.len() as f64));
        };
        let section = (of_plane.section(inside)).map_err(|error| error.of_plane(plane))?;
        let first = self.ranges[plane].start;
        let vertices: Vec<_> = (section.vertices().iter().map(|cell| first + cell)).collect();
        Ok(SystemSection {
            plane,
            points: vertices.iter().map(|&vertex| self.center(vertex)).collect(),
            section,
            vertices,
            system: self.identity(),
        })
    }

    /// The identity by which parts of a scene are matched: the number of cells, and the [fingerprint](Self::fingerprint).
    pub fn identity(&self) -> MeshId {
        MeshId {
            vertices: self.vertex_count(),
            elements: None,
            fingerprint: self.fingerprint(),
        }
    }

    /// A fingerprint that other planes do not have, as far as 64 bits allow: of their cells, dips and places, and
    /// of the surface.
    pub fn fingerprint(&self) -> u64 {
        // FNV-1a over words, as that of `Cells`.
        let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
        for (plane, placement) in self.planes.iter().zip(&self.placements) {
            let [east, north] = placement.origin;
            let numbers = [plane.dip().unwrap_or(0.0), placement.strike, east, north];
            let words = numbers.map(f64::to_bits);
            for word in [plane.cells().fingerprint()].into_iter().chain(words) {
                hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
        if let Some(surface) = &self.surface {
            hash = (hash ^ surface.cells().fingerprint()).wrapping_mul(0x0000_0100_0000_01b3);
        }
        hash
    }
}
