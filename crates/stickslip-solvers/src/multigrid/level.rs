//! One level: its matrix, the inverses of its diagonal blocks, its fields.

use nalgebra::{SMatrix, SVector};

use super::couplings::Couplings;
use super::entries::Entries;
use super::galerkin::{self, Product, RowsMut};
use super::line_smoother::Sets;
use super::transfer::Transfer;
use crate::block::inverse;
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Frames, SolveError};

/// The colouring of so many rows with a bandwidth.
pub(super) type Cut = fn(usize, usize) -> Colouring;

/// Smallest number of rows of a Galerkin product that is worth a thread, and largest number of parts.
const ROWS: usize = 2048;
const PARTS: usize = 16;

/// The second-order model of friction at the current iterate, one entry per frictional vertex.
pub(crate) struct Linearization<'a, const C: usize> {
    pub(crate) vertices: &'a [usize],
    pub(crate) hessians: &'a [SMatrix<f64, C, C>],
    /// The components that are fixed or truncated.
    pub(crate) dropped: &'a [[bool; C]],
}

/// A level of the hierarchy.
#[derive(Debug)]
pub(crate) struct Level<const C: usize> {
    /// Rows and columns of dropped components are zero. The finest level has one only if its cycle reads more than the
    /// couplings; its entries are those of the operator.
    pub(super) matrix: Option<BlockMatrix<C>>,
    pub(super) couplings: Couplings<C>,
    /// Inverse diagonal blocks, zero on dropped components.
    pub(crate) inverses: Vec<SMatrix<f64, C, C>>,
    /// The permanently fixed components.
    pub(super) fixed: Vec<[bool; C]>,
    /// The components that are currently fixed or truncated.
    pub(crate) dropped: Vec<[bool; C]>,
    /// The frictional vertices, whose components may be dropped, increasing.
    frictional: Vec<u32>,
    /// The slopes of friction there, on the finest level since the last refresh.
    hessians: Vec<SMatrix<f64, C, C>>,
    /// The rows that truncation and friction can change, increasing.
    pub(super) strip: Vec<u32>,
    /// The frictional vertices on the finer level: (this level's vertex, the finer level's).
    pub(super) copies: Vec<(u32, u32)>,
    /// The cuts between parts of rows whose Galerkin products are computed in parallel.
    pub(super) cuts: Vec<usize>,
    /// The position of a column in its row, once per part; scratch of the Galerkin product.
    pub(super) positions: Vec<u32>,
    /// The order in which sweeps visit the rows.
    pub(super) slabs: Colouring,
    /// The sets of the line smoother; empty without stretched cells, and on the coarsest level.
    pub(super) sets: Sets<C>,
    /// The frames of the finest level. Coarser levels keep the coordinates.
    pub(super) frames: Frames<C>,
}

/// The fields of a cycle on a level other than the finest.
#[derive(Debug)]
pub(super) struct Fields<const C: usize> {
    pub(super) residual: Vec<SVector<f64, C>>,
    pub(super) correction: Vec<SVector<f64, C>>,
    /// Contributions of sweeps to rows that they do not read.
    pub(super) sums: Vec<SVector<f64, C>>,
}

impl<const C: usize> Fields<C> {
    pub(super) fn of(level: &Level<C>) -> Self {
        let zeros = || vec![SVector::zeros(); level.size()];
        Self {
            residual: zeros(),
            correction: zeros(),
            sums: zeros(),
        }
    }
}

impl<const C: usize> Level<C> {
    /// A level of a pattern, with the rows that friction reaches besides the neighbours of frictional vertices.
    fn new(
        matrix: &BlockMatrix<C>,
        (cut, single): (Cut, bool),
        fixed: Vec<[bool; C]>,
        frictional: Vec<u32>,
        reached: impl Iterator<Item = u32>,
    ) -> Self {
        let size = matrix.rows();
        let rows = Rows::of(matrix);
        let around = frictional
            .iter()
            .flat_map(|&i| &rows.columns[rows.range(i as usize)]);
        let mut strip: Vec<u32> = around.copied().chain(reached).collect();
        strip.sort_unstable();
        strip.dedup();
        let slabs = cut(size, rows.bandwidth());
        Self {
            inverses: vec![SMatrix::zeros(); size],
            dropped: fixed.clone(),
            fixed,
            hessians: Vec::with_capacity(frictional.len()),
            frictional,
            strip,
            copies: Vec::new(),
            cuts: Vec::new(),
            positions: Vec::new(),
            couplings: Couplings::of(matrix, &slabs, single),
            slabs,
            sets: Sets::default(),
            frames: Frames::default(),
            matrix: None,
        }
    }

