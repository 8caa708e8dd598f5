//! The rows of a leaf of receivers: each is owned by one thread, which adds near blocks and far blocks in their order.

use std::ops::Range;

use super::entries::{Entries, Lines};
use super::error::HMatrixError;
use super::panels::{Factor, Panels};
use super::tree::ClusterTree;

/// The rows of a leaf of receivers.
#[derive(Debug)]
pub(super) struct Strip {
    /// Positions of receivers.
    pub(super) receivers: Range<usize>,
    pub(super) near: Vec<Near>,
    pub(super) far: Vec<FarRows>,
}

/// All numbers of the leaf due to some sources.
#[derive(Debug)]
pub(super) struct Near {
    /// Positions of sources.
    pub(super) sources: Range<usize>,
    pub(super) values: Panels<f64>,
}

/// The rows of a far block's left factor.
#[derive(Debug)]
pub(super) struct FarRows {
    pub(super) block: usize,
    pub(super) left: Factor,
}

impl Near {
    /// Evaluates all pairs.
    pub(super) fn of<E: Entries>(
        entries: &E,
        trees: [&ClusterTree; 2],
        [receivers, sources]: [usize; 2],
    ) -> Result<Self, HMatrixError> {
        let mut lines = Lines::new(
            entries,
            [trees[0].cells_of(receivers), trees[1].cells_of(sources)],
        );
        let dense = lines.dense()?;
        let sources = trees[1].clusters[sources].positions.clone();
        Ok(Self::from_rows(&dense, lines.size()[1], sources))
    }

    /// From rows of a width.
    pub(super) fn from_rows(dense: &[f64], width: usize, sources: Range<usize>) -> Self {
        let size = [dense.len() / width, width];
        let values = Panels::new(size, |row, column| dense[row * width + column]);
        Self { sources, values }
    }
}

impl Strip {
    pub(super) fn new(receivers: Range<usize>) -> Self {
        Self {
            receivers,
            near: Vec::new(),
            far: Vec::new(),
        }
    }

    /// The numbers that a product reads.
    pub(super) fn len(&self) -> usize {
        let near: usize = self.near.iter().map(|near| near.values.len()).sum();
        let far: usize = self.far.iter().map(|far| far.left.len()).sum();
        near + far
    }

    /// The near block of the source at a position.
    pub(super) fn near_of(&self, source: usize) -> Option<usize> {
        (self.near.iter()).position(|near| near.sources.contains(&source))
    }
}
