//! The exact solve on the coarsest level: sparse Cholesky by faer, without allocation after the
//! symbolic analysis.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltParams};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};
use nalgebra::SVector;

use crate::block_matrix::Rows;
use crate::{BlockMatrix, SolveError};

/// Symbolic and numeric factor of a matrix whose pattern does not change.
pub(crate) struct CoarseSolver {
    /// Lower triangle by columns, unknown `C vertex + component`.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    /// For each stored entry: the block and the position in it, `C (C column + row)`.
    sources: Vec<(u32, u8, u8)>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    right_hand_side: Vec<f64>,
    memory: MemBuffer,
}

impl std::fmt::Debug for CoarseSolver {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("CoarseSolver")
            .field("unknowns", &self.right_hand_side.len())
            .field("entries", &self.factor.len())
            .finish_non_exhaustive()
    }
}

impl CoarseSolver {
    /// Orders the unknowns, computes the pattern of the factor and takes all memory needed.
    pub(super) fn analyse<const C: usize>(matrix: &BlockMatrix<C>) -> Result<Self, SolveError> {
        let blocks = Rows::of(matrix);
        let unknowns = C * matrix.rows();
        let (mut starts, mut rows, mut sources) = (vec![0], Vec::new(), Vec::new());
        for vertex in 0..matrix.rows() {
            for column in 0..C {
                for k in blocks.range(vertex) {
                    // Row `vertex` of the symmetric matrix serves as its column.
                    let other = blocks.columns[k] as usize;
                    for row in 0..C {
                        if C * other + row >= C * vertex + column {
                            rows.push(C * other + row);
                            sources.push((k as u32, column as u8, row as u8));
                        }
                    }
                }
                starts.push(rows.len());
            }
        }
        let failure = SolveError::CoarseAnalysis {
            unknowns,
            entries: rows.len(),
        };
        let symbolic = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::new_checked(unknowns, unknowns, &starts, None, &rows),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| failure.clone())?;
        let scratch = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::<LltParams, f64>::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let memory = MemBuffer::try_new(scratch).map_err(|_| failure)?;
        Ok(Self {
            values: vec![0.0; rows.len()],
            factor: vec![0.0; symbolic.len_val()],
            right_hand_side: vec![0.0; unknowns],
            starts,
            rows,
            sources,
            symbolic,
            memory,
        })
    }

    /// Numeric factorisation; a row that is empty stands for an unknown that is dropped.
    pub(super) fn factorize<const C: usize>(
        &mut self,
        matrix: &BlockMatrix<C>,
    ) -> Result<(), SolveError> {
        let blocks = matrix.data();
        for (value, &(block, row, column)) in self.values.iter_mut().zip(&self.sources) {
            *value = blocks[block as usize][(row as usize, column as usize)];
        }
        let unknowns = self.right_hand_side.len();
        for column in 0..unknowns {
            // The diagonal is the first entry of its column in the lower triangle.
            let diagonal = &mut self.values[self.starts[column]];
            if *diagonal == 0.0 {
                *diagonal = 1.0;
            }
        }
        let pattern = SymbolicSparseColMatRef::new_checked(
            unknowns,
            unknowns,
            &self.starts,
            None,
            &self.rows,
        );
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(pattern, &self.values),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Spec::<LltParams, f64>::default(),
            )
            .map(|_| ())
            .map_err(
                |LltError::NonPositivePivot { index }| SolveError::IndefiniteCoarseMatrix {
                    pivot: index,
                    unknowns,
                },
            )
    }

    /// Solves for one right-hand side; dropped components of the solution are zero.
    pub(super) fn solve<const C: usize>(
        &mut self,
        residual: &[SVector<f64, C>],
        dropped: &[[bool; C]],
        correction: &mut [SVector<f64, C>],
    ) {
        for (values, residual) in self.right_hand_side.chunks_exact_mut(C).zip(residual) {
            values.copy_from_slice(residual.as_slice());
        }
        let unknowns = self.right_hand_side.len();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut self.right_hand_side, unknowns, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        for ((values, correction), dropped) in self
            .right_hand_side
            .chunks_exact(C)
            .zip(correction)
            .zip(dropped)
        {
            for c in 0..C {
                correction[c] = if dropped[c] { 0.0 } else { values[c] };
            }
        }
    }
}
