//! Blocks of clusters that are far from each other.

use std::ops::Range;

use super::approximation::Approximation;
use super::cross::crosses;
use super::entries::{Entries, Lines};
use super::error::HMatrixError;
use super::panels::Factor;
use super::recompression::{Factors, Singular};
use super::tree::ClusterTree;

/// What has been found of a far block.
pub(super) struct Found {
    pub(super) numbers: Numbers,
    /// Pairs of receiver and source evaluated.
    pub(super) pairs: usize,
}

/// The numbers of a far block.
pub(super) enum Numbers {
    LowRank(Singular),
    /// Row by row, if a low rank takes as many.
    Dense(Vec<f64>),
}

/// The cross approximation of a block.
pub(super) fn find<E: Entries>(
    entries: &E,
    trees: [&ClusterTree; 2],
    block: [usize; 2],
    approximation: &Approximation,
) -> Result<Found, HMatrixError> {
    let cells = [0, 1].map(|side| trees[side].cells_of(block[side]));
    let mut lines = Lines::new(entries, cells);
    let numbers = match crosses(&mut lines, approximation.tolerance)? {
        Some(crosses) => Numbers::LowRank(Singular::of(&crosses, lines.size())),
        None => Numbers::Dense(lines.dense()?),
    };
    Ok(Found {
        numbers,
        pairs: lines.pairs,
    })
}

/// A block of low rank, less the factor that its strips hold: coefficients `right^T x`.
#[derive(Debug)]
pub(super) struct FarBlock {
    /// Positions of sources.
    pub(super) sources: Range<usize>,
    pub(super) rank: usize,
    /// As many rows as the rank.
    pub(super) right: Factor,
}

impl FarBlock {
    pub(super) fn new(factors: &Factors, sources: Range<usize>, single: bool) -> Self {
        let [width, rank] = [factors.right.nrows(), factors.right.ncols()];
        Self {
            sources,
            rank,
            right: Factor::new(single, [rank, width], |k, j| factors.right[(j, k)]),
        }
    }
}
