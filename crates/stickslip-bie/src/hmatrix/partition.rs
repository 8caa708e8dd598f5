//! The division of a matrix into blocks of clusters.

use super::tree::ClusterTree;

/// The largest ratio of the smaller diameter to the distance of two clusters that are far from each other.
const ADMISSIBLE: f64 = 2.0;

/// Blocks: a cluster of receivers and one of sources.
#[derive(Debug, Default)]
pub(super) struct Partition {
    /// Clusters at a distance: of low rank.
    pub(super) far: Vec<[usize; 2]>,
    /// Leaves and what is next to them: dense.
    pub(super) near: Vec<[usize; 2]>,
}

impl Partition {
    /// Without far blocks, each leaf of receivers has one near block of all sources.
    pub(super) fn new(
        receivers: &ClusterTree,
        sources: &ClusterTree,
        has_far_blocks: bool,
    ) -> Self {
        let mut partition = Self::default();
        if has_far_blocks {
            partition.divide([receivers, sources], [0, 0]);
        } else {
            let leaves = receivers.leaves.iter();
            partition.near = leaves.map(|&leaf| [leaf, 0]).collect();
        }
        partition
    }

    fn divide(&mut self, trees: [&ClusterTree; 2], [receivers, sources]: [usize; 2]) {
        let clusters = [&trees[0].clusters[receivers], &trees[1].clusters[sources]];
        let [diameter, other] = clusters.map(|cluster| cluster.extent.diameter());
        let distance = clusters[0].extent.distance(&clusters[1].extent);
        if distance > 0.0 && diameter.min(other) <= ADMISSIBLE * distance {
            self.far.push([receivers, sources]);
            return;
        }
        let parts = |halves: Option<[usize; 2]>, whole: usize| halves.unwrap_or([whole, whole]);
        let [of_receivers, of_sources] = clusters.map(|cluster| cluster.halves);
        if of_receivers.is_none() && of_sources.is_none() {
            self.near.push([receivers, sources]);
            return;
        }
        let count = |halves: Option<[usize; 2]>| if halves.is_some() { 2 } else { 1 };
        for &first in &parts(of_receivers, receivers)[..count(of_receivers)] {
            for &second in &parts(of_sources, sources)[..count(of_sources)] {
                self.divide(trees, [first, second]);
            }
        }
    }
}