    /// The level of the operator itself.
    pub(super) fn finest(
        operator: &BlockMatrix<C>,
        how: (Cut, bool),
        fixed: &[[bool; C]],
        frictional: &[usize],
        frames: &Frames<C>,
    ) -> Self {
        let frictional = frictional.iter().map(|&i| i as u32).collect();
        let reached = std::iter::empty();
        Self {
            frames: frames.clone(),
            ..Self::new(operator, how, fixed.to_vec(), frictional, reached)
        }
    }

    /// The next coarser level: pattern, fixed components and strip, without values.
    pub(super) fn coarsened(
        finer: &Self,
        fine: &BlockMatrix<C>,
        how: (Cut, bool),
        transfer: &Transfer,
    ) -> Self {
        let matrix = galerkin::pattern(fine, transfer);
        let mut fixed = vec![[false; C]; matrix.rows()];
        transfer.for_each_copy(|fine, coarse| fixed[coarse] = finer.seen(fine, &finer.fixed[fine]));
        let mut copies = Vec::new();
        transfer.for_each_copy(|fine, coarse| {
            if finer.frictional.binary_search(&(fine as u32)).is_ok() {
                copies.push((coarse as u32, fine as u32));
            }
        });
        let mut frictional: Vec<u32> = copies.iter().map(|&(coarse, _)| coarse).collect();
        frictional.sort_unstable();
        let parents = Rows::of(&transfer.prolongation);
        let above = finer.strip.iter().flat_map(|&i| parents.row(i as usize));
        let reached = above.map(|(coarse, _)| coarse as u32);
        let size = matrix.rows();
        let parts = if cfg!(feature = "rayon") {
            (size / ROWS).clamp(1, PARTS)
        } else {
            1
        };
        Self {
            copies,
            cuts: (0..=parts).map(|k| size * k / parts).collect(),
            positions: vec![0; size * parts],
            ..Self::new(&matrix, how, fixed, frictional, reached)
        }
        .with_matrix(matrix)
    }

    fn with_matrix(mut self, matrix: BlockMatrix<C>) -> Self {
        self.matrix = Some(matrix);
        self
    }

    /// The number of vertices.
    pub(super) fn size(&self) -> usize {
        self.inverses.len()
    }

    /// The matrix of the finest level, whose entries are those of the operator.
    pub(super) fn of_operator<'a>(&'a self, operator: &'a BlockMatrix<C>) -> Entries<'a, C> {
        Entries {
            rows: Rows::of(operator),
            dropped: &self.dropped,
            frictional: &self.frictional,
            hessians: &self.hessians,
        }
    }

    /// The matrix of a level; that of the finest is given by the operator.
    pub(super) fn entries<'a>(&'a self, operator: &'a BlockMatrix<C>) -> Entries<'a, C> {
        match &self.matrix {
            Some(matrix) => Entries {
                rows: Rows::of(matrix),
                dropped: &self.dropped,
                frictional: &[],
                hessians: &[],
            },
            None => self.of_operator(operator),
        }
    }

    /// Keeps the matrix of the finest level from now on.
    pub(super) fn keep_matrix(&mut self, operator: &BlockMatrix<C>) {
        if self.matrix.is_none() {
            let mut matrix = operator.clone();
            for i in 0..self.size() {
                copy_row(&mut matrix, self.of_operator(operator), i);
            }
            self.matrix = Some(matrix);
        }
    }

    /// The components of a vertex that its coarse copy drops. A vertex with axes of its own drops all or none.
    fn seen(&self, vertex: usize, mask: &[bool; C]) -> [bool; C] {
        match self.frames.of(vertex) {
            None => *mask,
            Some(_) => [mask.iter().all(|&dropped| dropped); C],
        }
    }

    pub(super) fn same_pattern(&self, operator: &BlockMatrix<C>, fixed: &[[bool; C]]) -> bool {
        self.fixed == fixed && self.couplings.has_pattern_of(operator, &self.slabs)
    }

    /// Takes all values of the operator, with the fixed components dropped.
    pub(super) fn restore(&mut self, operator: &BlockMatrix<C>) {
        self.dropped.copy_from_slice(&self.fixed);
        self.hessians.clear();
        for i in 0..self.size() {
            self.take_row(operator, i);
        }
    }

