//! A diagonal operator: every vertex is a separate problem.

use nalgebra::{SMatrix, SVector};

use crate::block::{decouple, inverse};
use crate::block_matrix::Rows;
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};

/// Solves a block diagonal problem exactly, one vertex after the other. An explicit scheme with a lumped mass has such
/// a problem.
#[derive(Debug, Clone, Default)]
pub struct Diagonal<const C: usize> {
    inverses: Vec<SMatrix<f64, C, C>>,
    /// The blocks of the frictional vertices.
    blocks: Vec<SMatrix<f64, C, C>>,
    minimizers: Vec<SVector<f64, C>>,
    /// The vertices with a fixed component, and the fixed part of the velocity there.
    held: Vec<usize>,
    prescribed: Vec<SVector<f64, C>>,
}

impl<const C: usize> Diagonal<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Diagonal<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(self.clone())
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        energy.check()?;
        let rows = Rows::of(energy.operator);
        self.inverses.clear();
        self.held.clear();
        for (vertex, fixed) in energy.fixed.iter().enumerate() {
            let mut row = rows.row(vertex);
            let (Some((column, block)), None) = (row.next(), row.next()) else {
                return Err(SolveError::NotDiagonal { vertex });
            };
            if column != vertex {
                return Err(SolveError::NotDiagonal { vertex });
            }
            let inverse = inverse(block, fixed).ok_or(SolveError::IndefiniteBlock { vertex })?;
            self.inverses.push(inverse);
            if fixed.iter().any(|&fixed| fixed) {
                self.held.push(vertex);
            }
        }
        self.blocks.clear();
        for &vertex in energy.vertices {
            let block = &rows.values[rows.range(vertex).start];
            self.blocks.push(decouple(block, &energy.fixed[vertex]));
        }
        self.minimizers.resize(self.blocks.len(), SVector::zeros());
        self.prescribed.resize(self.held.len(), SVector::zeros());
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let (size, frictional) = (self.inverses.len(), self.blocks.len());
        energy.check_sizes(size, frictional, stopping.norm, v)?;
        let values = energy.operator.data();
        let prescribed = |i: usize, v: &SVector<f64, C>| {
            SVector::<f64, C>::from_fn(|c, _| if energy.fixed[i][c] { v[c] } else { 0.0 })
        };
        for (k, &i) in energy.vertices.iter().enumerate() {
            let held = prescribed(i, &v[i]);
            let mut force = energy.load[i] - values[i] * held;
            clear_masked(&mut force, &energy.fixed[i]);
            self.minimizers[k] = energy.potentials.minimize(k, &self.blocks[k], &force) + held;
        }
        for (held, &i) in self.prescribed.iter_mut().zip(&self.held) {
            *held = prescribed(i, &v[i]);
        }
        let mut sum = SVector::<f64, C>::zeros();
        for ((v, inverse), load) in v.iter_mut().zip(&self.inverses).zip(energy.load) {
            *v = inverse * load;
            sum += *v;
        }
        // The inverse is zero where a component is fixed.
        for (held, &i) in self.prescribed.iter().zip(&self.held) {
            v[i] += held - self.inverses[i] * (values[i] * held);
        }
        for (minimizer, &i) in self.minimizers.iter().zip(energy.vertices) {
            v[i] = *minimizer;
            sum += minimizer;
        }
        // A sum of finite numbers that overflows is no velocity either.
        let sum = sum.sum();
        if sum.is_finite() {
            Ok(SolveReport {
                iterations: 1,
                cycles: 0,
                error: 0.0,
            })
        } else {
            Err(SolveError::NotFinite {
                iteration: 1,
                change: sum,
            })
        }
    }
}
