//! The rows of a change of basis.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::SMatrix;

use crate::Basis;
use crate::linked::{Combination, Shares, part};

/// Some rows of a matrix with a block for each pair of vertices: columns and blocks by row.
pub type BasisRows<const C: usize> = BTreeMap<usize, Vec<(usize, SMatrix<f64, C, C>)>>;

impl<const C: usize> Basis<C> {
    /// The rows of `T`: each `x_i` by the unknowns, of the vertices with axes, links or linked copies.
    ///
    /// For operators that are stored in ways of their own, such as by the rows of each of several processes.
    pub fn rows(&self) -> BasisRows<C> {
        let changed = self.changed();
        let shares = Shares::new(size(&changed), &self.links);
        let row = |i: usize| {
            let mut row = Vec::new();
            shares.for_each(i, |unknown, share| {
                row.push((unknown, self.block(unknown) * share))
            });
            (i, row)
        };
        changed.iter().map(|&i| row(i)).collect()
    }

    /// The rows of `T^-1`: each unknown by the `x_i`, of the same vertices.
    pub fn inverse_rows(&self) -> BasisRows<C> {
        let changed = self.changed();
        let mut field = vec![Combination::new(); size(&changed)];
        for &i in &changed {
            field[i].insert(i, 1.0);
        }
        part(&self.links, &mut field);
        let row = |i: usize| {
            let back = self.block(i).transpose();
            let blocks = field[i].iter().map(|(&j, &share)| (j, back * share));
            (i, blocks.collect())
        };
        changed.iter().map(|&i| row(i)).collect()
    }

    /// The vertices with axes, links or linked copies.
    fn changed(&self) -> BTreeSet<usize> {
        let linked = self.links.iter().flat_map(|link| {
            let bases = link.bases.iter().copied();
            bases.chain([link.vertex])
        });
        let turned = self.axes.iter().map(|(vertex, _)| vertex);
        linked.chain(turned).collect()
    }

    fn block(&self, vertex: usize) -> SMatrix<f64, C, C> {
        let axes = self.axes.of(vertex);
        axes.copied().unwrap_or_else(SMatrix::identity)
    }
}

fn size(vertices: &BTreeSet<usize>) -> usize {
    vertices.last().map_or(0, |last| last + 1)
}
