//! What a hierarchical matrix takes.

use std::fmt;

use super::HMatrix;
use super::extent::Extent;

/// The size of a hierarchical matrix, and the work to make it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Compression {
    /// Receivers and sources.
    pub cells: [usize; 2],
    /// The box of receivers and sources \[m\].
    pub extent: Extent,
    /// The relative tolerance of far blocks.
    pub tolerance: f64,
    /// The memory of all blocks \[bytes\].
    pub bytes: u64,
    /// The memory of near blocks \[bytes\].
    pub near_bytes: u64,
    /// The memory of the dense matrix in double precision \[bytes\].
    pub dense_bytes: u64,
    /// Far blocks that are not zero.
    pub far_blocks: usize,
    /// The mean rank of far blocks that are not zero.
    pub mean_rank: f64,
    /// The largest rank of a far block.
    pub largest_rank: usize,
    /// Pairs of receiver and source evaluated.
    pub pairs_evaluated: u64,
}

impl Compression {
    /// The memory, as a share of that of the dense matrix.
    pub fn stored_share(&self) -> f64 {
        self.bytes as f64 / self.dense_bytes as f64
    }

    /// The pairs evaluated, as a share of all pairs.
    pub fn evaluated_share(&self) -> f64 {
        let [receivers, sources] = self.cells.map(|count| count as f64);
        self.pairs_evaluated as f64 / (receivers * sources)
    }
}

impl fmt::Display for Compression {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [receivers, sources] = self.cells;
        let [x, y, z] = self.extent.lengths();
        write!(
            formatter,
            "{receivers} x {sources} cells in a box of {x:.4e} x {y:.4e} x {z:.4e} m: stored {:.1} % of dense ({:.1} MB), mean rank {:.1}, \
             largest {}, {:.1} % of pairs evaluated, tolerance {:e}",
            100.0 * self.stored_share(),
            self.bytes as f64 / 1e6,
            self.mean_rank,
            self.largest_rank,
            100.0 * self.evaluated_share(),
            self.tolerance,
        )
    }
}

impl HMatrix {
    /// What the matrix takes.
    pub fn compression(&self) -> Compression {
        let near = self.strips.iter().flat_map(|strip| &strip.near);
        let near_bytes = near.map(|near| near.values.bytes()).sum();
        let far = self.strips.iter().flat_map(|strip| &strip.far);
        let left: u64 = far.map(|far| far.left.bytes()).sum();
        let right: u64 = self.blocks.iter().map(|block| block.right.bytes()).sum();
        let ranks = self.blocks.iter().map(|block| block.rank);
        let [receivers, sources] = self.cells();
        Compression {
            cells: [receivers, sources],
            extent: Extent::of_boxes(
                [&self.receivers, &self.sources].map(|tree| tree.clusters[0].extent),
            ),
            tolerance: self.approximation.tolerance(),
            bytes: near_bytes + left + right,
            near_bytes,
            dense_bytes: 8 * [receivers, sources, self.shape[0], self.shape[1]]
                .map(|n| n as u64)
                .iter()
                .product::<u64>(),
            far_blocks: self.blocks.len(),
            mean_rank: ranks.clone().sum::<usize>() as f64 / self.blocks.len().max(1) as f64,
            largest_rank: ranks.max().unwrap_or(0),
            pairs_evaluated: self.pairs,
        }
    }
}
