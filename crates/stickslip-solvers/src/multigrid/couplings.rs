//! The blocks that a cycle reads, and the inverses of diagonal blocks, in double or in single precision.

use nalgebra::{SMatrix, SVector};

use super::inverses::Inverses;
use super::packed::Packed;
use crate::BlockMatrix;
use crate::block_matrix::{Block, Rows};
use crate::colouring::Colouring;
use crate::parts::sum_parts;

/// The unit roundoff of single precision.
const ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;

/// The blocks of a matrix at the columns that a forward sweep visits before the row, packed: half of the matrix, and
/// all that a cycle reads. With one slab these are the blocks below the diagonal.
#[derive(Debug)]
pub(super) enum Couplings<const C: usize> {
    /// As they are.
    Double(Packed<SMatrix<f64, C, C>, C>),
    /// By columns, rounded, relative to a power of two per row: stiffnesses of any unit are in the range.
    ///
    /// Rounding changes the energy of a vertex and its neighbour by a share of that of their *difference*, since the
    /// diagonal block takes up what the blocks of a row lose: a translation remains without force. The relative change
    /// of the energy is then a multiple of 6e-8 that does not grow with the number of vertices.
    Single(Packed<[[f32; C]; C], C>),
}

impl<const C: usize> Couplings<C> {
    /// The pattern of a matrix, with zero values.
    pub(super) fn of(matrix: &BlockMatrix<C>, slabs: &Colouring, single: bool) -> Self {
        let rows = Rows::of(matrix);
        let (mut starts, mut columns) = (vec![0], Vec::new());
        slabs.for_each(|slab, narrow| {
            for i in slab.clone() {
                columns.extend(before(&rows, i, &slab, narrow));
                starts.push(columns.len() as u32);
            }
        });
        let count = columns.len();
        if single {
            return Self::Single(Packed {
                inverses: Inverses::zeros(matrix.rows()),
                units: vec![1.0; starts.len() - 1],
                blocks: vec![[[0.0; C]; C]; count],
                starts,
                columns,
            });
        }
        Self::Double(Packed {
            inverses: Inverses::zeros(matrix.rows()),
            units: Vec::new(),
            blocks: vec![SMatrix::zeros(); count],
            starts,
            columns,
        })
    }

    /// Stores the inverse of the diagonal block of a row, zero on dropped components.
    pub(super) fn set_inverse(&mut self, i: usize, inverse: &SMatrix<f64, C, C>) {
        match self {
            Self::Double(packed) => packed.inverses.set(i, inverse),
            Self::Single(packed) => packed.inverses.set(i, inverse),
        }
    }

    /// The inverse of the diagonal block of a row times a vector.
    pub(super) fn balanced(&self, i: usize, force: &SVector<f64, C>) -> SVector<f64, C> {
        match self {
            Self::Double(packed) => packed.inverses.times(i, force),
            Self::Single(packed) => packed.inverses.times(i, force),
        }
    }

    /// The inverses of the diagonal blocks, unless these have taken up errors.
    pub(super) fn inverses(&self) -> Option<&[SMatrix<f64, C, C>]> {
        match self {
            Self::Double(packed) => Some(&packed.inverses),
            Self::Single(_) => None,
        }
    }

    fn pattern(&self) -> (&[u32], &[u32]) {
        match self {
            Self::Double(packed) => (&packed.starts, &packed.columns),
            Self::Single(packed) => (&packed.starts, &packed.columns),
        }
    }

    /// Whether the matrix of these couplings has the pattern of another one. Both are symmetric.
    pub(super) fn has_pattern_of(&self, matrix: &BlockMatrix<C>, slabs: &Colouring) -> bool {
        let rows = Rows::of(matrix);
        let (starts, columns) = self.pattern();
        if starts.len() != rows.starts.len() || 2 * columns.len() + matrix.rows() != matrix.nnz() {
            return false;
        }
        let mut equal = true;
        slabs.for_each(|slab, narrow| {
            for i in slab.clone() {
                let own = &columns[starts[i] as usize..starts[i + 1] as usize];
                equal = equal && before(&rows, i, &slab, narrow).eq(own.iter().copied());
            }
        });
        equal
    }

