//! The convex functional of one velocity problem.

use std::fmt;

use nalgebra::SVector;

use crate::block::{decouple, inverse};
use crate::{Matrix, Potentials, SolveError};

/// `J(v) = v.Bv/2 - r.v + sum_p phi_p(v_p)` on the fields with given fixed components.
///
/// | field | shape | meaning |
/// | --- | --- | --- |
/// | `operator` | vertices x vertices | `B`, symmetric, positive definite on the free components, or semidefinite and `J` coercive by its potentials [N s/m] |
/// | `load` | one vector per vertex | `r` \[N\] |
/// | `potentials` | one per frictional vertex | `phi_p`, convex |
/// | `vertices` | one index per frictional vertex, increasing | vertices of the potentials |
/// | `fixed` | one mask per vertex | components that keep the value of the start vector |
///
/// A component that is fixed at a frictional vertex (the normal one of bilateral contact) has the value zero there,
/// unless its potential includes the value.
pub struct Energy<'a, Op, const C: usize> {
    /// `B`.
    pub operator: &'a Op,
    /// `r`.
    pub load: &'a [SVector<f64, C>],
    /// `phi_p` of every frictional vertex.
    pub potentials: &'a dyn Potentials<C>,
    /// The frictional vertices, increasing.
    pub vertices: &'a [usize],
    /// The components that are not unknowns.
    pub fixed: &'a [[bool; C]],
}

impl<Op, const C: usize> Clone for Energy<'_, Op, C> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Op, const C: usize> Copy for Energy<'_, Op, C> {}

impl<Op: fmt::Debug, const C: usize> fmt::Debug for Energy<'_, Op, C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Energy")
            .field("operator", self.operator)
            .field("load", &self.load)
            .field("vertices", &self.vertices)
            .field("fixed", &self.fixed)
            .finish_non_exhaustive()
    }
}

impl<Op: Matrix<C>, const C: usize> Energy<'_, Op, C> {
    /// `J(v)` [N m/s].
    pub fn value(&self, v: &[SVector<f64, C>]) -> f64 {
        let linear: f64 = self.load.iter().zip(v).map(|(r, v)| r.dot(v)).sum();
        let nonlinear: f64 = (self.vertices.iter().enumerate())
            .map(|(k, &vertex)| self.potentials.value(k, &v[vertex]))
            .sum();
        0.5 * self.operator.quadratic(v) - linear + nonlinear
    }

    /// The minimiser over vertex `i` alone, with all others as in `v`; fixed components stay. `None` unless the
    /// diagonal block is positive definite on its free components.
    ///
    /// It costs a product with one row, and is as exact as `B_ii v_i` relative to the load.
    pub fn local_minimizer(&self, i: usize, v: &[SVector<f64, C>]) -> Option<SVector<f64, C>> {
        let fixed = &self.fixed[i];
        let full = self.operator.diagonal_block(i);
        let free = SVector::from_fn(|c, _| if fixed[c] { 0.0 } else { v[i][c] });
        let mut force = self.load[i] - self.operator.product_at(i, v) + full * free;
        for c in (0..C).filter(|&c| fixed[c]) {
            force[c] = 0.0;
        }
        let minimizer = match self.vertices.binary_search(&i) {
            Ok(k) => (self.potentials).minimize(k, &decouple(&full, fixed), &force),
            Err(_) => inverse(&full, fixed)? * force,
        };
        Some(SVector::from_fn(|c, _| {
            if fixed[c] { v[i][c] } else { minimizer[c] }
        }))
    }

    /// Checks that the sizes are consistent.
    ///
    /// # Errors
    /// [`SolveError::SizeMismatch`] for lengths that differ from the operator's,
    /// [`SolveError::UnsortedVertices`].
    pub fn check(&self) -> Result<(), SolveError> {
        let size = self.operator.vertex_count();
        expect([
            (size, self.load.len()),
            (size, self.fixed.len()),
            (self.vertices.len(), self.potentials.len()),
        ])?;
        for (position, &vertex) in self.vertices.iter().enumerate() {
            let sorted = position == 0 || self.vertices[position - 1] < vertex;
            if !sorted || vertex >= size {
                return Err(SolveError::UnsortedVertices { vertex, position });
            }
        }
        Ok(())
    }

    /// Checks, for a minimisation from `v`, that all sizes are those of the preparation.
    #[cfg(feature = "sparse")]
    pub(crate) fn check_sizes(
        &self,
        size: usize,
        frictional: usize,
        norm: &Op,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        expect([
            (size, self.operator.vertex_count()),
            (size, self.load.len()),
            (size, self.fixed.len()),
            (size, norm.vertex_count()),
            (size, v.len()),
            (frictional, self.vertices.len()),
            (frictional, self.potentials.len()),
        ])
    }
}

pub(crate) fn expect(sizes: impl IntoIterator<Item = (usize, usize)>) -> Result<(), SolveError> {
    for (expected, found) in sizes {
        if expected != found {
            return Err(SolveError::SizeMismatch { expected, found });
        }
    }
    Ok(())
}
