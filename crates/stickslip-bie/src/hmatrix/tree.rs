//! Clusters of cells: each half of a cluster along the longest side of its box is a cluster, down to leaves.

use std::ops::Range;

use super::extent::Extent;

/// A cluster tree; cluster 0 has all cells.
#[derive(Debug)]
pub(super) struct ClusterTree {
    /// The cell at each position: those of a cluster are contiguous.
    pub(super) cells: Vec<usize>,
    /// The position of each cell.
    pub(super) positions: Vec<usize>,
    pub(super) clusters: Vec<Cluster>,
    /// Clusters without halves, by position.
    pub(super) leaves: Vec<usize>,
}

/// Some cells.
#[derive(Debug)]
pub(super) struct Cluster {
    pub(super) positions: Range<usize>,
    pub(super) extent: Extent,
    pub(super) halves: Option<[usize; 2]>,
}

impl ClusterTree {
    /// Of at least one cell.
    pub(super) fn new(boxes: &[Extent], leaf: usize) -> Self {
        let mut tree = Self {
            cells: (0..boxes.len()).collect(),
            positions: vec![0; boxes.len()],
            clusters: Vec::new(),
            leaves: Vec::new(),
        };
        tree.divide(boxes, 0..boxes.len(), leaf);
        for (position, &cell) in tree.cells.iter().enumerate() {
            tree.positions[cell] = position;
        }
        tree
    }

    /// Adds a cluster and all clusters inside it; its number.
    fn divide(&mut self, boxes: &[Extent], positions: Range<usize>, leaf: usize) -> usize {
        let cells = &mut self.cells[positions.clone()];
        let extent = Extent::of_boxes(cells.iter().map(|&cell| boxes[cell]));
        let number = self.clusters.len();
        self.clusters.push(Cluster {
            positions: positions.clone(),
            extent,
            halves: None,
        });
        if cells.len() <= leaf {
            self.leaves.push(number);
            return number;
        }
        let lengths = extent.lengths();
        let longest = (1..3).fold(0, |most, axis| {
            if lengths[axis] > lengths[most] {
                axis
            } else {
                most
            }
        });
        let place = |cell: usize| boxes[cell].place(longest);
        cells.sort_unstable_by(|&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
        let middle = positions.start + positions.len() / 2;
        let halves = [positions.start..middle, middle..positions.end];
        self.clusters[number].halves = Some(halves.map(|half| self.divide(boxes, half, leaf)));
        number
    }

    /// The cells of a cluster.
    pub(super) fn cells_of(&self, cluster: usize) -> &[usize] {
        &self.cells[self.clusters[cluster].positions.clone()]
    }

    /// The leaves of a cluster, as places in [`Self::leaves`].
    pub(super) fn leaves_of(&self, cluster: usize) -> Range<usize> {
        let Range { start, end } = self.clusters[cluster].positions;
        let begins = |position: usize| {
            self.leaves
                .partition_point(|&leaf| self.clusters[leaf].positions.start < position)
        };
        begins(start)..begins(end)
    }
}
