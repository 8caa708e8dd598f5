//! The cells of segments as receivers and sources of stress.

use nalgebra::{SMatrix, SVector};

use super::Segments;
use super::influence::{Influence, Traction};
use crate::Mode;
use crate::hmatrix::Extent;
use crate::interaction::{Pair, Pairs};

/// The cells with their influence.
pub(super) struct SegmentPairs<'a> {
    pub(super) segments: &'a Segments,
    pub(super) influence: Influence,
    pub(super) mode: Mode,
}

impl Pairs<1> for SegmentPairs<'_> {
    fn count(&self) -> usize {
        self.segments.count()
    }

    fn extents(&self) -> Vec<Extent> {
        let cells = 0..self.segments.count();
        let ends = cells.map(|cell| self.segments.ends(cell).map(|[x, z]| [x, z, 0.0]));
        ends.map(Extent::of_points).collect()
    }

    fn size(&self, cell: usize) -> f64 {
        self.segments.length(cell)
    }

    fn changes_normal_stress(&self) -> bool {
        self.mode != Mode::Antiplane
    }

    fn pair(&self, receiver: usize, source: usize) -> Pair<1> {
        let Traction { shear, normal } = self.influence.traction(receiver, source);
        (SMatrix::from([[shear]]), SVector::from([normal]))
    }
}
