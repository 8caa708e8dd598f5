//! The removal of a piece, in the order of its cost.

use std::cmp::Ordering;

/// A removal of a piece, of which the samples before `split` go to the piece before and the others to that behind.
#[derive(Clone, Copy)]
pub(super) struct Removal {
    pub(super) piece: usize,
    /// The version of the piece when the cost was computed.
    pub(super) version: usize,
    pub(super) split: usize,
    /// The rise of the sum of squares [m^2].
    pub(super) cost: f64,
}

impl PartialEq for Removal {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Removal {}

impl PartialOrd for Removal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Removal {
    /// The cheapest is the greatest, which a heap returns first.
    fn cmp(&self, other: &Self) -> Ordering {
        let cost = other.cost.total_cmp(&self.cost);
        cost.then(other.piece.cmp(&self.piece))
    }
}