    /// Stores a row, given all of its entries; returns the diagonal block of the stored matrix.
    pub(super) fn set_row(
        &mut self,
        i: usize,
        row: impl Iterator<Item = (usize, SMatrix<f64, C, C>)> + Clone,
    ) -> SMatrix<f64, C, C> {
        let mut diagonal = SMatrix::zeros();
        match self {
            Self::Double(packed) => {
                let mut place = packed.starts[i] as usize;
                let end = packed.starts[i + 1] as usize;
                for (j, block) in row {
                    if j == i {
                        diagonal = block;
                    } else if place < end && packed.columns[place] as usize == j {
                        packed.blocks[place] = block;
                        place += 1;
                    }
                }
            }
            Self::Single(packed) => {
                let mut place = packed.starts[i] as usize;
                let end = packed.starts[i + 1] as usize;
                let largest = row
                    .clone()
                    .fold(0.0, |largest: f64, (_, block)| largest.max(block.amax()));
                let unit = power_of_two_below(largest);
                packed.units[i] = unit;
                let mut lost = SMatrix::zeros();
                for (j, block) in row {
                    if j == i {
                        diagonal = block;
                        continue;
                    }
                    let rounded = block.map(|entry| (entry / unit) as f32);
                    lost += block - rounded.map(|entry| f64::from(entry) * unit);
                    if place < end && packed.columns[place] as usize == j {
                        packed.blocks[place] = rounded.data.0;
                        place += 1;
                    }
                }
                // The diagonal block stays symmetric.
                diagonal += (lost + lost.transpose()) * 0.5;
            }
        }
        diagonal
    }

    /// A bound on the change of `x . H x` by rounding.
    ///
    /// With `E_ij` the rounding errors of the blocks, `d = x_i - x_j` and `m = (x_i + x_j)/2` the change is the sum over
    /// all pairs of `d . E_ij d + m . (E_ij - E_ij^T) d`, since the diagonal blocks take up the symmetric part of the
    /// errors of their row. The second term is left only where a block is not symmetric: at surfaces of the body and of
    /// materials.
    pub(super) fn rounding(&self, x: &[SVector<f64, C>]) -> f64 {
        let Self::Single(packed) = self else {
            return 0.0;
        };
        let rows = packed.rows().rows;
        let moduli = sum_parts(0..x.len(), (), &|part, ()| {
            let row = |i: usize| {
                let pairs = rows.row(i);
                let sum: f64 = pairs.map(|(j, block)| moduli(block, &x[i], &x[j])).sum();
                sum * packed.units[i]
            };
            part.map(row).sum()
        });
        ROUNDOFF * moduli
    }
}

/// The moduli of the terms of one pair that rounding changes.
#[inline(always)]
fn moduli<const C: usize>(
    block: &[[f32; C]; C],
    x_i: &SVector<f64, C>,
    x_j: &SVector<f64, C>,
) -> f64 {
    let (apart, mean) = (x_i - x_j, (x_i + x_j) * 0.5);
    let mut sum = 0.0;
    for c in 0..C {
        for r in 0..C {
            sum += (block.entry(r, c) * apart[r] * apart[c]).abs();
        }
        for r in (0..c).filter(|&r| block[c][r] != block[r][c]) {
            let entries = block.entry(r, c).abs() + block.entry(c, r).abs();
            sum += entries * (mean[r] * apart[c] - mean[c] * apart[r]).abs();
        }
    }
    sum
}

/// The columns of a row that a forward sweep visits before it.
fn before<'a, const C: usize>(
    rows: &Rows<'a, SMatrix<f64, C, C>>,
    i: usize,
    slab: &'a std::ops::Range<usize>,
    narrow: bool,
) -> impl Iterator<Item = u32> + use<'a, C> {
    let columns = &rows.columns[rows.range(i)];
    columns.iter().copied().filter(move |&j| {
        let j = j as usize;
        if slab.contains(&j) { j < i } else { narrow }
    })
}

/// The largest power of two that is not above a positive normal number.
fn power_of_two_below(number: f64) -> f64 {
    f64::from_bits(number.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}
