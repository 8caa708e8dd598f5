//! The sparse factor: faer's supernodal Cholesky, and the Schur complement it leaves at the end.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::{LltError, LltParams};
use faer::linalg::matmul::matmul;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::simplicial::prefactorize_symbolic_cholesky;
use faer::sparse::linalg::cholesky::supernodal::{
    SymbolicSupernodalCholesky, factorize_supernodal_numeric_llt,
    factorize_supernodal_numeric_llt_scratch, factorize_supernodal_symbolic_cholesky,
    factorize_supernodal_symbolic_cholesky_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Accum, MatMut, MatRef, Par, Spec};

use crate::{BlockMatrix, SolveError};

use super::layout::{Layout, Pattern};
use super::memory::Memory;

/// The pattern of the factor and the memory of the numeric factorisation.
pub(crate) struct Analysis {
    pub(crate) symbolic: SymbolicSupernodalCholesky<usize>,
    pub(super) values: Vec<f64>,
    memory: MemBuffer,
    scratch: usize,
}

/// Largest number of columns and share of zeros up to which supernodes are merged. faer's defaults, for factorisations,
/// store 8 percent more in the plane, and every solve reads it.
const RELAX: &[(usize, f64)] = &[(4, 0.5), (16, 0.2), (48, 0.1), (usize::MAX, 0.05)];

impl std::fmt::Debug for Analysis {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Analysis")
            .field("unknowns", &self.symbolic.nrows())
            .field("entries", &self.symbolic.len_val())
            .finish_non_exhaustive()
    }
}

impl Analysis {
    /// Finds the pattern of the factor. Refuses a factor that would exceed the memory before allocating it. The check
    /// runs twice: the number of entries is known before their pattern, which takes memory, too.
    pub(crate) fn new<const C: usize>(
        layout: &Layout<C>,
        upper: &Pattern,
        memory: &Memory,
    ) -> Result<Self, SolveError> {
        Self::of((&layout.lower, upper), layout.bytes(), memory)
    }

