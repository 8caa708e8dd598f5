//! Sparse products of operators with links.

use std::collections::BTreeMap;

use nalgebra::SMatrix;

use crate::block_matrix::Rows;
use crate::{BlockMatrix, Link, Links};

/// `L^T A L`, on the pattern of the product.
pub(crate) fn congruent<const C: usize>(matrix: &BlockMatrix<C>, links: &Links) -> BlockMatrix<C> {
    let (size, rows) = (matrix.rows(), Rows::of(matrix));
    let shares = Shares::new(size, links);
    // The copies in whose motion an unknown takes part.
    let mut children: Vec<Vec<(usize, f64)>> = vec![Vec::new(); size];
    for i in 0..size {
        shares.for_each(i, |unknown, share| children[unknown].push((i, share)));
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

/// A vector as a combination of others: factors by their numbers.
pub(crate) type Combination = BTreeMap<usize, f64>;

/// `y = L^-1 x` of combinations, one a vertex, in place.
pub(crate) fn part(links: &Links, field: &mut [Combination]) {
    let subtract = |from: &mut Combination, share: f64, other: &Combination| {
        for (&number, factor) in other {
            *from.entry(number).or_default() -= share * factor;
        }
    };
    for link in links.iter() {
        let mut own = std::mem::take(&mut field[link.vertex]);
        for &base in &link.bases {
            subtract(&mut own, 1.0, &field[base]);
        }
        if link.reversed {
            own.values_mut().for_each(|factor| *factor = -*factor);
        }
        if let Some((base, share)) = link.recoil() {
            subtract(&mut field[base], share, &own);
        }
        field[link.vertex] = own;
    }
}

/// The unknowns of the motion of each vertex.
pub(crate) struct Shares<'a> {
    of: Vec<Option<&'a Link>>,
    /// The links by which bases move back.
    back: Vec<Option<(usize, f64)>>,
}

impl<'a> Shares<'a> {
    /// The links of a body of `size` vertices.
    pub(crate) fn new(size: usize, links: &'a Links) -> Self {
        let (mut of, mut back) = (vec![None; size], vec![None; size]);
        for link in links.iter() {
            of[link.vertex] = Some(link);
            if let Some((base, share)) = link.recoil() {
                back[base] = Some((link.vertex, share));
            }
        }
        Self { of, back }
    }

    /// Calls `visit(unknown, share)` for the unknowns of a vertex.
    pub(crate) fn for_each(&self, i: usize, mut visit: impl FnMut(usize, f64)) {
        match self.of[i] {
            Some(link) => {
                let back = link.recoil().map_or(0.0, |(_, share)| share);
                visit(i, link.sign() + back);
                link.bases.iter().for_each(|&base| visit(base, 1.0));
            }
            None => {
                visit(i, 1.0);
                if let Some((vertex, share)) = self.back[i] {
                    visit(vertex, share);
                }
            }
        }
    }
}
