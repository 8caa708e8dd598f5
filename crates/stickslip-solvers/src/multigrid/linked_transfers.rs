//! Transfers between levels with jumps across faults as unknowns.

use sprs::TriMatI;

use crate::block_matrix::Rows;
use crate::linked::{Combination, Shares, part};
use crate::{Links, Prolongation};

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
    finer.on_coarser(copy)
}

fn transfer(prolongation: &Prolongation, finer: &Links, coarser: &Links) -> Prolongation {
    if finer.is_empty() {
        return prolongation.clone();
    }
    let (fine, coarse) = prolongation.shape();
    let rows = Rows::of(prolongation);
    let shares = Shares::new(coarse, coarser);
    let mut product = vec![Combination::new(); fine];
    for (i, product) in product.iter_mut().enumerate() {
        for (j, weight) in rows.row(i) {
            shares.for_each(j, |unknown, share| {
                *product.entry(unknown).or_default() += weight * share;
            });
        }
    }
    part(finer, &mut product);
    let mut entries = TriMatI::new((fine, coarse));
    for (i, row) in product.iter().enumerate() {
        // Both sides interpolate alike along a fault: what cancels is exactly zero.
        for (&j, &weight) in row.iter().filter(|&(_, &weight)| weight != 0.0) {
            entries.add_triplet(i, j, weight);
        }
    }
    entries.to_csr()
}
