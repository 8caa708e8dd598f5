//! Matrices for the unknowns of a basis.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::SMatrix;
use stickslip::solvers::Basis;

use crate::basis::{SharedBasis, add};
use crate::{DistributedMatrix, Error};

impl<const C: usize> DistributedMatrix<C> {
    /// `T^T A T`: the rows of all copies of a vertex, added up, with columns that may be those of further ghosts.
    pub(crate) fn congruent(&self, basis: &Basis<C>) -> Result<Self, Error> {
        let before = &self.layout;
        let shared = SharedBasis::new(before.world, before.first, basis)?;
        let more = shared.unknowns_of(&before.ghosts);
        let layout = Arc::new(before.with_ghosts(more)?);
        // `T^T`: the vertices in whose motion an unknown takes part, where these are not itself alone.
        let mut transposed: BTreeMap<usize, Vec<(usize, SMatrix<f64, C, C>)>> = BTreeMap::new();
        for (vertex, row) in basis.rows() {
            for (unknown, block) in row {
                let part = (vertex, block.transpose());
                transposed.entry(unknown).or_default().push(part);
            }
        }
        let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        let mut row: Vec<(u32, SMatrix<f64, C, C>)> = Vec::new();
        for unknown in 0..layout.owned {
            row.clear();
            let alone = [(unknown, SMatrix::identity())];
            for (vertex, left) in transposed.get(&unknown).map_or(&alone[..], |all| all) {
                for (j, block) in self.row(*vertex) {
                    let (number, block) = (before.global(j as u32), left * block);
                    let local = |number| layout.local(number).ok_or(Error::NoOwner);
                    match shared.row(number) {
                        None => add(&mut row, local(number)?, block),
                        Some(right) => {
                            for (unknown, right) in right {
                                add(&mut row, local(*unknown)?, block * right);
                            }
                        }
                    }
                }
            }
            row.sort_unstable_by_key(|&(column, _)| column);
            columns.extend(row.iter().map(|&(column, _)| column));
            values.extend(row.iter().map(|&(_, block)| block));
            starts.push(columns.len() as u32);
        }
        let (starts, columns) = (Arc::new(starts), Arc::new(columns));
        Ok(Self::new(layout, starts, columns, values))
    }
}
