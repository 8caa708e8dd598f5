//! The Newton system on the kept unknowns, factorised densely by faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::cholesky::llt::solve::solve_in_place;
use faer::{MatMut, MatRef, Par, Spec};

use crate::frictional_vertices::FrictionalVertices;
use crate::newton::Models;

use super::matrix::DenseMatrix;
use super::unknowns::Unknowns;

/// The relative rounding error of a diagonal entry that has no pivot.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// `H = S + D` on a set of unknowns.
pub(super) struct Factor {
    matrix: Vec<f64>,
    /// The diagonal of `H` while `matrix` is its factor.
    diagonal: Vec<f64>,
    /// The unknowns that are kept, increasing.
    pub(super) kept: Vec<u32>,
    memory: MemBuffer,
}

impl std::fmt::Debug for Factor {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Factor")
            .field("kept", &self.kept.len())
            .finish_non_exhaustive()
    }
}

impl Factor {
    /// Allocates for up to `count` unknowns; `None` without the memory.
    pub(super) fn new(count: usize) -> Option<Self> {
        let mut matrix = Vec::new();
        matrix.try_reserve_exact(count.checked_mul(count)?).ok()?;
        matrix.resize(count * count, 0.0);
        let request = cholesky_in_place_scratch::<f64>(count, Par::Seq, Spec::default());
        Some(Self {
            matrix,
            diagonal: Vec::with_capacity(count),
            kept: Vec::with_capacity(count),
            memory: MemBuffer::try_new(request).ok()?,
        })
    }

    /// Scratch memory for a dense matrix of all unknowns, free while no factor is in use.
    pub(super) fn scratch(&mut self) -> &mut [f64] {
        &mut self.matrix
    }

    /// Stores the unknowns that the models keep; `vertices` are the frictional ones.
    pub(super) fn keep<const C: usize>(
        &mut self,
        unknowns: &Unknowns<C>,
        vertices: &[usize],
        models: &Models<C>,
    ) {
        self.kept.clear();
        let mut frictional = FrictionalVertices::along(vertices);
        for p in 0..unknowns.vertices() {
            let dropped = frictional.at(p).map_or([false; C], |k| models.dropped[k]);
            let kept = unknowns.free(p).filter(|&(c, _)| !dropped[c]);
            self.kept.extend(kept.map(|(_, i)| i as u32));
        }
    }

    /// The lower triangle of `H` on the kept unknowns.
    pub(super) fn assemble<const C: usize>(
        &mut self,
        matrix: &DenseMatrix,
        unknowns: &Unknowns<C>,
        vertices: &[usize],
        models: &Models<C>,
    ) {
        self.copy(matrix);
        let mut begin = 0;
        for (k, &p) in vertices.iter().enumerate() {
            let mut kept = unknowns.free(p).filter(|&(c, _)| !models.dropped[k][c]);
            let Some((first, unknown)) = kept.next() else {
                continue;
            };
            // The place of the vertex among the kept unknowns, which increase.
            begin += self.kept[begin..].partition_point(|&i| (i as usize) < unknown);
            let mut components = [first; C];
            let mut count = 1;
            for (c, _) in kept {
                components[count] = c;
                count += 1;
            }
            for (row, &r) in components[..count].iter().enumerate() {
                for (column, &c) in components[..=row].iter().enumerate() {
                    self.add(begin + row, begin + column, models.hessians[k][(r, c)]);
                }
            }
        }
    }

    /// Whether the matrix on all unknowns, with a slope added on the diagonal of each of `vertices`, is positive
    /// definite.
    pub(super) fn is_definite_with<const C: usize>(
        &mut self,
        matrix: &DenseMatrix,
        unknowns: &Unknowns<C>,
        vertices: &[usize],
        slopes: &[f64],
    ) -> bool {
        self.kept.clear();
        self.kept.extend(0..unknowns.count() as u32);
        self.copy(matrix);
        for (&p, &slope) in vertices.iter().zip(slopes) {
            for (_, i) in unknowns.free(p) {
                self.add(i, i, slope);
            }
        }
        self.factorize().is_ok()
    }

    /// Copies the kept part of a matrix.
    fn copy(&mut self, matrix: &DenseMatrix) {
        let size = self.kept.len();
        for (column, &j) in self.kept.iter().enumerate() {
            let source = matrix.column(j as usize);
            let target = &mut self.matrix[column * size..][column..size];
            for (entry, &i) in target.iter_mut().zip(&self.kept[column..]) {
                *entry = source[i as usize];
            }
        }
    }

    /// Adds to an entry, given by positions among the kept unknowns.
    fn add(&mut self, row: usize, column: usize, value: f64) {
        let size = self.kept.len();
        self.matrix[column * size + row] += value;
    }

    /// Factorises; the error is the unknown of a pivot that is not positive, or positive by rounding alone.
    pub(super) fn factorize(&mut self) -> Result<(), u32> {
        let size = self.kept.len();
        self.diagonal.clear();
        self.diagonal
            .extend((0..size).map(|i| self.matrix[i * size + i]));
        let matrix =
            MatMut::from_column_major_slice_mut(&mut self.matrix[..size * size], size, size);
        cholesky_in_place(
            matrix,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        )
        .map_err(|LltError::NonPositivePivot { index }| self.kept[index])?;
        let pivots = (0..size).map(|i| self.matrix[i * size + i].powi(2));
        let mut pivots = pivots.zip(&self.diagonal).zip(&self.kept);
        match pivots.find(|((pivot, diagonal), _)| *pivot <= ROUNDING * **diagonal) {
            Some((_, &unknown)) => Err(unknown),
            None => Ok(()),
        }
    }

    /// `x <- H^-1 x`, `x` on the kept unknowns.
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        let size = self.kept.len();
        if size == 0 {
            return;
        }
        let factor = MatRef::from_column_major_slice(&self.matrix[..size * size], size, size);
        solve_in_place(
            factor,
            MatMut::from_column_major_slice_mut(x, size, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}
