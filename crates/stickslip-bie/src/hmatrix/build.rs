//! Evaluates the blocks of a hierarchical matrix, in threads if the feature `rayon` is on.

use super::approximation::Approximation;
use super::entries::Entries;
use super::error::HMatrixError;
use super::far::{FarBlock, Found, Numbers, find};
use super::panels::Factor;
use super::partition::Partition;
use super::strip::{FarRows, Near, Strip};
use super::tree::ClusterTree;

/// Blocks, and what their making took.
pub(super) struct Built {
    pub(super) strips: Vec<Strip>,
    pub(super) blocks: Vec<FarBlock>,
    /// Pairs of receiver and source evaluated.
    pub(super) pairs: u64,
}

/// A far block as products need it: its parts in leaves of receivers.
enum Compressed {
    LowRank(FarBlock, Vec<(usize, Factor)>),
    Dense(Vec<(usize, Near)>),
}

/// Makes all blocks; far ones that have been found already are taken from `found`.
pub(super) fn build<E: Entries>(
    entries: &E,
    trees: [&ClusterTree; 2],
    partition: &Partition,
    found: Vec<Option<Found>>,
    approximation: &Approximation,
) -> Result<Built, HMatrixError> {
    let positions = |leaf: &usize| trees[0].clusters[*leaf].positions.clone();
    let strips = trees[0]
        .leaves
        .iter()
        .map(|leaf| Strip::new(positions(leaf)));
    let mut built = Built {
        strips: strips.collect(),
        blocks: Vec::new(),
        pairs: 0,
    };
    let near = in_threads(partition.near.iter().collect(), |&block| {
        Near::of(entries, trees, block)
    });
    for (&[receivers, _], near) in partition.near.iter().zip(near) {
        let (near, strip) = (near?, trees[0].leaves_of(receivers).start);
        let strip = &mut built.strips[strip];
        built.pairs += (strip.receivers.len() * near.sources.len()) as u64;
        strip.near.push(near);
    }
    let far = partition.far.iter().zip(found).collect();
    let far = in_threads(far, |(&block, found)| {
        let found = match found {
            Some(found) => found,
            None => find(entries, trees, block, approximation)?,
        };
        let compressed = compress(&found.numbers, trees, block, entries.shape(), approximation);
        Ok::<_, HMatrixError>((compressed, found.pairs))
    });
    for found in far {
        let (compressed, pairs) = found?;
        built.pairs += pairs as u64;
        built.add(compressed);
    }
    Ok(built)
}

impl Built {
    fn add(&mut self, compressed: Compressed) {
        match compressed {
            Compressed::LowRank(block, rows) => {
                // A block of zeros adds nothing.
                if block.rank > 0 {
                    for (leaf, left) in rows {
                        let block = self.blocks.len();
                        self.strips[leaf].far.push(FarRows { block, left });
                    }
                    self.blocks.push(block);
                }
            }
            Compressed::Dense(parts) => {
                for (leaf, near) in parts {
                    self.strips[leaf].near.push(near);
                }
            }
        }
    }
}

/// The parts of a block in leaves of receivers.
fn compress(
    numbers: &Numbers,
    trees: [&ClusterTree; 2],
    [receivers, sources]: [usize; 2],
    shape: [usize; 2],
    approximation: &Approximation,
) -> Compressed {
    let single = approximation.single_precision;
    let begin = trees[0].clusters[receivers].positions.start;
    let sources = trees[1].clusters[sources].positions.clone();
    let leaves = trees[0].leaves_of(receivers).map(|leaf| {
        let own = &trees[0].clusters[trees[0].leaves[leaf]].positions;
        let rows = shape[0] * (own.start - begin)..shape[0] * (own.end - begin);
        (leaf, rows)
    });
    match numbers {
        Numbers::LowRank(singular) => {
            let rank = singular.rank(approximation.tolerance);
            let factors = singular.factors(rank);
            let parts = leaves.map(|(leaf, rows)| {
                let entry = |row, k| factors.left[(rows.start + row, k)];
                (leaf, Factor::new(single, [rows.len(), rank], entry))
            });
            let parts = parts.collect();
            Compressed::LowRank(FarBlock::new(&factors, sources, single), parts)
        }
        Numbers::Dense(dense) => {
            let width = shape[1] * sources.len();
            let parts = leaves.map(|(leaf, rows)| {
                let rows = &dense[rows.start * width..rows.end * width];
                (leaf, Near::from_rows(rows, width, sources.clone()))
            });
            Compressed::Dense(parts.collect())
        }
    }
}

/// What becomes of each item, in their order.
pub(super) fn in_threads<T: Send, U: Send>(
    items: Vec<T>,
    work: impl Fn(T) -> U + Sync + Send,
) -> Vec<U> {
    #[cfg(feature = "rayon")]
    {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        items.into_par_iter().map(work).collect()
    }
    #[cfg(not(feature = "rayon"))]
    items.into_iter().map(work).collect()
}
