//! The fields of a cycle on a level.

use nalgebra::SVector;

use super::level::Level;

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
