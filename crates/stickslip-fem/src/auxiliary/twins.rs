//! Vertices that coincide on the sides of faults: a coarser level keeps all of them or none.

use crate::Mesh;
use crate::cut::coinciding;

/// The next of the vertices that coincide with each vertex, in a circle; itself if there is no other.
pub(super) struct Twins(Vec<u32>);

impl Twins {
    pub(super) fn of<const D: usize>(mesh: &Mesh<D>) -> Self {
        let copies = coinciding(&mesh.surfaces.cuts, mesh.vertex_count());
        let mut next: Vec<u32> = (0..copies.len() as u32).collect();
        for (p, &first) in copies.iter().enumerate() {
            if p != first as usize {
                next.swap(p, first as usize);
            }
        }
        Self(next)
    }

    /// A vertex and those that coincide with it.
    pub(super) fn with(&self, p: usize) -> impl Iterator<Item = usize> + '_ {
        let others = std::iter::successors(Some(self.0[p] as usize), |&q| Some(self.0[q] as usize));
        std::iter::once(p).chain(others.take_while(move |&q| q != p))
    }

    /// The twins of some vertices, in their order, of which all that coincide are there.
    pub(super) fn among(&self, chosen: &[u32]) -> Self {
        let number = |p: u32| chosen.partition_point(|&q| q < p) as u32;
        let next = chosen.iter().map(|&p| number(self.0[p as usize]));
        Self(next.collect())
    }
}
