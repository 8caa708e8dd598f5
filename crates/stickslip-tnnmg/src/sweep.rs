//! The nonlinear block Gauss-Seidel sweep: every local problem solved exactly, in vertex order.

use nalgebra::{SMatrix, SVector};

use crate::block::{decouple, inverse_at};
#[cfg(feature = "multigrid")]
use crate::block_matrix::partial_product;
use crate::block_matrix::{Rows, row_product};
use crate::field::clear_masked;
use crate::walk::Walk;
use crate::{BlockMatrix, Energy, Operator, SolveError};

/// Diagonal blocks of the operator, inverted where no friction acts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sweep<const C: usize> {
    /// Inverse on the free components, of every vertex.
    inverses: Vec<SMatrix<f64, C, C>>,
    /// Decoupled block, of every frictional vertex.
    blocks: Vec<SMatrix<f64, C, C>>,
    /// Largest diagonal entry, of every frictional vertex.
    scales: Vec<f64>,
    /// Where the entries behind the diagonal begin, of every row.
    behind: Vec<u32>,
    /// The largest distance of a column from its row.
    bandwidth: usize,
}

impl<const C: usize> Sweep<C> {
    /// Checks the shapes of `energy` and takes the diagonal blocks of its operator.
    pub(crate) fn prepare(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
    ) -> Result<(), SolveError> {
        energy.check()?;
        let size = energy.operator.rows();
        self.inverses.clear();
        self.inverses.reserve(size);
        for vertex in 0..size {
            let inverse = inverse_at(energy.operator, energy.fixed, vertex)?;
            self.inverses.push(inverse);
        }
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
        self.bandwidth = rows.bandwidth();
        self.scales.clear();
        self.scales.extend(
            energy
                .vertices
                .iter()
                .map(|&vertex| energy.operator.diagonal_block(vertex).diagonal().amax()),
        );
        Ok(())
    }

    /// Checks that energy, norm and start are of the sizes that `prepare` saw.
    pub(crate) fn check(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        norm: &BlockMatrix<C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        energy.check_sizes(self.inverses.len(), self.blocks.len(), norm, v)?;
        // A law that rests below a threshold rests under a load that is no number, too.
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
    #[cfg(feature = "multigrid")]
    pub(crate) fn scale(&self, position: usize) -> f64 {
        self.scales[position]
    }

    /// One pass over all vertices in increasing order; the energy does not grow. `moved` becomes the
    /// values before minus those after.
    pub(crate) fn forward(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        self.pass(energy, v, moved, |_, _| ());
    }

    /// [`forward`](Self::forward), and the negative gradient of the energy after it, zero on fixed
    /// components.
    ///
    /// Each vertex was balanced when its turn came, so what is missing there is due to the vertices
    /// behind it: half a product, of changes instead of values. It follows the sweep at the
    /// distance of the bandwidth, while the rows are in cache.
    #[cfg(feature = "multigrid")]
    pub(crate) fn forward_with_residual(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
        residual: &mut [SVector<f64, C>],
    ) {
        let rows = Rows::of(energy.operator);
        let mut balance = |i: usize, moved: &[SVector<f64, C>]| {
            let upper = self.behind[i] as usize..rows.range(i).end;
            residual[i] = partial_product(&rows.columns[upper.clone()], &rows.values[upper], moved);
            clear_masked(&mut residual[i], &energy.fixed[i]);
        };
        let lag = self.bandwidth + 1;
        self.pass(energy, v, moved, |i, moved| {
            if let Some(i) = i.checked_sub(lag) {
                balance(i, moved);
            }
        });
        for i in moved.len().saturating_sub(lag)..moved.len() {
            balance(i, moved);
        }
    }

    /// One pass; `then` is called after each vertex.
    #[inline(always)]
    fn pass(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
        mut then: impl FnMut(usize, &[SVector<f64, C>]),
    ) {
        let rows = Rows::of(energy.operator);
        let mut frictional = Walk::along(energy.vertices);
        for i in 0..v.len() {
            let new = match frictional.at(i) {
                Some(position) => self.minimizer(energy, &rows, position, v),
                None => v[i] + self.inverses[i] * (energy.load[i] - row_product(&rows, i, v)),
            };
            moved[i] = v[i] - new;
            v[i] = new;
            then(i, moved);
        }
    }

    /// What the energy's minimum over the frictional vertex number `position` alone is attained at.
    #[inline]
    fn minimizer(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let vertex = energy.vertices[position];
        let (block, fixed) = (&self.blocks[position], &energy.fixed[vertex]);
        let mut force = energy.load[vertex] - row_product(rows, vertex, v) + block * v[vertex];
        clear_masked(&mut force, fixed);
        let minimizer = energy.potentials.minimize(position, block, &force);
        SVector::from_fn(|c, _| if fixed[c] { v[vertex][c] } else { minimizer[c] })
    }

    /// The squared distance, in the norm of the operator, between a frictional vertex and its local
    /// minimum.
    #[cfg(feature = "multigrid")]
    pub(crate) fn local_error(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, v) - v[energy.vertices[position]];
        change.dot(&(self.blocks[position] * change))
    }

    /// The largest component of the force that moves a frictional vertex to its local minimum.
    #[cfg(feature = "multigrid")]
    pub(crate) fn local_force(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        position: usize,
        v: &[SVector<f64, C>],
    ) -> f64 {
        let rows = Rows::of(energy.operator);
        let change = self.minimizer(energy, &rows, position, v) - v[energy.vertices[position]];
        (self.blocks[position] * change).amax()
    }
}
