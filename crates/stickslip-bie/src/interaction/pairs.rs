//! The numbers of pairs of cells.

use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{SMatrix, SVector};

use crate::hmatrix::{Entries, Extent};

/// Shear stress of a cell along its directions of slip, and its compression, per slip of another [Pa/m].
pub(crate) type Pair<const C: usize> = (SMatrix<f64, C, C>, SVector<f64, C>);

/// Cells as receivers and sources of stress.
pub(crate) trait Pairs<const C: usize>: Sync {
    /// The number of receivers.
    fn count(&self) -> usize;

    /// The boxes of receivers \[m\].
    fn extents(&self) -> Vec<Extent>;

    /// The boxes of sources \[m\]: by default the receivers.
    fn source_extents(&self) -> Vec<Extent> {
        self.extents()
    }

    /// The area of a receiver [m^2], or its length \[m\].
    fn size(&self, receiver: usize) -> f64;

    /// Whether slip changes any normal stress.
    fn changes_normal_stress(&self) -> bool;

    /// What slip of a cell does at another.
    fn pair(&self, receiver: usize, source: usize) -> Pair<C>;

    /// What is added to the shear stress of a cell by slip of cells that share a point with it [Pa/m].
    fn correction(&self, _cell: usize) -> Vec<(usize, SMatrix<f64, C, C>)> {
        Vec::new()
    }
}

/// The rows of pairs: stress that resists slip by component, then compression if it changes.
pub(super) struct Rows<'a, P, const C: usize> {
    pairs: &'a P,
    rows: usize,
    /// The first receiver with a number that is not finite.
    undefined: AtomicUsize,
}

impl<'a, P: Pairs<C>, const C: usize> Rows<'a, P, C> {
    pub(super) fn new(pairs: &'a P) -> Self {
        let rows = C + usize::from(pairs.changes_normal_stress());
        Self {
            pairs,
            rows,
            undefined: AtomicUsize::new(usize::MAX),
        }
    }

    /// The first receiver with a number that is not finite, among the pairs evaluated.
    pub(super) fn undefined(&self) -> Option<usize> {
        let first = self.undefined.load(Ordering::Relaxed);
        (first < usize::MAX).then_some(first)
    }
}

impl<P: Pairs<C>, const C: usize> Entries for Rows<'_, P, C> {
    fn shape(&self) -> [usize; 2] {
        [self.rows, C]
    }

    /// Numbers that are not finite are left out, and their receiver is kept.
    fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
        let (shear, compression) = self.pairs.pair(receiver, source);
        for (n, number) in block.iter_mut().enumerate() {
            let (row, column) = (n / C, n % C);
            *number = if row < C {
                -shear[(row, column)]
            } else {
                compression[column]
            };
            if !number.is_finite() {
                *number = 0.0;
                self.undefined.fetch_min(receiver, Ordering::Relaxed);
            }
        }
    }
}