    /// The analysis beside a layout of a given size in bytes. Code that is independent of the dimension is compiled
    /// once.
    fn of(
        (lower, upper): (&Pattern, &Pattern),
        layout_bytes: usize,
        memory: &Memory,
    ) -> Result<Self, SolveError> {
        let unknowns = lower.columns();
        let failure = || SolveError::Analysis {
            what: "operator",
            unknowns,
            entries: lower.rows.len(),
        };
        let pattern = SymbolicSparseColMatRef::new_checked(
            unknowns,
            unknowns,
            &upper.starts,
            None,
            &upper.rows,
        );
        let request = factorize_supernodal_symbolic_cholesky_scratch::<usize>(unknowns)
            .or(StackReq::new::<usize>(unknowns));
        let mut buffer = MemBuffer::try_new(request).map_err(|_| failure())?;
        let stack = MemStack::new(&mut buffer);
        let (mut tree, mut counts) = (vec![0_isize; unknowns], vec![0_usize; unknowns]);
        let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, stack);
        let entries = counts.iter().fold(0_usize, |sum, &n| sum.saturating_add(n));
        let shared = layout_bytes + size_of_val(&lower.rows[..]);
        let least = entries
            .saturating_mul(size_of::<f64>())
            .saturating_add(shared);
        memory.admit(unknowns, least)?;
        let symbolic = factorize_supernodal_symbolic_cholesky(
            pattern,
            tree,
            &counts,
            stack,
            SymbolicSupernodalParams { relax: Some(RELAX) },
        )
        .map_err(|_| failure())?;
        let request = factorize_supernodal_numeric_llt_scratch::<usize, f64>(
            &symbolic,
            Par::Seq,
            Spec::default(),
        );
        let mut analysis = Self {
            values: vec![0.0; lower.rows.len()],
            memory: MemBuffer::new(StackReq::EMPTY),
            scratch: request.unaligned_bytes_required(),
            symbolic,
        };
        let needed = layout_bytes + analysis.bytes() + analysis.factor_bytes();
        memory.admit(unknowns, needed)?;
        analysis.memory = MemBuffer::try_new(request).map_err(|_| failure())?;
        Ok(analysis)
    }

    /// The memory of the entries of one factor \[byte\].
    pub(crate) fn factor_bytes(&self) -> usize {
        size_of::<f64>().saturating_mul(self.symbolic.len_val())
    }

    /// The memory of the analysis \[byte\].
    pub(crate) fn bytes(&self) -> usize {
        let indices = self.symbolic.row_idx().len() + 6 * self.symbolic.n_supernodes();
        self.scratch + size_of_val(&self.values[..]) + size_of::<usize>() * indices
    }

    /// Fills `factor` with the factor of an operator of this pattern.
    pub(crate) fn factorize<const C: usize>(
        &mut self,
        layout: &Layout<C>,
        operator: &BlockMatrix<C>,
        factor: &mut [f64],
    ) -> Result<(), SolveError> {
        self.gather(layout, operator);
        self.eliminate(&layout.lower, factor)
            .map_err(|pivot| self.failure(layout, operator, factor, pivot))
    }

    /// The same. If the operator is definite on the interior alone, as where friction alone supports a body, the
    /// diagonal entries after the interior are doubled. Returns whether they are: [`relax_schur`](Self::relax_schur)
    /// then subtracts the addition from the Schur complement.
    pub(crate) fn factorize_interior<const C: usize>(
        &mut self,
        layout: &Layout<C>,
        operator: &BlockMatrix<C>,
        factor: &mut [f64],
    ) -> Result<bool, SolveError> {
        self.gather(layout, operator);
        let Err(pivot) = self.eliminate(&layout.lower, factor) else {
            return Ok(false);
        };
        for column in layout.interior..layout.unknowns() {
            self.values[layout.lower.starts[column]] *= 2.0;
        }
        match self.eliminate(&layout.lower, factor) {
            Ok(()) => Ok(true),
            Err(_) => Err(self.failure(layout, operator, factor, pivot)),
        }
    }

    /// Subtracts from a Schur complement the addition of a stiffened factorisation: exactly half of the diagonal
    /// entries as they stand.
    pub(crate) fn relax_schur<const C: usize>(&self, layout: &Layout<C>, schur: &mut [f64]) {
        let count = layout.unknowns() - layout.interior;
        for i in 0..count {
            let added = 0.5 * self.values[layout.lower.starts[layout.interior + i]];
            schur[i * count + i] -= added;
        }
    }

    /// The vertex of a pivot that rounding may have made, among the first `columns` of the factor that was just
    /// computed.
    pub(crate) fn rounded_pivot<const C: usize>(
        &self,
        layout: &Layout<C>,
        factor: &[f64],
        columns: usize,
    ) -> Option<usize> {
        const ROUNDING: f64 = 1e-10;
        let symbolic = &self.symbolic;
        (0..symbolic.n_supernodes()).find_map(|s| {
            let (begin, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
            let height = end - begin + symbolic.supernode(s).pattern().len();
            let panel = &factor[symbolic.col_ptr_for_val()[s]..];
            let rounded = |&column: &usize| {
                let pivot = panel[(column - begin) * (height + 1)].powi(2);
                pivot <= ROUNDING * self.values[layout.lower.starts[column]]
            };
            let column = (begin..end.min(columns)).find(rounded)?;
            Some(layout.owners[column] as usize)
        })
    }

    /// Gathers the entries of an operator in the order of the pattern.
    pub(super) fn gather<const C: usize>(&mut self, layout: &Layout<C>, operator: &BlockMatrix<C>) {
        let blocks = operator.data();
        for (value, &(block, row, column)) in self.values.iter_mut().zip(&layout.sources) {
            *value = blocks[block as usize][(row as usize, column as usize)];
        }
    }

    /// The reason of a failed factorisation: an operator that a small addition to its diagonal makes definite lacks a
    /// support.
    fn failure<const C: usize>(
        &mut self,
        layout: &Layout<C>,
        operator: &BlockMatrix<C>,
        factor: &mut [f64],
        pivot: usize,
    ) -> SolveError {
        const LITTLE: f64 = 1e-8;
        self.gather(layout, operator);
        for column in 0..layout.unknowns() {
            self.values[layout.lower.starts[column]] *= 1.0 + LITTLE;
        }
        let vertex = layout.owners[pivot] as usize;
        match self.eliminate(&layout.lower, factor) {
            Ok(()) => SolveError::RigidBodyMode { vertex },
            Err(_) => SolveError::IndefiniteMatrix {
                what: "operator",
                pivot,
                unknowns: layout.unknowns(),
                vertex,
            },
        }
    }

    /// Factorises the gathered entries; the error is the pivot that is not positive, in the order of elimination.
    fn eliminate(&mut self, lower: &Pattern, factor: &mut [f64]) -> Result<(), usize> {
        let unknowns = lower.columns();
        for column in 0..unknowns {
            // The diagonal is the first entry of its column in the lower triangle; a row that is empty
            // stands for a component that is dropped.
            let diagonal = &mut self.values[lower.starts[column]];
            if *diagonal == 0.0 {
                *diagonal = 1.0;
            }
        }
        let pattern = SymbolicSparseColMatRef::new_checked(
            unknowns,
            unknowns,
            &lower.starts,
            None,
            &lower.rows,
        );
        factorize_supernodal_numeric_llt(
            factor,
            SparseColMatRef::new(pattern, &self.values),
            Default::default(),
            &self.symbolic,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::<LltParams, f64>::default(),
        )
        .map(|_| ())
        .map_err(|LltError::NonPositivePivot { index }| index)
    }

    /// `S = L22 L22^T` of the rows from `interior` on, by columns; `work` is of the same size.
    pub(crate) fn schur(
        &self,
        factor: &[f64],
        interior: usize,
        work: &mut [f64],
        schur: &mut [f64],
    ) {
        let count = self.symbolic.nrows() - interior;
        work.fill(0.0);
        for s in 0..self.symbolic.n_supernodes() {
            let (begin, end) = (
                self.symbolic.supernode_begin()[s],
                self.symbolic.supernode_end()[s],
            );
            let below = self.symbolic.supernode(s).pattern();
            let height = end - begin + below.len();
            let panel = &factor[self.symbolic.col_ptr_for_val()[s]..];
            for column in interior.max(begin)..end {
                let local = column - begin;
                let entries = &panel[local * height..][..height];
                let target = &mut work[(column - interior) * count..][..count];
                target[column - interior..end - interior]
                    .copy_from_slice(&entries[local..end - begin]);
                for (&row, &entry) in below.iter().zip(&entries[end - begin..]) {
                    target[row - interior] = entry;
                }
            }
        }
        let lower = MatRef::from_column_major_slice(&*work, count, count);
        matmul(
            MatMut::from_column_major_slice_mut(schur, count, count),
            Accum::Replace,
            lower,
            lower.transpose(),
            1.0,
            Par::Seq,
        );
        // The product is symmetric up to rounding; solvers read both triangles.
        for i in 0..count {
            for j in 0..i {
                schur[i * count + j] = schur[j * count + i];
            }
        }
    }
}
