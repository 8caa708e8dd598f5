//! Transfers between levels with jumps across faults as unknowns.

use std::collections::BTreeMap;

use sprs::TriMatI;

use crate::block_matrix::Rows;
use crate::linked::Shares;
use crate::{Link, Links, Prolongation};

/// `L_f^-1 P L_c` for the transfers of a hierarchy, coarsest first, whose finest level has the links.
///
/// A coarse level links the vertices that are vertices of a link on the finer one.
pub(super) fn transfers(given: &[Prolongation], links: &Links) -> Vec<Prolongation> {
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
                share: link.share,
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
        if let Some((base, share)) = link.recoil() {
            for (&unknown, weight) in &row {
                *product[base].entry(unknown).or_default() -= weight * share;
            }
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
