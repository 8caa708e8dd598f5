//! The level of rounding errors in the forces of a body.

use nalgebra::{SMatrix, SVector};

use super::Sweep;
use crate::block_matrix::Rows;
use crate::field::clear_masked;
use crate::frictional_vertices::FrictionalVertices;
use crate::{BlockMatrix, Energy};

/// The number of roundings of its terms in a force.
pub(crate) const ROUNDINGS: f64 = 16.0;

impl<const C: usize> Sweep<C> {
    /// Whether the forces that drive another sweep are at the level of the rounding errors of their terms.
    pub(crate) fn is_rounded(
        &self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &[SVector<f64, C>],
    ) -> bool {
        let rows = Rows::of(energy.operator);
        let mut frictional = FrictionalVertices::along(energy.vertices);
        (0..v.len()).all(|i| {
            let (mut left, terms) = force_and_terms(energy, &rows, i, v);
            clear_masked(&mut left, &energy.fixed[i]);
            let force = match frictional.at(i) {
                Some(k) => self.local_force(energy, k, v),
                None => left.amax(),
            };
            force <= ROUNDINGS * f64::EPSILON * terms.amax()
        })
    }
}

/// The force of load and operator at vertex `i`, and the sum of the moduli of its terms.
pub(crate) fn force_and_terms<const C: usize>(
    energy: &Energy<'_, BlockMatrix<C>, C>,
    rows: &Rows<'_, SMatrix<f64, C, C>>,
    i: usize,
    v: &[SVector<f64, C>],
) -> (SVector<f64, C>, SVector<f64, C>) {
    let (mut force, mut terms) = (energy.load[i], energy.load[i].abs());
    for (j, block) in rows.row(i) {
        force -= block * v[j];
        terms += block.abs() * v[j].abs();
    }
    (force, terms)
}
