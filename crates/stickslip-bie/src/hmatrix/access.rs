//! Single numbers of a hierarchical matrix.

use super::strip::FarRows;
use super::{HMatrix, HMatrixError};

impl HMatrix {
    /// The strip of the receiver at a position.
    pub(super) fn strip_of(&self, position: usize) -> usize {
        (self.strips).partition_point(|strip| strip.receivers.end <= position)
    }

    /// Overwrites `block` by the stored numbers of a receiver due to a source, row by row.
    pub fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
        let [receiver, source] = [
            self.receivers.positions[receiver],
            self.sources.positions[source],
        ];
        let [of_receiver, of_source] = self.shape;
        let strip = &self.strips[self.strip_of(receiver)];
        let first_row = of_receiver * (receiver - strip.receivers.start);
        let pairs =
            (0..of_receiver).flat_map(|row| (0..of_source).map(move |column| [row, column]));
        let pairs = pairs.zip(block);
        if let Some(near) = strip.near_of(source).map(|near| &strip.near[near]) {
            let first = of_source * (source - near.sources.start);
            pairs.for_each(|([row, column], number)| {
                *number = near.values.entry(first_row + row, first + column);
            });
            return;
        }
        let of_source_block = |far: &&FarRows| self.blocks[far.block].sources.contains(&source);
        let far = strip.far.iter().find(of_source_block);
        for ([row, column], number) in pairs {
            *number = far.map_or(0.0, |far| {
                let block = &self.blocks[far.block];
                let first = of_source * (source - block.sources.start);
                let term =
                    |k| far.left.entry(first_row + row, k) * block.right.entry(k, first + column);
                (0..block.rank).map(term).sum()
            });
        }
    }

    /// Adds a number to a row of a receiver and a column of a source that are near to each other: cells that share a point always
    /// are.
    ///
    /// # Errors
    /// [`HMatrixError::FarPair`] if their cells are far from each other.
    pub fn add(
        &mut self,
        [receiver, row]: [usize; 2],
        [source_cell, column]: [usize; 2],
        value: f64,
    ) -> Result<(), HMatrixError> {
        let position = self.receivers.positions[receiver];
        let source = self.sources.positions[source_cell];
        let [of_receiver, of_source] = self.shape;
        let number = self.strip_of(position);
        let strip = &mut self.strips[number];
        let Some(near) = strip.near_of(source) else {
            return Err(HMatrixError::FarPair {
                receiver,
                source_cell,
            });
        };
        let near = &mut strip.near[near];
        let row = of_receiver * (position - strip.receivers.start) + row;
        let column = of_source * (source - near.sources.start) + column;
        *near.values.entry_mut(row, column) += value;
        Ok(())
    }
}
