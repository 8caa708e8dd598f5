//! Sparse products of operators with links.

use nalgebra::SMatrix;

use crate::block_matrix::Rows;
use crate::{BlockMatrix, Link, Links};

/// `L^T A L`, on the pattern of the product.
pub(crate) fn congruent<const C: usize>(matrix: &BlockMatrix<C>, links: &Links) -> BlockMatrix<C> {
    let (size, rows) = (matrix.rows(), Rows::of(matrix));
    let shares = Shares::new(size, links);
    // The copies in whose motion an unknown takes part.
    let mut children: Vec<Vec<(usize, f64)>> =
        (0..size).map(|i| vec![(i, shares.own(i))]).collect();
    for link in links.iter() {
        for &base in &link.bases {
            children[base].push((link.vertex, 1.0));
        }
    }
    let mut places = vec![u32::MAX; size];
    let (mut starts, mut columns, mut blocks) = (vec![0_u32], Vec::new(), Vec::new());
    let mut row: Vec<(u32, SMatrix<f64, C, C>)> = Vec::new();
    for children in &children {
        row.clear();
        for &(i, weight) in children {
            for (j, block) in rows.row(i) {
                shares.for_each(j, |unknown, share| {
                    let part = block * (weight * share);
                    match places[unknown] {
                        u32::MAX => {
                            places[unknown] = row.len() as u32;
                            row.push((unknown as u32, part));
                        }
                        place => row[place as usize].1 += part,
                    }
                });
            }
        }
        row.sort_unstable_by_key(|&(column, _)| column);
        for &(column, block) in &row {
            places[column as usize] = u32::MAX;
            columns.push(column);
            blocks.push(block);
        }
        starts.push(columns.len() as u32);
    }
    BlockMatrix::new((size, size), starts, columns, blocks)
}

/// The unknowns of the motion of each vertex.
pub(crate) struct Shares<'a> {
    of: Vec<Option<&'a Link>>,
}

impl<'a> Shares<'a> {
    /// Of so many vertices.
    pub(crate) fn new(size: usize, links: &'a Links) -> Self {
        let mut of = vec![None; size];
        for link in links.iter() {
            of[link.vertex] = Some(link);
        }
        Self { of }
    }

    /// The share of a vertex' own unknown.
    fn own(&self, i: usize) -> f64 {
        match self.of[i] {
            Some(link) if link.reversed => -1.0,
            _ => 1.0,
        }
    }

    /// Calls `visit(unknown, share)` for the unknowns of a vertex.
    pub(crate) fn for_each(&self, i: usize, mut visit: impl FnMut(usize, f64)) {
        visit(i, self.own(i));
        for &base in self.of[i].iter().flat_map(|link| &link.bases) {
            visit(base, 1.0);
        }
    }
}
