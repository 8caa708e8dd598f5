//! The interaction of cells of any shape: the stress of each due to slip of all.

mod kernel;
mod memory;
mod normal;
mod pairs;
mod storage;

use std::fmt;

use nalgebra::{SMatrix, SVector};
use stickslip_core::compiled;

pub use kernel::CellKernel;
pub use normal::CellNormalKernel;
pub(crate) use pairs::{Pair, Pairs};
pub(crate) use storage::Storage;

use crate::hmatrix::{Compression, HMatrix};
use crate::surface::Averaging;
use memory::Memories;
use pairs::Rows;

/// Forces of each cell that resist slip of all cells [N/m], and its compression [Pa/m].
///
/// The matrix has stresses alone, so that its tolerance is the same for both.
pub(crate) struct Interaction<const C: usize> {
    matrix: HMatrix,
    /// Areas or lengths.
    sizes: Vec<f64>,
    memories: Memories,
}

impl<const C: usize> Interaction<C> {
    /// All pairs and their corrections.
    ///
    /// The memory has been [checked](Storage::check). Forces on a cell with numbers that are not
    /// finite are NaN.
    pub(crate) fn new<P: Pairs<C>>(pairs: &P, storage: &Storage) -> Self {
        let count = pairs.count();
        let [receivers, sources] = [pairs.extents(), pairs.source_extents()];
        let approximation = storage.approximation(count.max(sources.len()));
        let approximation = approximation.with_memory_limit(u64::MAX);
        let rows = Rows::new(pairs);
        let matrix = HMatrix::between(&rows, &receivers, &sources, &approximation);
        let mut matrix = matrix.expect("cells are finite, and so are rows");
        let mut add = |cell, source, [row, column]: [usize; 2], value| {
            let added = matrix.add([cell, row], [source, column], value);
            added.expect("cells that share a point are near to each other");
        };
        for cell in 0..count {
            for (source, block) in pairs.correction(cell) {
                for (row, column) in (0..C).flat_map(|row| (0..C).map(move |c| (row, c))) {
                    add(cell, source, [row, column], -block[(row, column)]);
                }
            }
        }
        let mut sizes: Vec<_> = (0..count).map(|cell| pairs.size(cell)).collect();
        if let Some(cell) = rows.undefined() {
            sizes[cell] = f64::NAN;
        }
        Self {
            memories: Memories::of(&matrix),
            matrix,
            sizes,
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.sizes.len()
    }

    pub(crate) fn compression(&self) -> Compression {
        self.matrix.compression()
    }

    /// Whether slip changes any normal stress.
    pub(crate) fn changes_normal_stress(&self) -> bool {
        self.matrix.shape()[0] > C
    }

    /// The stored rows of a cell due to slip of another.
    fn stored(&self, receiver: usize, source: usize) -> [[f64; C]; 4] {
        let mut rows = [[0.0; C]; 4];
        let count = self.matrix.shape()[0];
        let block = rows[..count].as_flattened_mut();
        self.matrix.block(receiver, source, block);
        rows
    }

    /// The force at a cell per slip of another.
    pub(crate) fn force(&self, receiver: usize, source: usize) -> SMatrix<f64, C, C> {
        let rows = self.stored(receiver, source);
        SMatrix::from_fn(|row, column| self.sizes[receiver] * rows[row][column])
    }

    /// The compression of a cell per slip of another.
    pub(crate) fn compression_of(&self, receiver: usize, source: usize) -> SVector<f64, C> {
        let rows = self.stored(receiver, source);
        SVector::from_fn(|column, _| rows[C][column])
    }
}

/// Some vertices, the first of which is that of cell 0.
#[derive(Clone, Copy)]
pub(crate) struct Vertices<'a> {
    pub(crate) first: usize,
    pub(crate) vertices: &'a [usize],
}

impl Vertices<'_> {
    fn cells(self) -> impl Iterator<Item = usize> + Clone {
        let first = self.first;
        self.vertices.iter().map(move |vertex| vertex - first)
    }
}

compiled! {
    /// Adds multiples of the forces at all cells. Allocates nothing.
    pub(crate) fn add_forces<C in 1, 2>(
        interaction: &Interaction<C>,
        scale: f64,
        slip: &[SVector<f64, C>],
        forces: &mut [SVector<f64, C>],
    ) {
        let Interaction { matrix, sizes, memories } = interaction;
        let of_cell = matrix.shape()[0];
        memories.product(matrix, slip, |rows| {
            for ((force, rows), size) in forces.iter_mut().zip(rows.chunks_exact(of_cell)).zip(sizes) {
                let factor = scale * size;
                *force += SVector::from_fn(|c, _| factor * rows[c]);
            }
        });
    }

    /// Adds multiples of the forces at some vertices. Allocates nothing.
    pub(crate) fn add_forces_at<C in 1, 2>(
        interaction: &Interaction<C>,
        scale: f64,
        vertices: Vertices<'_>,
        slip: &[SVector<f64, C>],
        forces: &mut [SVector<f64, C>],
    ) {
        let Interaction { matrix, sizes, memories } = interaction;
        let cells = vertices.cells();
        memories.product_at(matrix, cells, slip, |place, cell, rows| {
            let factor = scale * sizes[cell];
            forces[place] += SVector::from_fn(|c, _| factor * rows[c]);
        });
    }

    /// The work of forces due to slip on a motion of the receivers. Allocates nothing.
    pub(crate) fn work<C in 1, 2>(
        interaction: &Interaction<C>,
        slip: &[SVector<f64, C>],
        motion: &[SVector<f64, C>],
    ) -> f64 {
        let Interaction { matrix, sizes, memories } = interaction;
        let of_cell = matrix.shape()[0];
        memories.product(matrix, slip, |rows| {
            let cells = motion.iter().zip(rows.chunks_exact(of_cell)).zip(sizes);
            cells.map(|((motion, rows), size)| {
                let along: f64 = motion.iter().zip(rows).map(|(motion, row)| motion * row).sum();
                size * along
            })
            .sum()
        })
    }

    /// Adds multiples of the compressions of all cells, or of their means. Allocates nothing.
    pub(crate) fn add_compressions<C in 1, 2>(
        interaction: &Interaction<C>,
        scale: f64,
        slip: &[SVector<f64, C>],
        mean: Option<&Averaging>,
        sums: &mut [f64],
    ) {
        let Interaction { matrix, memories, .. } = interaction;
        let of_cell = matrix.shape()[0];
        if of_cell == C {
            return;
        }
        memories.product(matrix, slip, |rows| {
            let of = |cell: usize| rows[of_cell * cell + C];
            for (cell, sum) in sums.iter_mut().enumerate() {
                *sum += scale * mean.map_or_else(|| of(cell), |mean| mean.mean(cell, of));
            }
        });
    }
}

impl<const C: usize> fmt::Debug for Interaction<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Interaction({})", self.compression())
    }
}
