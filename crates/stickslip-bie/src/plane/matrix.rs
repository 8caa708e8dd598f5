//! The interaction of the cells of a plane, in either of its two formats.

use nalgebra::{DMatrix, SMatrix, SVector};

use super::convolution::Convolution;
use super::layer_product;
use super::layers::Layers;
use super::mirrored::{self, Mirrored};
use super::transform;

/// The interaction of cells.
#[derive(Debug)]
pub(crate) enum Matrix {
    /// In a whole space: the difference of cells matters alone.
    Convolution(Convolution),
    /// In a half space: the depths of both cells matter.
    Layers(Layers),
    /// On a vertical plane in a half space: their difference, their sum and one of them.
    Mirrored(Mirrored),
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) enum Memory {
    Convolution(transform::Memory),
    Layers(layer_product::Memory),
    Mirrored(mirrored::Memory),
}

impl Matrix {
    /// The memory of a product of `C` components.
    pub(crate) fn memory<const C: usize>(&self) -> Memory {
        match self {
            Self::Convolution(matrix) => Memory::Convolution(matrix.memory(C)),
            Self::Layers(matrix) => Memory::Layers(matrix.memory(C, C)),
            Self::Mirrored(matrix) => Memory::Mirrored(matrix.memory(C)),
        }
    }

    /// `A_ij`.
    pub(crate) fn entry<const C: usize>(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        match self {
            Self::Convolution(matrix) => matrix.entry(i, j),
            Self::Layers(matrix) => matrix.entry(i, j),
            Self::Mirrored(matrix) => matrix.entry(i, j),
        }
    }

    /// Adds `factor A` to a dense matrix.
    pub(crate) fn add_to_dense<const C: usize>(&self, factor: f64, dense: &mut DMatrix<f64>) {
        match self {
            Self::Layers(matrix) => matrix.add_to_dense::<C, C>(factor, dense),
            _ => {
                let count = dense.nrows() / C;
                for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                    let mut block = dense.fixed_view_mut::<C, C>(C * i, C * j);
                    block += self.entry::<C>(i, j) * factor;
                }
            }
        }
    }

    /// Passes on `(A x)_i` of each cell. Allocates nothing.
    pub(crate) fn product<const C: usize>(
        &self,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        show: impl FnMut(usize, SVector<f64, C>),
    ) {
        match (self, memory) {
            (Self::Convolution(matrix), Memory::Convolution(memory)) => {
                matrix.product(memory, x, show);
            }
            (Self::Layers(matrix), Memory::Layers(memory)) => matrix.product(memory, x, show),
            (Self::Mirrored(matrix), Memory::Mirrored(memory)) => {
                matrix.product(memory, x, show);
            }
            _ => debug_assert!(false, "the memory of another matrix"),
        }
    }
}
