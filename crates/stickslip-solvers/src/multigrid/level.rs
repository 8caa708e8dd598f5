//! One level: its matrix, the inverses of its diagonal blocks, its fields.

use nalgebra::{SMatrix, SVector};

use super::galerkin::{self, Product, RowsMut};
use super::line_smoother::Sets;
use crate::block::{inverse, without};
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Frames, Prolongation, SolveError};

/// The colouring of so many rows with a bandwidth.
pub(super) type Cut = fn(usize, usize) -> Colouring;

/// Smallest number of rows of a Galerkin product that is worth a thread, and largest number of parts.
const ROWS: usize = 2048;
const PARTS: usize = 16;

/// Prolongation and its transpose, both by rows.
#[derive(Debug, Clone)]
pub(crate) struct Transfer {
    /// Rows: fine vertices.
    pub(super) prolongation: Prolongation,
    /// Rows: coarse vertices.
    pub(super) restriction: Prolongation,
}

impl Transfer {
    pub(super) fn new(prolongation: &Prolongation) -> Self {
        Self {
            prolongation: prolongation.to_csr(),
            restriction: prolongation.transpose_view().to_csr(),
        }
    }

    pub(super) fn fine_count(&self) -> usize {
        self.prolongation.rows()
    }

    /// The fine vertex at the position of a coarse one.
    pub(super) fn copy_of(&self, coarse: usize) -> usize {
        let mut found = coarse;
        self.for_each_copy(|fine, parent| {
            if parent == coarse {
                found = fine;
            }
        });
        found
    }

