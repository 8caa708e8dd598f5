//! Masses, which are one number a pair of vertices where a body is assembled.

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd, WithSimd};

use crate::block_matrix::{Rows, add, on_patterns};
use crate::parts::{for_parts, sum_parts};
use crate::{BlockMatrix, Frames, Operator};

/// A sparse mass: one number a pair of vertices where all its blocks are multiples of the unit matrix, as finite
/// elements give them, and blocks otherwise.
///
/// [`into_mass`](Operator::into_mass) of a [`BlockMatrix`] finds out which. In three dimensions a number takes a sixth of the
/// memory of a block with its column, and so does a product. Products are those of the blocks, the same bits.
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip_tnnmg::{BlockMatrix, Operator};
///
/// let unit = SMatrix::<f64, 3, 3>::identity();
/// let mass = BlockMatrix::new((2, 2), vec![0, 2, 4], vec![0, 1, 0, 1], vec![unit * 2.0, unit, unit, unit * 2.0]);
/// let mass = mass.into_mass();
/// assert!(mass.is_scalar());
/// assert_eq!(mass.diagonal_block(1), unit * 2.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MassMatrix<const C: usize>(Format<C>);

#[derive(Debug, Clone, PartialEq)]
enum Format<const C: usize> {
    Scalars(BlockMatrix<1>),
    Blocks(BlockMatrix<C>),
}

use Format::{Blocks, Scalars};

impl<const C: usize> MassMatrix<C> {
    /// Whether one number a pair of vertices is held instead of a block.
    pub fn is_scalar(&self) -> bool {
        matches!(self.0, Scalars(_))
    }

    /// With a block a pair of vertices.
    fn blocks(&mut self) -> &mut BlockMatrix<C> {
        if let Scalars(scalars) = &self.0 {
            let blocks = |number: &SMatrix<f64, 1, 1>| SMatrix::from_diagonal_element(number[0]);
            self.0 = Blocks(scalars.map(blocks));
        }
        match &mut self.0 {
            Blocks(blocks) => blocks,
            Scalars(_) => unreachable!("they are blocks by now"),
        }
    }

    /// Adds `factor` times the mass to a matrix that has an entry wherever the mass has one.
    pub(crate) fn add_to(&self, sum: &mut BlockMatrix<C>, factor: f64) {
        match &self.0 {
            Scalars(scalars) => add(sum, scalars, |sum, number| {
                let number = number[0] * factor;
                for c in 0..C {
                    sum[(c, c)] += number;
                }
            }),
            Blocks(blocks) => add(sum, blocks, |sum, block| *sum += block * factor),
        }
    }

    /// Where rows start, and the columns of all of them.
    pub(crate) fn pattern(&self) -> (&[u32], &[u32]) {
        match &self.0 {
            Scalars(scalars) => Rows::of(scalars).pattern(),
            Blocks(blocks) => Rows::of(blocks).pattern(),
        }
    }
}

impl<const C: usize> From<BlockMatrix<C>> for MassMatrix<C> {
    fn from(blocks: BlockMatrix<C>) -> Self {
        let scalar = |block: &SMatrix<f64, C, C>| {
            let unit = SMatrix::<f64, C, C>::identity();
            *block == unit * block[(0, 0)]
        };
        if C > 1 && blocks.data().iter().all(scalar) {
            let size = blocks.shape();
            let (starts, columns, blocks) = blocks.into_raw_storage();
            let numbers = blocks.iter().map(|block| SMatrix::from([[block[(0, 0)]]]));
            return Self(Scalars(BlockMatrix::new(
                size,
                starts,
                columns,
                numbers.collect(),
            )));
        }
        Self(Blocks(blocks))
    }
}

/// `(M x)_row`, each component by itself, in the order in which a product of blocks adds.
#[inline(always)]
fn row_product<const C: usize>(
    rows: &Rows<'_, SMatrix<f64, 1, 1>>,
    row: usize,
    x: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let mut sums = [0.0; C];
    for (j, number) in rows.row(row) {
        let x_j = &x[j].data.0[0];
        for c in 0..C {
            sums[c] += number[0] * x_j[c];
        }
    }
    SVector::from(sums)
}

/// The rows of a product from `first` on.
struct Product<'a, const C: usize> {
    rows: Rows<'a, SMatrix<f64, 1, 1>>,
    first: usize,
    scale: f64,
    x: &'a [SVector<f64, C>],
    y: &'a mut [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Product<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (i, y) in self.y.iter_mut().enumerate() {
            *y += row_product(&self.rows, self.first + i, self.x) * self.scale;
        }
    }
}

impl<const C: usize> Operator<C> for MassMatrix<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn vertex_count(&self) -> usize {
        self.pattern().0.len() - 1
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        match &self.0 {
            Scalars(scalars) => row_product(&Rows::of(scalars), i, x),
            Blocks(blocks) => blocks.product_at(i, x),
        }
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        match &self.0 {
            Scalars(scalars) => SMatrix::from_diagonal_element(scalars.diagonal_block(i)[0]),
            Blocks(blocks) => blocks.diagonal_block(i),
        }
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let all = terms.iter().copied().chain(mass);
        let sum = on_patterns(all.map(|(_, term)| term.pattern()));
        let mut sum = Self(Blocks(sum));
        sum.set_combination_with(terms, mass);
        match sum.0 {
            Blocks(blocks) => blocks.into(),
            Scalars(_) => sum,
        }
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let terms = terms.iter().copied().chain(mass);
        if !terms.clone().all(|(_, term)| term.is_scalar()) {
            self.blocks();
        }
        match &mut self.0 {
            Scalars(sum) => {
                sum.data_mut().fill(SMatrix::zeros());
                for (factor, term) in terms {
                    if let Scalars(term) = &term.0 {
                        add(sum, term, |sum, number| *sum += number * factor);
                    }
                }
            }
            Blocks(sum) => {
                sum.data_mut().fill(SMatrix::zeros());
                for (factor, term) in terms {
                    term.add_to(sum, factor);
                }
            }
        }
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        self.blocks().add_to_diagonal(i, block);
    }

    /// In blocks, since axes of neighbours may differ.
    fn turn(&mut self, frames: &Frames<C>) -> bool {
        frames.is_empty() || self.blocks().turn(frames)
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        let rows = match &self.0 {
            Scalars(scalars) => Rows::of(scalars),
            Blocks(blocks) => return blocks.multiply_add(scale, x, y),
        };
        if rows.is_diagonal() {
            for ((y, number), x) in y.iter_mut().zip(rows.values).zip(x) {
                *y += x * number[0] * scale;
            }
            return;
        }
        let arch = Arch::new();
        for_parts(0..y.len(), y, &|part, y| {
            let first = part.start;
            arch.dispatch(Product {
                rows,
                first,
                scale,
                x,
                y,
            });
        });
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let rows = match &self.0 {
            Scalars(scalars) => Rows::of(scalars),
            Blocks(blocks) => return blocks.quadratic(x),
        };
        sum_parts(0..x.len(), (), &|part, ()| {
            part.map(|i| x[i].dot(&row_product(&rows, i, x))).sum()
        })
    }
}
