//! The memory of a hierarchical matrix, before it is taken.

use super::approximation::Approximation;
use super::build::in_threads;
use super::entries::Entries;
use super::error::HMatrixError;
use super::far::{Found, Numbers, find};
use super::partition::Partition;
use super::tree::ClusterTree;

/// Far blocks that are sampled.
const SAMPLES: usize = 64;

/// Refuses a matrix that takes more memory than its limit; far blocks that have been found are returned.
///
/// Near blocks are known. Ranks of far blocks are those of a sample, in which a block is as likely as its factors are large.
pub(super) fn check_memory<E: Entries>(
    entries: &E,
    trees: [&ClusterTree; 2],
    partition: &Partition,
    approximation: &Approximation,
) -> Result<Vec<Option<Found>>, HMatrixError> {
    let shape = entries.shape();
    let count = |block: &[usize; 2], side: usize| {
        (shape[side] * trees[side].cells_of(block[side]).len()) as u64
    };
    let near = partition.near.iter();
    let near: u64 = near
        .map(|block| 8 * count(block, 0) * count(block, 1))
        .sum();
    let limit = approximation.memory_limit;
    let refused = |needed: u64, fitting: Option<f64>| HMatrixError::Memory {
        needed,
        limit,
        tolerance: approximation.tolerance,
        fitting,
    };
    if near > limit {
        return Err(refused(near, None));
    }
    let lengths = partition.far.iter();
    let lengths: Vec<u64> = lengths
        .map(|block| count(block, 0) + count(block, 1))
        .collect();
    let sample = sample(&lengths);
    let blocks = sample.iter().map(|&(block, _)| block).collect();
    let mut found: Vec<Option<Found>> = partition.far.iter().map(|_| None).collect();
    let sampled = in_threads(blocks, |block: usize| {
        find(entries, trees, partition.far[block], approximation)
    });
    for (&(block, _), sampled) in sample.iter().zip(sampled) {
        found[block] = Some(sampled?);
    }
    let total: u64 = lengths.iter().sum();
    let drawn: usize = sample.iter().map(|(_, drawn)| drawn).sum();
    let far = |tolerance: f64| {
        // Bytes per row and column.
        let bytes = |&(block, drawn): &(usize, usize)| {
            let [rows, columns] = [0, 1].map(|side| count(&partition.far[block], side) as f64);
            let bytes = match &found[block].as_ref()?.numbers {
                Numbers::LowRank(singular) => {
                    singular.rank(tolerance) as f64 * approximation.bytes_of_number() as f64
                }
                Numbers::Dense(_) => 8.0 * rows * columns / (rows + columns),
            };
            Some(drawn as f64 * bytes)
        };
        let bytes: f64 = sample.iter().filter_map(bytes).sum();
        (bytes / drawn.max(1) as f64 * total as f64) as u64
    };
    let needed = near + far(approximation.tolerance);
    if needed <= limit {
        return Ok(found);
    }
    let fits =
        |&tolerance: &f64| tolerance > approximation.tolerance && near + far(tolerance) <= limit;
    let fitting = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
    Err(refused(needed, fitting.into_iter().find(fits)))
}

/// Blocks at even steps of the sum of lengths, each with how often it has been drawn.
fn sample(lengths: &[u64]) -> Vec<(usize, usize)> {
    let total: u64 = lengths.iter().sum();
    let mut drawn: Vec<(usize, usize)> = Vec::new();
    let (mut next, mut sum) = (0, 0);
    for (block, &length) in lengths.iter().enumerate() {
        sum += length;
        let mut times = 0;
        // The middle of each step.
        while next < SAMPLES && (2 * next as u64 + 1) * total < 2 * SAMPLES as u64 * sum {
            next += 1;
            times += 1;
        }
        if times > 0 {
            drawn.push((block, times));
        }
    }
    drawn
}