    /// Updates the strip of the finest level.
    pub(super) fn linearize(
        &mut self,
        operator: &BlockMatrix<C>,
        linearization: &Linearization<'_, C>,
    ) -> Result<(), SolveError> {
        for (&vertex, dropped) in linearization.vertices.iter().zip(linearization.dropped) {
            self.dropped[vertex] = *dropped;
        }
        self.hessians.clear();
        self.hessians.extend_from_slice(linearization.hessians);
        for s in 0..self.strip.len() {
            let vertex = self.strip[s] as usize;
            if !self.take_row(operator, vertex) {
                return Err(SolveError::IndefiniteBlock { vertex });
            }
        }
        self.refresh_sets();
        Ok(())
    }

    /// Takes a row of the operator; false if its diagonal block is not positive definite.
    fn take_row(&mut self, operator: &BlockMatrix<C>, i: usize) -> bool {
        let entries = Entries {
            rows: Rows::of(operator),
            dropped: &self.dropped,
            frictional: &self.frictional,
            hessians: &self.hessians,
        };
        if let Some(matrix) = &mut self.matrix {
            copy_row(matrix, entries, i);
        }
        let diagonal = self.couplings.set_row(i, entries.row(i));
        self.invert(i, &diagonal)
    }

    /// Completes a row of a coarse level for cycles.
    fn complete(&mut self, i: usize) {
        if let Some(matrix) = &self.matrix {
            let row = Rows::of(matrix).row(i).map(|(j, block)| (j, *block));
            let diagonal = self.couplings.set_row(i, row);
            self.invert(i, &diagonal);
        }
    }

    fn refresh_sets(&mut self) {
        if let Some(matrix) = &self.matrix {
            self.sets.refresh(&Rows::of(matrix), &self.dropped);
        }
    }

    /// Computes all values from the finer level.
    pub(super) fn assemble(
        &mut self,
        fine: Entries<'_, C>,
        frames: &Frames<C>,
        transfer: &Transfer,
    ) {
        self.dropped.copy_from_slice(&self.fixed);
        let product = Product {
            fine,
            frames,
            transfer,
            dropped: &self.dropped,
        };
        if let Some(matrix) = &mut self.matrix {
            product.assemble(&self.cuts, RowsMut::of(matrix), &mut self.positions);
        }
        for row in 0..self.size() {
            self.complete(row);
        }
    }

    /// Computes the values of the strip from the finer level.
    pub(super) fn refresh(&mut self, finer: &Self, operator: &BlockMatrix<C>, transfer: &Transfer) {
        for &(coarse, fine) in &self.copies {
            let fine = fine as usize;
            self.dropped[coarse as usize] = finer.seen(fine, &finer.dropped[fine]);
        }
        for s in 0..self.strip.len() {
            let row = self.strip[s] as usize;
            let product = Product {
                fine: finer.entries(operator),
                frames: &finer.frames,
                transfer,
                dropped: &self.dropped,
            };
            if let Some(matrix) = &mut self.matrix {
                product.renew(row, RowsMut::of(matrix), &mut self.positions);
            }
            self.complete(row);
        }
        self.refresh_sets();
    }

    /// Finds the sets of the line smoother: vertices that stretched cells couple strongly.
    pub(super) fn tie(&mut self, operator: &BlockMatrix<C>) {
        let entries = match &self.matrix {
            Some(matrix) => Entries {
                rows: Rows::of(matrix),
                dropped: &self.dropped,
                frictional: &[],
                hessians: &[],
            },
            None => Entries {
                rows: Rows::of(operator),
                dropped: &self.dropped,
                frictional: &self.frictional,
                hessians: &self.hessians,
            },
        };
        if self.sets.find_all(entries) {
            self.keep_matrix(operator);
            if let Some(matrix) = &self.matrix {
                let rows = Rows::of(matrix);
                self.sets.factorize_all(&rows, &self.dropped, &self.strip);
            }
        }
    }

    /// Inverts the diagonal block of a row; false if it is not positive definite.
    fn invert(&mut self, i: usize, block: &SMatrix<f64, C, C>) -> bool {
        match inverse(block, &self.dropped[i]) {
            Some(inverse) => {
                self.inverses[i] = inverse;
                true
            }
            None => {
                // No smoothing there: what is left is the business of the other levels.
                self.inverses[i] = SMatrix::zeros();
                false
            }
        }
    }
}

/// Copies a row of the finest level.
fn copy_row<const C: usize>(matrix: &mut BlockMatrix<C>, entries: Entries<'_, C>, i: usize) {
    let range = entries.rows.range(i);
    for (target, (_, block)) in matrix.data_mut()[range].iter_mut().zip(entries.row(i)) {
        *target = block;
    }
}
