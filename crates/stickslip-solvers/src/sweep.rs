//! The nonlinear block Gauss-Seidel sweep: every local problem is solved exactly, one slab of vertices after the other.

mod local;
mod passes;
#[cfg(feature = "multigrid")]
mod residual;
mod rounding;
#[cfg(all(test, feature = "multigrid"))]
mod tests;

#[cfg(feature = "multigrid")]
pub(crate) use rounding::{ROUNDINGS, force_and_terms};

use nalgebra::{SMatrix, SVector};

use crate::block::decouple;
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Energy, Matrix, SolveError};

/// The inverses of the diagonal blocks of the operator on the free components, one per vertex; with `None` a sweep
/// factorises the blocks that it meets.
pub(crate) type Inverses<'a, const C: usize> = Option<&'a [SMatrix<f64, C, C>]>;

/// The diagonal blocks of the operator at frictional vertices, and the order of the rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sweep<const C: usize> {
    /// Decoupled block, for every frictional vertex.
    blocks: Vec<SMatrix<f64, C, C>>,
    /// Largest diagonal entry, for every frictional vertex.
    scales: Vec<f64>,
    /// The start of the entries after the diagonal, for every row.
    behind: Vec<u32>,
    /// The order of the rows: wide slabs first.
    slabs: Colouring,
}

impl<const C: usize> Sweep<C> {
    /// Checks the shapes of `energy` and takes the diagonal blocks of its operator.
    pub(crate) fn prepare(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
    ) -> Result<(), SolveError> {
        energy.check()?;
        let size = energy.operator.rows();
        self.blocks.clear();
        self.blocks.extend(energy.vertices.iter().map(|&vertex| {
            decouple(
                &energy.operator.diagonal_block(vertex),
                &energy.fixed[vertex],
            )
        }));
        let rows = Rows::of(energy.operator);
        self.behind.clear();
        self.behind.extend((0..size).map(|i| {
            let range = rows.range(i);
            let upto = rows.columns[range.clone()].partition_point(|&j| j as usize <= i);
            (range.start + upto) as u32
        }));
        let bandwidth = rows.bandwidth();
        if !self.slabs.are_of(size, bandwidth) {
            self.slabs = Colouring::new(size, bandwidth);
        }
        self.scales.clear();
        self.scales.extend(
            energy
                .vertices
                .iter()
                .map(|&vertex| energy.operator.diagonal_block(vertex).diagonal().amax()),
        );
        Ok(())
    }

    /// Checks that energy, norm and start have the sizes of the preparation.
    pub(crate) fn check(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        norm: &BlockMatrix<C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        energy.check_sizes(self.behind.len(), self.blocks.len(), norm, v)?;
        // A law with a threshold returns rest even for a NaN load: test the load first.
        if !energy.load.iter().flatten().all(|load| load.is_finite()) {
            let change = f64::NAN;
            return Err(SolveError::NotFinite {
                iteration: 1,
                change,
            });
        }
        Ok(())
    }

    /// The size of the diagonal block of a frictional vertex: its largest diagonal entry.
    pub(crate) fn scale(&self, position: usize) -> f64 {
        self.scales[position]
    }
}
