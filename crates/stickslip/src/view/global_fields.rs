//! The motion in coordinates, for steps in another basis.

use nalgebra::SVector;
use stickslip_solvers::Basis;

use crate::StepState;

/// The basis of a body's vertices, and an accepted step in coordinates. Without local axes and links it is empty: the
/// step itself is in coordinates.
#[derive(Debug, Clone)]
pub(crate) struct GlobalFields<const C: usize> {
    basis: Basis<C>,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
}

impl<const C: usize> GlobalFields<C> {
    pub(crate) fn new(basis: Basis<C>) -> Self {
        Self {
            basis,
            displacement: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
        }
    }

    pub(crate) fn basis(&self) -> &Basis<C> {
        &self.basis
    }

    /// Changes an accepted step to coordinates; allocates on first use.
    pub(crate) fn show(&mut self, state: &StepState<C>) {
        if self.basis.is_empty() {
            return;
        }
        for (seen, own) in [
            (&mut self.displacement, &state.displacement),
            (&mut self.velocity, &state.velocity),
            (&mut self.acceleration, &state.acceleration),
        ] {
            seen.clone_from(own);
            if !seen.is_empty() {
                self.basis.field_to_coordinates(seen);
            }
        }
    }
}
