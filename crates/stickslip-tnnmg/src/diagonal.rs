//! A diagonal operator: every vertex is a problem of its own.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use crate::block::{decouple, inverse};
use crate::block_matrix::Rows;
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};

/// Solves a block diagonal problem exactly, one vertex after the other: what an explicit scheme with a
/// lumped mass leaves.
#[derive(Debug, Clone, Default)]
pub struct Diagonal<const C: usize> {
    inverses: Vec<SMatrix<f64, C, C>>,
    /// Of the frictional vertices.
    blocks: Vec<SMatrix<f64, C, C>>,
    minimizers: Vec<SVector<f64, C>>,
    /// The vertices with a fixed component, and the fixed part of the velocity there.
    held: Vec<usize>,
    prescribed: Vec<SVector<f64, C>>,
}

impl<const C: usize> Diagonal<C> {
    /// A solver that has not yet seen an operator.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<P: ConvexPotential<C>, const C: usize> NonsmoothSolver<BlockMatrix<C>, P, C> for Diagonal<C> {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, P, C>) -> Result<(), SolveError> {
        let size = energy.operator.rows();
        for found in [energy.load.len(), energy.fixed.len()] {
            if found != size {
                return Err(SolveError::SizeMismatch {
                    expected: size,
                    found,
                });
            }
        }
        if energy.vertices.len() != energy.potentials.len() {
            return Err(SolveError::SizeMismatch {
                expected: energy.vertices.len(),
                found: energy.potentials.len(),
            });
        }
        let rows = Rows::of(energy.operator);
        self.inverses.clear();
        self.held.clear();
        self.inverses.reserve(size);
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
        for (position, &vertex) in energy.vertices.iter().enumerate() {
            let sorted = position == 0 || energy.vertices[position - 1] < vertex;
            if !sorted || vertex >= size {
                return Err(SolveError::UnsortedVertices { vertex, position });
            }
            let block = &rows.values[rows.range(vertex).start];
            self.blocks.push(decouple(block, &energy.fixed[vertex]));
        }
        self.minimizers.resize(self.blocks.len(), SVector::zeros());
        self.prescribed.resize(self.held.len(), SVector::zeros());
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        _stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        for (expected, found) in [
            (self.inverses.len(), energy.load.len()),
            (self.inverses.len(), energy.fixed.len()),
            (self.inverses.len(), v.len()),
            (self.blocks.len(), energy.vertices.len()),
            (self.blocks.len(), energy.potentials.len()),
        ] {
            if expected != found {
                return Err(SolveError::SizeMismatch { expected, found });
            }
        }
        let values = energy.operator.data();
        let prescribed = |i: usize, v: &SVector<f64, C>| {
            SVector::<f64, C>::from_fn(|c, _| if energy.fixed[i][c] { v[c] } else { 0.0 })
        };
        for (k, &i) in energy.vertices.iter().enumerate() {
            let held = prescribed(i, &v[i]);
            let mut force = energy.load[i] - values[i] * held;
            clear_masked(&mut force, &energy.fixed[i]);
            self.minimizers[k] = energy.potentials[k].minimize(&self.blocks[k], &force) + held;
        }
        for (held, &i) in self.prescribed.iter_mut().zip(&self.held) {
            *held = prescribed(i, &v[i]);
        }
        let mut sum = 0.0;
        for ((v, inverse), load) in v.iter_mut().zip(&self.inverses).zip(energy.load) {
            *v = inverse * load;
            sum += v.sum();
        }
        // The inverse is zero where a component is fixed.
        for (held, &i) in self.prescribed.iter().zip(&self.held) {
            v[i] += held - self.inverses[i] * (values[i] * held);
        }
        for (minimizer, &i) in self.minimizers.iter().zip(energy.vertices) {
            v[i] = *minimizer;
            sum += minimizer.sum();
        }
        // A sum of finite numbers that overflows is no velocity either.
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
