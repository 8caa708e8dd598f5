//! Hierarchical matrices: dense blocks of cells next to each other, blocks of low rank of clusters at a distance.

mod access;
mod approximation;
mod build;
mod compression;
mod cross;
mod entries;
mod error;
mod estimate;
mod extent;
mod far;
mod panels;
mod partition;
mod product;
mod recompression;
mod strip;
mod tree;

use std::ops::Range;

pub use approximation::Approximation;
pub use compression::Compression;
pub use entries::Entries;
pub use error::HMatrixError;
pub use extent::Extent;
pub use product::HMatrixScratch;

use crate::KernelError;
use build::{Built, build};
use estimate::check_memory;
use far::FarBlock;
use partition::Partition;
use product::{Place, parts_of_blocks, parts_of_strips};
use strip::Strip;
use tree::ClusterTree;

/// The most cells of a leaf.
const LEAF: usize = 32;

/// A matrix of smooth interactions, of a memory and a cost of products of the order of `N ln N`.
///
/// Clusters of receivers and sources halve along the longest side of their box down to 32 cells. Two of them are far from each
/// other if the smaller diameter is at most twice their distance: their block, with all rows and columns of each pair, is a sum
/// of few crosses within a relative [tolerance](Approximation::with_tolerance), by adaptive cross approximation of some of its
/// rows and columns, and a singular value decomposition. Near blocks are exact, and open to [additions](Self::add).
///
/// ```
/// use stickslip_bie::hmatrix::{Approximation, Entries, Extent, HMatrix};
///
/// struct Charges(Vec<[f64; 3]>);
///
/// impl Entries for Charges {
///     fn shape(&self) -> [usize; 2] {
///         [1, 1]
///     }
///
///     fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
///         let [a, b] = [receiver, source].map(|k| self.0[k]);
///         let squared: f64 = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum();
///         block[0] = if receiver == source { 0.0 } else { squared.sqrt().recip() };
///     }
/// }
///
/// let charges = Charges((0..2000).map(|k| [f64::from(k).cos(), f64::from(k).sin(), 0.01 * f64::from(k)]).collect());
/// let cells: Vec<_> = charges.0.iter().map(|&point| Extent::of_points([point])).collect();
/// let matrix = HMatrix::new(&charges, &cells, &Approximation::default())?;
/// assert!(matrix.compression().stored_share() < 0.4);
///
/// let (mut potential, mut exact) = (vec![0.0; 2000], 0.0);
/// matrix.product(&mut matrix.scratch(), |_| &[1.0], |receiver, rows| potential[receiver] = rows[0]);
/// for source in 0..2000 {
///     let mut entry = [0.0];
///     charges.block(7, source, &mut entry);
///     exact += entry[0];
/// }
/// assert!((potential[7] / exact - 1.0).abs() < 1e-5);
/// # Ok::<(), stickslip_bie::hmatrix::HMatrixError>(())
/// ```
#[derive(Debug)]
#[doc(alias(
    "hierarchical matrix",
    "H-matrix",
    "ACA",
    "adaptive cross approximation"
))]
pub struct HMatrix {
    shape: [usize; 2],
    receivers: ClusterTree,
    sources: ClusterTree,
    strips: Vec<Strip>,
    blocks: Vec<FarBlock>,
    /// Where coefficients of far blocks are.
    places: Vec<Place>,
    /// Parts of far blocks, and of strips.
    parts: [Vec<Range<usize>>; 2],
    /// The numbers that a product reads.
    numbers: usize,
    approximation: Approximation,
    pairs: u64,
}

impl HMatrix {
    /// Of cells that are receivers and sources, from their boxes.
    ///
    /// # Errors
    /// [`HMatrixError`] without cells, for boxes and entries that are not finite, and if the matrix takes more memory than its
    /// limit.
    pub fn new<E: Entries>(
        entries: &E,
        cells: &[Extent],
        approximation: &Approximation,
    ) -> Result<Self, HMatrixError> {
        Self::between(entries, cells, cells, approximation)
    }

    /// Of receivers and sources, from their boxes.
    ///
    /// # Errors
    /// As of [`new`](Self::new).
    pub fn between<E: Entries>(
        entries: &E,
        receivers: &[Extent],
        sources: &[Extent],
        approximation: &Approximation,
    ) -> Result<Self, HMatrixError> {
        check(receivers, sources)?;
        let [receivers, sources] = [receivers, sources].map(|cells| ClusterTree::new(cells, LEAF));
        let trees = [&receivers, &sources];
        let partition = Partition::new(&receivers, &sources, approximation.has_far_blocks());
        let found = check_memory(entries, trees, &partition, approximation)?;
        let Built {
            strips,
            blocks,
            pairs,
        } = build(entries, trees, &partition, found, approximation)?;
        let (of_blocks, places) = parts_of_blocks(&blocks);
        let of_strips = parts_of_strips(&strips);
        let numbers = strips.iter().map(Strip::len).sum::<usize>()
            + blocks.iter().map(|block| block.right.len()).sum::<usize>();
        Ok(Self {
            shape: entries.shape(),
            receivers,
            sources,
            strips,
            blocks,
            places,
            parts: [of_blocks, of_strips],
            numbers,
            approximation: *approximation,
            pairs,
        })
    }

    /// Refuses a matrix that takes more memory than its limit, without making it.
    pub(crate) fn check_memory<E: Entries>(
        entries: &E,
        cells: [&[Extent]; 2],
        approximation: &Approximation,
    ) -> Result<(), HMatrixError> {
        let [receivers, sources] = cells;
        check(receivers, sources)?;
        let numbers = entries.shape().iter().product::<usize>() as f64;
        let dense = 8.0 * numbers * receivers.len() as f64 * sources.len() as f64;
        if dense <= approximation.memory_limit as f64 {
            return Ok(());
        }
        let trees = cells.map(|cells| ClusterTree::new(cells, LEAF));
        let has_far_blocks = approximation.has_far_blocks();
        let partition = Partition::new(&trees[0], &trees[1], has_far_blocks);
        check_memory(entries, trees.each_ref(), &partition, approximation)?;
        Ok(())
    }

    /// The numbers of receivers and of sources.
    pub fn cells(&self) -> [usize; 2] {
        [self.receivers.cells.len(), self.sources.cells.len()]
    }

    /// The number of rows of a receiver, and of columns of a source.
    pub fn shape(&self) -> [usize; 2] {
        self.shape
    }
}

/// Refuses no cells, and boxes that are not finite.
fn check(receivers: &[Extent], sources: &[Extent]) -> Result<(), KernelError> {
    for cells in [receivers, sources] {
        if cells.is_empty() {
            let what = "number of cells of an H-matrix";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        }
        if let Some(cell) = cells.iter().position(|cell| !cell.is_finite()) {
            let numbers = [cells[cell].min, cells[cell].max];
            let numbers = numbers.as_flattened().iter();
            let value = numbers.copied().find(|x| !x.is_finite());
            let what = "coordinate [m] of cell";
            let error = KernelError::new(what, "finite", value.unwrap_or(f64::NAN));
            return Err(error.of_cell(cell));
        }
    }
    Ok(())
}