    /// Calls `visit(fine, coarse)` for every fine vertex that is a coarse one.
    fn for_each_copy(&self, mut visit: impl FnMut(usize, usize)) {
        let rows = Rows::of(&self.prolongation);
        for fine in 0..self.prolongation.rows() {
            if let (Some((coarse, _)), None) = {
                let mut row = rows.row(fine);
                (row.next(), row.next())
            } {
                visit(fine, coarse);
            }
        }
    }
}

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
    /// Rows and columns of dropped components are zero.
    pub(crate) matrix: BlockMatrix<C>,
    /// The blocks of `matrix` at the columns that a forward sweep visits before the row, packed: half of the matrix,
    /// and all that a cycle reads. With one slab these are the blocks below the diagonal.
    pub(super) before: BlockMatrix<C>,
    /// Position of each row's diagonal block in the data of `matrix`.
    pub(super) diagonals: Vec<u32>,
    /// Inverse diagonal blocks, zero on dropped components.
    pub(crate) inverses: Vec<SMatrix<f64, C, C>>,
    /// The permanently fixed components.
    pub(super) fixed: Vec<[bool; C]>,
    /// The components that are currently fixed or truncated.
    pub(crate) dropped: Vec<[bool; C]>,
    /// The frictional vertices, whose components may be dropped, increasing.
    frictional: Vec<u32>,
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
        let zeros = || vec![SVector::zeros(); level.matrix.rows()];
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
        matrix: BlockMatrix<C>,
        cut: Cut,
        fixed: Vec<[bool; C]>,
        frictional: Vec<u32>,
        reached: impl Iterator<Item = u32>,
    ) -> Self {
        let size = matrix.rows();
        let rows = Rows::of(&matrix);
        let around = frictional
            .iter()
            .flat_map(|&i| &rows.columns[rows.range(i as usize)]);
        let mut strip: Vec<u32> = around.copied().chain(reached).collect();
        strip.sort_unstable();
        strip.dedup();
        let diagonals = (0..size)
            .map(|i| {
                let range = rows.range(i);
                let before = rows.columns[range.clone()].partition_point(|&j| (j as usize) < i);
                (range.start + before) as u32
            })
            .collect();
        let slabs = cut(size, rows.bandwidth());
        Self {
            diagonals,
            inverses: vec![SMatrix::zeros(); size],
            dropped: fixed.clone(),
            fixed,
            frictional,
            strip,
            copies: Vec::new(),
            cuts: Vec::new(),
            positions: Vec::new(),
            before: before(&matrix, &slabs),
            slabs,
            sets: Sets::default(),
            frames: Frames::default(),
            matrix,
        }
    }

    /// The level of the operator itself.
    pub(super) fn finest(
        operator: &BlockMatrix<C>,
        cut: Cut,
        fixed: &[[bool; C]],
        frictional: &[usize],
        frames: &Frames<C>,
    ) -> Self {
        let frictional = frictional.iter().map(|&i| i as u32).collect();
        let reached = std::iter::empty();
        Self {
            frames: frames.clone(),
            ..Self::new(operator.clone(), cut, fixed.to_vec(), frictional, reached)
        }
    }

    /// The next coarser level: pattern, fixed components and strip, without values.
    pub(super) fn coarsened(finer: &Self, cut: Cut, transfer: &Transfer) -> Self {
        let matrix = galerkin::pattern(&finer.matrix, transfer);
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
            ..Self::new(matrix, cut, fixed, frictional, reached)
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
        self.fixed == fixed
            && self.matrix.indices() == operator.indices()
            && self.matrix.indptr() == operator.indptr()
    }

    /// Copies all values of the operator, with the fixed components dropped.
    pub(super) fn restore(&mut self, operator: &BlockMatrix<C>) {
        self.dropped.copy_from_slice(&self.fixed);
        for i in 0..self.matrix.rows() {
            self.copy_row(operator, i);
        }
        for i in 0..self.matrix.rows() {
            self.complete(i);
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
        for s in 0..self.strip.len() {
            self.copy_row(operator, self.strip[s] as usize);
        }
        for (&vertex, hessian) in linearization.vertices.iter().zip(linearization.hessians) {
            let dropped = &self.dropped[vertex];
            let block = &mut self.matrix.data_mut()[self.diagonals[vertex] as usize];
            for c in (0..C).filter(|&c| !dropped[c]) {
                for r in (0..C).filter(|&r| !dropped[r]) {
                    block[(r, c)] += hessian[(r, c)];
                }
            }
        }
        for s in 0..self.strip.len() {
            let vertex = self.strip[s] as usize;
            if !self.complete(vertex) {
                return Err(SolveError::IndefiniteBlock { vertex });
            }
        }
        self.sets.refresh(&Rows::of(&self.matrix), &self.dropped);
        Ok(())
    }

    /// Computes all values from the finer level.
    pub(super) fn assemble(&mut self, finer: &Self, transfer: &Transfer) {
        self.dropped.copy_from_slice(&self.fixed);
        let product = Product {
            fine: finer,
            transfer,
            dropped: &self.dropped,
        };
        let rows = RowsMut::of(&mut self.matrix);
        product.assemble(&self.cuts, rows, &mut self.positions);
        for row in 0..self.matrix.rows() {
            self.complete(row);
        }
    }

    /// Computes the values of the strip from the finer level.
    pub(super) fn refresh(&mut self, finer: &Self, transfer: &Transfer) {
        for &(coarse, fine) in &self.copies {
            let fine = fine as usize;
            self.dropped[coarse as usize] = finer.seen(fine, &finer.dropped[fine]);
        }
        for s in 0..self.strip.len() {
            let row = self.strip[s] as usize;
            let product = Product {
                fine: finer,
                transfer,
                dropped: &self.dropped,
            };
            product.renew(row, RowsMut::of(&mut self.matrix), &mut self.positions);
            self.complete(row);
        }
        self.sets.refresh(&Rows::of(&self.matrix), &self.dropped);
    }

    /// Finds the sets of the line smoother: vertices that stretched cells couple strongly.
    pub(super) fn tie(&mut self) {
        let rows = Rows::of(&self.matrix);
        self.sets.tie(&rows, &self.dropped, &self.strip);
    }

    /// Copies a row of the operator without the dropped rows and columns.
    fn copy_row(&mut self, operator: &BlockMatrix<C>, i: usize) {
        let source = Rows::of(operator);
        let range = source.range(i);
        let dropped = &self.dropped;
        let target = &mut self.matrix.data_mut()[range.clone()];
        for ((target, value), &j) in target
            .iter_mut()
            .zip(&source.values[range.clone()])
            .zip(&source.columns[range])
        {
            *target = without(value, &dropped[i], &dropped[j as usize]);
        }
    }

    /// Completes a row for cycles and inverts its diagonal block; false if that is not positive definite.
    fn complete(&mut self, i: usize) -> bool {
        let before = Rows::of(&self.before).range(i);
        let mut row = Rows::of(&self.matrix).row(i);
        for k in before {
            let column = self.before.indices()[k] as usize;
            if let Some((_, value)) = row.find(|&(j, _)| j == column) {
                self.before.data_mut()[k] = *value;
            }
        }
        let block = &self.matrix.data()[self.diagonals[i] as usize];
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

/// The pattern of the entries whose column a forward sweep visits before the row, with zero values.
fn before<const C: usize>(matrix: &BlockMatrix<C>, slabs: &Colouring) -> BlockMatrix<C> {
    let rows = Rows::of(matrix);
    let (mut starts, mut columns) = (vec![0], Vec::new());
    slabs.for_each(|slab, narrow| {
        for i in slab.clone() {
            let row = &rows.columns[rows.range(i)];
            columns.extend(row.iter().filter(|&&j| {
                let j = j as usize;
                if slab.contains(&j) { j < i } else { narrow }
            }));
            starts.push(columns.len() as u32);
        }
    });
    let values = vec![SMatrix::zeros(); columns.len()];
    BlockMatrix::new((matrix.rows(), matrix.cols()), starts, columns, values)
}
