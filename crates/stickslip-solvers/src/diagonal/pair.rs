//! Two vertices on both sides of a fault.

use nalgebra::{SMatrix, SVector};

use crate::block::{decouple, inverse, is_definite_with};
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy, Matrix, SolveError};

/// Two vertices that are coupled to each other alone.
#[derive(Debug, Clone)]
pub(super) struct Pair<const C: usize> {
    /// The one with friction, if any has, and its partner.
    pub(super) vertices: [usize; 2],
    /// The position of the first among the frictional vertices.
    position: Option<usize>,
    blocks: [SMatrix<f64, C, C>; 2],
    /// The block of the first row and the second column.
    coupling: SMatrix<f64, C, C>,
    /// The inverse of the partner's block, and of the Schur complement of the first, on free components.
    inverses: [SMatrix<f64, C, C>; 2],
    /// The Schur complement, decoupled from fixed components.
    schur: SMatrix<f64, C, C>,
}

impl<const C: usize> Pair<C> {
    pub(super) fn new(
        energy: &Energy<'_, BlockMatrix<C>, C>,
        vertices: [usize; 2],
        coupling: SMatrix<f64, C, C>,
    ) -> Result<Self, SolveError> {
        let [i, j] = vertices;
        let blocks = vertices.map(|vertex| energy.operator.diagonal_block(vertex));
        let position = |vertex: usize| energy.vertices.binary_search(&vertex).ok();
        let partner = inverse(&blocks[1], &energy.fixed[j])
            .ok_or(SolveError::IndefiniteBlock { vertex: j })?;
        let schur = blocks[0] - coupling * partner * coupling.transpose();
        let own =
            inverse(&schur, &energy.fixed[i]).ok_or(SolveError::IndefiniteBlock { vertex: i })?;
        Ok(Self {
            vertices,
            position: position(i),
            blocks,
            coupling,
            inverses: [partner, own],
            schur: decouple(&schur, &energy.fixed[i]),
        })
    }

    /// The velocities of both, with the fixed components of `v`.
    pub(super) fn solve(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &[SVector<f64, C>],
    ) -> [SVector<f64, C>; 2] {
        let [i, j] = self.vertices;
        let held = self.vertices.map(|vertex| {
            SVector::<f64, C>::from_fn(|c, _| {
                if energy.fixed[vertex][c] {
                    v[vertex][c]
                } else {
                    0.0
                }
            })
        });
        let (own, partner) = (self.blocks[0], self.blocks[1]);
        let mut right = [
            energy.load[i] - own * held[0] - self.coupling * held[1],
            energy.load[j] - partner * held[1] - self.coupling.tr_mul(&held[0]),
        ];
        right[0] -= self.coupling * (self.inverses[0] * right[1]);
        clear_masked(&mut right[0], &energy.fixed[i]);
        let first = match self.position {
            Some(k) => energy.potentials.minimize(k, &self.schur, &right[0]),
            None => self.inverses[1] * right[0],
        };
        let second = self.inverses[0] * (right[1] - self.coupling.tr_mul(&first));
        [first + held[0], second + held[1]]
    }

    /// Whether both stay positive definite with the number of the first one added on its diagonal, one of those of the
    /// frictional vertices: the block of the partner is, and the Schur complement has to be.
    pub(super) fn is_definite(&self, slopes: &[f64], fixed: &[[bool; C]]) -> bool {
        (self.position).is_none_or(|k| is_definite_with(slopes[k], &self.schur, &fixed[k]))
    }
}
