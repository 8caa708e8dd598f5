//! What a step knows of vertices without friction, and keeps of the others.

use std::ops::Range;

use nalgebra::SVector;

/// The velocities that are known before the velocity problem is solved: those of vertices without friction, of which nothing
/// but their own load is needed.
#[derive(Debug, Clone, Default)]
pub(crate) struct FreeStep<const C: usize> {
    /// The free vertices have the velocity and the acceleration of the new time.
    pub(super) solved: bool,
    /// All others, increasing.
    pub(super) others: Vec<Other<C>>,
}

/// A vertex that the velocity problem moves, with what the pass over all vertices must not change.
#[derive(Debug, Clone)]
pub(super) struct Other<const C: usize> {
    pub(super) vertex: usize,
    pub(super) load: SVector<f64, C>,
    pub(super) velocity: SVector<f64, C>,
    pub(super) acceleration: SVector<f64, C>,
}

impl<const C: usize> FreeStep<C> {
    /// Takes the vertices that are not free, increasing: those of the last step as long as its operator.
    pub(super) fn take_others(&mut self, others: &[usize]) {
        if self.others().eq(others.iter().copied()) {
            return;
        }
        self.others.clear();
        self.others.extend(others.iter().map(|&vertex| Other {
            vertex,
            load: SVector::zeros(),
            velocity: SVector::zeros(),
            acceleration: SVector::zeros(),
        }));
    }

    /// The vertices that the velocity problem moves.
    pub(super) fn others(&self) -> impl Iterator<Item = usize> {
        self.others.iter().map(|other| other.vertex)
    }

    /// The ranges of the free ones among so many vertices.
    pub(super) fn ranges(&self, vertices: usize) -> impl Iterator<Item = Range<usize>> {
        let begins = std::iter::once(0).chain(self.others().map(|vertex| vertex + 1));
        let ends = self.others().chain(std::iter::once(vertices));
        begins.zip(ends).map(|(begin, end)| begin..end)
    }

    /// The others of a part of the vertices.
    pub(super) fn others_in(&self, part: Range<usize>) -> &[Other<C>] {
        let place = |vertex| self.others.partition_point(|other| other.vertex < vertex);
        &self.others[place(part.start)..place(part.end)]
    }
}
