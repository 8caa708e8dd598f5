//! Colouring of a banded matrix: slabs of rows of two colours, those of one colour independent of one another.

use std::ops::Range;

use crate::parts::{Divide, for_each};

/// Smallest number of rows of a wide slab that is worth a thread.
const GRAIN: usize = 4096;
/// Smallest number of bandwidths of a wide slab; a narrow one has two.
const BANDWIDTHS: usize = 8;
/// Largest number of wide slabs; smaller numbers are powers of two.
const SLABS: usize = 32;
const FEW: usize = 8;

/// Colouring of the rows: wide slabs with narrow ones between them.
///
/// A narrow slab is two bandwidths wide, a wide one at least that. No row of a slab is then coupled to a row of another
/// slab of the same colour. A sweep over all wide slabs and then all narrow ones is a Gauss-Seidel sweep in that order,
/// even if the slabs of one colour run in parallel. A sweep over a slab reads and changes only the slab and half of
/// each neighbour, and no other slab of its colour touches these.
#[derive(Debug, Clone, Default)]
pub(crate) struct Colouring {
    /// Slab `s` has the rows `bounds[s]..bounds[s + 1]`; even ones are wide.
    bounds: Vec<usize>,
    /// Each wide slab with half of its neighbours.
    around_wide: Vec<usize>,
    /// Each narrow slab with half of its neighbours; the first and the last extend to the ends.
    around_narrow: Vec<usize>,
    /// The bandwidth: the largest distance of a column from its row.
    bandwidth: usize,
}

impl Colouring {
    /// The colouring that pays: many slabs for many rows; one slab for few rows or without threads, since the passes
    /// over one slab are the faster ones.
    pub(crate) fn new(rows: usize, bandwidth: usize) -> Self {
        let least = if cfg!(feature = "rayon") {
            GRAIN.max(BANDWIDTHS * bandwidth)
        } else {
            rows
        };
        Self::of(rows, bandwidth, least)
    }

    /// The colouring with `least` rows per wide slab, two bandwidths or more.
    pub(crate) fn of(rows: usize, bandwidth: usize, least: usize) -> Self {
        let narrow = 2 * bandwidth.max(1);
        let count: usize = ((rows + narrow) / (least.max(narrow) + narrow)).clamp(1, SLABS);
        // Of few, as many for each of two threads, or four.
        let count = if count < FEW {
            1 << count.ilog2()
        } else {
            count
        };
        let wide = rows - (count - 1) * narrow;
        // The first rows of wide slab `k`.
        let start = |k: usize| wide * k / count + k * narrow;
        let mut bounds = vec![0];
        for k in 1..count {
            bounds.extend([start(k) - narrow, start(k)]);
        }
        bounds.push(rows);
        let middle = |slab: usize| bounds[slab].midpoint(bounds[slab + 1]);
        let ends = |inner: Vec<usize>| [vec![0], inner, vec![rows]].concat();
        let (around_wide, around_narrow) = (
            ends((1..count).map(|k| middle(2 * k - 1)).collect()),
            ends(
                (1..count.saturating_sub(1))
                    .map(|k| middle(2 * k))
                    .collect(),
            ),
        );
        Self {
            bounds,
            around_wide,
            around_narrow,
            bandwidth,
        }
    }

    /// Whether the colouring is that of a matrix of so many rows and this bandwidth.
    pub(crate) fn are_of(&self, rows: usize, bandwidth: usize) -> bool {
        self.bounds.last() == Some(&rows) && self.bandwidth == bandwidth
    }

    /// Whether there is only one slab.
    pub(crate) fn is_whole(&self) -> bool {
        self.bounds.len() <= 2
    }

    #[cfg(feature = "multigrid")]
    pub(crate) fn bandwidth(&self) -> usize {
        self.bandwidth
    }

    /// The number of wide slabs.
    #[cfg(feature = "multigrid")]
    pub(crate) fn wide_count(&self) -> usize {
        self.bounds.len() / 2
    }

    /// The rows of a wide slab.
    pub(crate) fn wide(&self, k: usize) -> Range<usize> {
        self.bounds[2 * k]..self.bounds[2 * k + 1]
    }

    /// The rows of the narrow slab after wide slab `k`.
    pub(crate) fn narrow(&self, k: usize) -> Range<usize> {
        self.bounds[2 * k + 1]..self.bounds[2 * k + 2]
    }

    /// The rows of a wide slab without coupling to narrow ones.
    #[cfg(feature = "multigrid")]
    pub(crate) fn inner(&self, k: usize) -> Range<usize> {
        let rows = self.wide(k);
        let is_last = k + 1 == self.wide_count();
        let begin = rows.start + if k == 0 { 0 } else { self.bandwidth };
        begin..rows.end - if is_last { 0 } else { self.bandwidth }
    }

    /// Calls `visit(rows, narrow)` for all slabs.
    #[cfg(feature = "multigrid")]
    pub(crate) fn for_each(&self, mut visit: impl FnMut(Range<usize>, bool)) {
        for (s, bounds) in self.bounds.windows(2).enumerate() {
            visit(bounds[0]..bounds[1], s % 2 == 1);
        }
    }

    /// Calls `work(k, first, fields)` for all wide slabs with the fields from row `first` on: those of the slab and
    /// half of its neighbours.
    pub(crate) fn for_wide<F: Divide>(&self, fields: F, work: impl Fn(usize, usize, F) + Sync) {
        let cuts = &self.around_wide;
        for_each(cuts, fields, &|k, fields| work(k, cuts[k], fields));
    }

    /// As [`for_wide`](Self::for_wide) for the narrow slabs, if there are any; the parts of the fields cover all rows.
    pub(crate) fn for_narrow<F: Divide>(&self, fields: F, work: impl Fn(usize, usize, F) + Sync) {
        let cuts = &self.around_narrow;
        for_each(cuts, fields, &|k, fields| work(k, cuts[k], fields));
    }
}

#[cfg(all(test, feature = "multigrid"))]
mod tests {
    use proptest::prelude::*;

    use super::Colouring;

    proptest! {
        /// The slabs are all rows, one after the other; those of one colour are at least two bandwidths apart, and the
        /// surroundings of one extend a bandwidth to each side.
        #[test]
        fn slabs_are_far_from_their_like(
            rows in 0_usize..3000,
            bandwidth in 0_usize..100,
            least in 0_usize..300,
        ) {
            let slabs = Colouring::of(rows, bandwidth, least);
            let mut end = 0;
            slabs.for_each(|rows, narrow| {
                assert_eq!(rows.start, end);
                end = rows.end;
                let is_wide_enough = rows.len() >= 2 * bandwidth;
                assert!(slabs.is_whole() || is_wide_enough, "{rows:?}, narrow: {narrow}");
            });
            prop_assert_eq!(end, rows);
            let reaches = |around: &[usize], k: usize, slab: std::ops::Range<usize>| {
                (around[k] == 0 || around[k] + bandwidth <= slab.start)
                    && (around[k + 1] == rows || around[k + 1] >= slab.end + bandwidth)
            };
            for k in 0..slabs.wide_count() {
                prop_assert!(reaches(&slabs.around_wide, k, slabs.wide(k)));
            }
            for k in 0..slabs.wide_count() - 1 {
                prop_assert!(reaches(&slabs.around_narrow, k, slabs.narrow(k)));
            }
        }
    }
}
