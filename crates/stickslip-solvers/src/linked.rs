//! Sparse products with links: of operators, and of transfers between levels.

use std::collections::BTreeMap;

use nalgebra::SMatrix;
use sprs::TriMatI;

use crate::block_matrix::Rows;
use crate::{BlockMatrix, Link, Links, Prolongation};

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
struct Shares<'a> {
    of: Vec<Option<&'a Link>>,
}

impl<'a> Shares<'a> {
    fn new(size: usize, links: &'a Links) -> Self {
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

    fn for_each(&self, i: usize, mut visit: impl FnMut(usize, f64)) {
        visit(i, self.own(i));
        for &base in self.of[i].iter().flat_map(|link| &link.bases) {
            visit(base, 1.0);
        }
    }
}

/// `L_f^-1 P L_c` for the transfers of a hierarchy, coarsest first, whose finest level has the links.
///
/// A coarse level links the vertices that are vertices of a link on the finer one.
pub(crate) fn transfers(given: &[Prolongation], links: &Links) -> Vec<Prolongation> {
    let mut finer = links.clone();
    let mut linked: Vec<Prolongation> = Vec::with_capacity(given.len());
    for prolongation in given.iter().rev() {
        let coarser = on_coarser(prolongation, &finer);
        linked.push(transfer(prolongation, &finer, &coarser));
        finer = coarser;
    }
    linked.reverse();
    linked
}

/// The links between vertices that both levels have.
fn on_coarser(prolongation: &Prolongation, finer: &Links) -> Links {
    let rows = Rows::of(prolongation);
    let copy = |fine: usize| {
        let mut row = rows.row(fine);
        match (row.next(), row.next()) {
            (Some((coarse, _)), None) => Some(coarse),
            _ => None,
        }
    };
    let links: Vec<Link> = (finer.iter())
        .filter_map(|link| {
            let bases = link.bases.iter().map(|&base| copy(base));
            Some(Link {
                vertex: copy(link.vertex)?,
                bases: bases.collect::<Option<Vec<_>>>()?,
                reversed: link.reversed,
            })
        })
        .collect();
    let known: Vec<usize> = links.iter().map(|link| link.vertex).collect();
    // A base that is linked on the finer level alone: its vertex moves by itself here.
    let complete = |link: &Link| {
        let linked = |base: &usize| known.contains(base);
        link.bases.len() == 1
            || link.bases.iter().filter(|base| linked(base)).count() + 1 == link.bases.len()
    };
    Links::new(links.iter().filter(|link| complete(link)).cloned())
}

fn transfer(prolongation: &Prolongation, finer: &Links, coarser: &Links) -> Prolongation {
    if finer.is_empty() {
        return prolongation.clone();
    }
    let (fine, coarse) = prolongation.shape();
    let rows = Rows::of(prolongation);
    let shares = Shares::new(coarse, coarser);
    let mut product: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); fine];
    for (i, product) in product.iter_mut().enumerate() {
        for (j, weight) in rows.row(i) {
            shares.for_each(j, |unknown, share| {
                *product.entry(unknown).or_default() += weight * share;
            });
        }
    }
    for link in finer.iter() {
        let mut row = std::mem::take(&mut product[link.vertex]);
        for &base in &link.bases {
            for (&unknown, weight) in &product[base] {
                *row.entry(unknown).or_default() -= weight;
            }
        }
        if link.reversed {
            row.values_mut().for_each(|weight| *weight = -*weight);
        }
        product[link.vertex] = row;
    }
    let mut entries = TriMatI::new((fine, coarse));
    for (i, row) in product.iter().enumerate() {
        // Both sides interpolate alike along a fault: what cancels is exactly zero.
        for (&j, &weight) in row.iter().filter(|&(_, &weight)| weight != 0.0) {
            entries.add_triplet(i, j, weight);
        }
    }
    entries.to_csr()
}
