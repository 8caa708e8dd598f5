//! Mass matrices with one number per pair of vertices.

use nalgebra::{SMatrix, SVector};
use stickslip_core::compiled;

use crate::block_matrix::{Rows, add, on_patterns};
use crate::products::{Entry, multiply_add, multiply_add_diagonal, quadratic};
use crate::{Basis, BlockMatrix, Matrix, Operator};

/// A sparse mass: one number per pair of vertices if all its blocks are multiples of the unit matrix, as in finite
/// elements, and blocks otherwise.
///
/// [`into_mass`](Operator::into_mass) of a [`BlockMatrix`] selects the format. In three dimensions a number takes a
/// sixth of the memory of a block with its column, and so does a product. Products are those of the blocks, the same
/// bits.
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip_solvers::{BlockMatrix, Matrix, Operator};
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
    Scalars(sprs::CsMatI<f64, u32>),
    /// Numbers on the diagonal alone.
    Lumped(sprs::CsMatI<f64, u32>),
    Blocks(BlockMatrix<C>),
}

use Format::{Blocks, Lumped, Scalars};

impl<const C: usize> MassMatrix<C> {
    /// Whether the mass has one number per pair of vertices instead of a block.
    pub fn is_scalar(&self) -> bool {
        matches!(self.0, Scalars(_) | Lumped(_))
    }

    /// The mass with one block per pair of vertices.
    fn blocks(&mut self) -> &mut BlockMatrix<C> {
        if let Scalars(scalars) | Lumped(scalars) = &self.0 {
            self.0 = Blocks(scalars.map(|&number| SMatrix::from_diagonal_element(number)));
        }
        match &mut self.0 {
            Blocks(blocks) => blocks,
            Scalars(_) | Lumped(_) => unreachable!("they are blocks by now"),
        }
    }

    /// Adds `factor` times the mass to a matrix that has an entry wherever the mass has one.
    pub(crate) fn add_to(&self, sum: &mut BlockMatrix<C>, factor: f64) {
        match &self.0 {
            Scalars(scalars) | Lumped(scalars) => add(sum, scalars, |sum, number| {
                let number = number * factor;
                for c in 0..C {
                    sum[(c, c)] += number;
                }
            }),
            Blocks(blocks) => add(sum, blocks, |sum, block| *sum += block * factor),
        }
    }

    /// The row starts and the columns of all rows.
    pub(crate) fn pattern(&self) -> (&[u32], &[u32]) {
        match &self.0 {
            Scalars(scalars) | Lumped(scalars) => Rows::of(scalars).pattern(),
            Blocks(blocks) => Rows::of(blocks).pattern(),
        }
    }
}

impl<const C: usize> From<BlockMatrix<C>> for MassMatrix<C> {
    fn from(blocks: BlockMatrix<C>) -> Self {
        of_blocks(blocks)
    }
}

compiled! {
    fn of_blocks<C>(blocks: BlockMatrix<C>) -> MassMatrix<C> {
        let scalar = |block: &SMatrix<f64, C, C>| {
            let unit = SMatrix::<f64, C, C>::identity();
            *block == unit * block[(0, 0)]
        };
        if C > 1 && blocks.data().iter().all(scalar) {
            let size = blocks.shape();
            let (starts, columns, blocks) = blocks.into_raw_storage();
            let numbers = blocks.iter().map(|block| block[(0, 0)]).collect();
            let scalars = sprs::CsMatI::new(size, starts, columns, numbers);
            let lumped = Rows::of(&scalars).is_diagonal();
            return MassMatrix(if lumped { Lumped(scalars) } else { Scalars(scalars) });
        }
        MassMatrix(Blocks(blocks))
    }

    fn add_product<C>(
        mass: &MassMatrix<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        match &mass.0 {
            Scalars(scalars) => multiply_add(Rows::of(scalars), scale, x, y),
            Lumped(scalars) => multiply_add_diagonal(scalars.data(), scale, x, y),
            Blocks(blocks) => blocks.multiply_add(scale, x, y),
        }
    }

    fn square<C>(mass: &MassMatrix<C>, x: &[SVector<f64, C>]) -> f64 {
        match &mass.0 {
            Scalars(scalars) | Lumped(scalars) => quadratic(Rows::of(scalars), x),
            Blocks(blocks) => blocks.quadratic(x),
        }
    }

    fn combination<C>(
        terms: &[(f64, &MassMatrix<C>)],
        mass: Option<(f64, &MassMatrix<C>)>,
    ) -> MassMatrix<C> {
        let all = terms.iter().copied().chain(mass);
        let mut sum = MassMatrix(Blocks(on_patterns(all.map(|(_, term)| term.pattern()))));
        combine(&mut sum, terms, mass);
        sum
    }

    fn combine<C>(
        sum: &mut MassMatrix<C>,
        terms: &[(f64, &MassMatrix<C>)],
        mass: Option<(f64, &MassMatrix<C>)>,
    ) {
        let sum = sum.blocks();
        sum.data_mut().fill(SMatrix::zeros());
        for (factor, term) in terms.iter().copied().chain(mass) {
            term.add_to(sum, factor);
        }
    }

    fn change_basis<C>(mass: &mut MassMatrix<C>, basis: &Basis<C>) -> bool {
        basis.is_empty() || mass.blocks().change_basis(basis)
    }

    fn add_to_diagonal<C>(mass: &mut MassMatrix<C>, i: usize, block: &SMatrix<f64, C, C>) {
        mass.blocks().add_to_diagonal(i, block);
    }
}

impl<const C: usize> Matrix<C> for MassMatrix<C> {
    fn vertex_count(&self) -> usize {
        self.pattern().0.len() - 1
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        match &self.0 {
            Scalars(scalars) | Lumped(scalars) => f64::row_product(&Rows::of(scalars), i, x),
            Blocks(blocks) => blocks.product_at(i, x),
        }
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        match &self.0 {
            Scalars(scalars) | Lumped(scalars) => {
                let number = scalars.get(i, i).copied().unwrap_or_default();
                SMatrix::from_diagonal_element(number)
            }
            Blocks(blocks) => blocks.diagonal_block(i),
        }
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        add_product(self, scale, x, y);
    }

    fn lumps(&self) -> Option<&[f64]> {
        match &self.0 {
            Lumped(numbers) => Some(numbers.data()),
            Scalars(_) | Blocks(_) => None,
        }
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        square(self, x)
    }
}

impl<const C: usize> Operator<C> for MassMatrix<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    /// In blocks.
    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        combination(terms, mass)
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        combine(self, terms, mass);
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        add_to_diagonal(self, i, block);
    }

    /// In blocks, since axes of neighbours may differ.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        change_basis(self, basis)
    }
}
