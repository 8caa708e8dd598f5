//! Data that depend on the pattern of the operator: order, symbolic factor, buffers, memory.

use nalgebra::SVector;

use crate::block::FIXED;
use crate::cholesky::{Analysis, Layout, Memory, tallest};
use crate::dense::{DenseMatrix, Unknowns, Workspace};
use crate::{BlockMatrix, SolveError};

use super::cache::Cache;

/// Data that depend on the pattern of the operator alone.
#[derive(Debug)]
pub(super) struct Problem<const C: usize> {
    pub(super) layout: Layout<C>,
    pub(super) analysis: Analysis,
    /// The dense problem; its vertices are the frictional ones, counted along the boundary.
    pub(super) boundary: Workspace<C>,
    pub(super) places: Vec<usize>,
    pub(super) fixed: Vec<[bool; C]>,
    /// The velocities of the frictional vertices.
    pub(super) y: Vec<SVector<f64, C>>,
    /// The field in the order of elimination.
    pub(super) x: Vec<f64>,
    /// The same for a change of the boundary, and as a field.
    pub(super) extension: Vec<f64>,
    pub(super) field: Vec<SVector<f64, C>>,
    pub(super) work: Vec<f64>,
    /// The temporary memory of measuring \[byte\].
    measuring: usize,
}

impl<const C: usize> Problem<C> {
    pub(super) fn new(
        operator: &BlockMatrix<C>,
        vertices: &[usize],
        fixed: &[[bool; C]],
        allowed: usize,
    ) -> Result<Self, SolveError> {
        let free = |&vertex: &usize| fixed[vertex].iter().filter(|&&fixed| !fixed).count();
        let frictional: usize = vertices.iter().map(free).sum();
        let unknowns = (0..fixed.len()).map(|vertex| free(&vertex)).sum();
        // Schur complement, Newton matrix and the copy of the operator, known before anything else.
        let factor = (frictional.saturating_mul(frictional)).saturating_mul(size_of::<f64>());
        let dense = DenseMatrix::bytes(frictional).saturating_add(factor);
        let memory = Memory {
            allowed,
            beside: dense.saturating_add(size_of_val(operator.data())),
        };
        memory.admit(unknowns, 0)?;
        let (layout, upper) = Layout::new(operator, vertices, fixed)?;
        let analysis = Analysis::new(&layout, &upper, &memory)?;
        let rows = vertices.iter().map(|&vertex| {
            let shift = |row| {
                if row == FIXED {
                    FIXED
                } else {
                    row - layout.interior as u32
                }
            };
            layout.positions[vertex].map(shift)
        });
        let boundary = Workspace::new(Unknowns::new(rows.collect()), vertices.len()).ok_or(
            SolveError::Analysis {
                what: "operator",
                unknowns,
                entries: layout.lower.rows.len(),
            },
        )?;
        Ok(Self {
            boundary,
            places: (0..vertices.len()).collect(),
            fixed: vertices.iter().map(|&vertex| fixed[vertex]).collect(),
            y: vec![SVector::zeros(); vertices.len()],
            x: vec![0.0; unknowns],
            extension: vec![0.0; unknowns],
            field: vec![SVector::zeros(); fixed.len()],
            work: vec![0.0; tallest(&analysis.symbolic)],
            measuring: analysis.congruence_bytes(layout.interior),
            layout,
            analysis,
        })
    }

    /// The number of factors that fit into `allowed` bytes, at least one.
    pub(super) fn affordable(&self, allowed: usize) -> usize {
        self.affordable_beside(0, allowed).max(1)
    }

    /// The number of factors that fit beside the temporary memory of measuring; 0 if that does not fit.
    pub(super) fn affordable_measured(&self, allowed: usize) -> usize {
        self.affordable_beside(self.measuring, allowed)
    }

    /// Derives the norm of boundary changes from the factor in use.
    pub(super) fn measure(&mut self, cache: &mut Cache<C>, norm: &BlockMatrix<C>) {
        let Some(factor) = cache.current_mut() else {
            return;
        };
        factor.gram.resize(factor.schur.columns().len(), 0.0);
        (self.analysis).congruence(&self.layout, norm, &factor.entries, &mut factor.gram);
    }

    fn affordable_beside(&self, beside: usize, allowed: usize) -> usize {
        let count = self.boundary.unknowns.count();
        let dense = count * count * size_of::<f64>();
        let norm = operator_bytes(&self.layout);
        let shared = self.layout.bytes() + self.analysis.bytes() + dense + norm + beside;
        // The Schur complement, and what measures changes of the boundary.
        let each = factor_bytes(&self.layout, &self.analysis) + DenseMatrix::bytes(count) + dense;
        allowed.saturating_sub(shared) / each.max(1)
    }
}

/// The memory of a copy of an operator \[byte\].
fn operator_bytes<const C: usize>(layout: &Layout<C>) -> usize {
    size_of::<f64>() * C * C * layout.blocks()
}

/// The memory of a factor and of the copy of its operator \[byte\].
fn factor_bytes<const C: usize>(layout: &Layout<C>, analysis: &Analysis) -> usize {
    analysis.factor_bytes() + operator_bytes(layout)
}
