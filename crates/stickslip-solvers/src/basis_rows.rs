//! The rows of a change of basis.

use std::collections::BTreeMap;

use nalgebra::SMatrix;

use crate::{Basis, Links};

/// Some rows of a matrix with a block for each pair of vertices: columns and blocks by row.
pub type BasisRows<const C: usize> = BTreeMap<usize, Vec<(usize, SMatrix<f64, C, C>)>>;

/// A vector as a combination of others, by their vertices.
type Combination = Vec<(usize, f64)>;

/// Combinations by vertex; those of other vertices are the vectors themselves.
#[derive(Default)]
struct Combinations(BTreeMap<usize, Combination>);

impl Combinations {
    fn of(&self, vertex: usize) -> Combination {
        let known = self.0.get(&vertex).cloned();
        known.unwrap_or_else(|| vec![(vertex, 1.0)])
    }

    /// Replaces the vector of `vertex` by `own` times itself and the sum of others with their factors.
    fn combine(&mut self, vertex: usize, own: f64, others: &[(usize, f64)]) {
        let mut all = self.of(vertex);
        all.iter_mut().for_each(|(_, share)| *share *= own);
        for &(other, factor) in others {
            for (unknown, share) in self.of(other) {
                match all.iter_mut().find(|(known, _)| *known == unknown) {
                    Some((_, sum)) => *sum += factor * share,
                    None => all.push((unknown, factor * share)),
                }
            }
        }
        all.retain(|&(_, share)| share != 0.0);
        self.0.insert(vertex, all);
    }

    /// `L`: the steps of [`Links::join`].
    fn joined(links: &Links) -> Self {
        let mut all = Self::default();
        for link in links.iter().rev() {
            if let Some((base, share)) = link.recoil() {
                all.combine(base, 1.0, &[(link.vertex, share)]);
            }
            let bases: Vec<_> = link.bases.iter().map(|&base| (base, 1.0)).collect();
            all.combine(link.vertex, link.sign(), &bases);
        }
        all
    }

    /// `L^-1`: the steps of [`Links::part`].
    fn parted(links: &Links) -> Self {
        let mut all = Self::default();
        for link in links.iter() {
            let sign = link.sign();
            let bases: Vec<_> = link.bases.iter().map(|&base| (base, -sign)).collect();
            all.combine(link.vertex, sign, &bases);
            if let Some((base, share)) = link.recoil() {
                all.combine(base, 1.0, &[(link.vertex, -share)]);
            }
        }
        all
    }
}

impl<const C: usize> Basis<C> {
    /// The rows of `T`: each `x_i` by the unknowns, of the vertices with a row other than that of the identity.
    ///
    /// For operators that are stored in ways of their own, such as by the rows of each of several processes.
    pub fn rows(&self) -> BasisRows<C> {
        self.by_blocks(Combinations::joined(&self.links), |_, j, share| {
            self.block(j) * share
        })
    }

    /// The rows of `T^-1`: each unknown by the `x_i`, of the vertices with a row other than that of the identity.
    pub fn inverse_rows(&self) -> BasisRows<C> {
        self.by_blocks(Combinations::parted(&self.links), |i, _, share| {
            self.block(i).transpose() * share
        })
    }

    fn block(&self, vertex: usize) -> SMatrix<f64, C, C> {
        let axes = self.axes.of(vertex);
        axes.copied().unwrap_or_else(SMatrix::identity)
    }

    fn by_blocks(
        &self,
        mut combinations: Combinations,
        block: impl Fn(usize, usize, f64) -> SMatrix<f64, C, C>,
    ) -> BasisRows<C> {
        for (vertex, _) in self.axes.iter() {
            combinations.combine(vertex, 1.0, &[]);
        }
        let rows = combinations.0.into_iter().map(|(i, row)| {
            let blocks = row.iter().map(|&(j, share)| (j, block(i, j, share)));
            (i, blocks.collect())
        });
        rows.collect()
    }
}
