//! The forces of a stiffness matrix that is not symmetric, in a step.

use nalgebra::SVector;

use crate::body::Matrices;

/// The forces `c_u (A - S) v` of a velocity, beside the symmetric part `S` in the operator of the step.
#[derive(Clone)]
pub(super) struct Skew<const C: usize> {
    /// The load without them \[N\].
    load: Vec<SVector<f64, C>>,
    forces: Vec<SVector<f64, C>>,
}

impl<const C: usize> Skew<C> {
    /// Memory for a scene whose stiffness is not symmetric; none for others.
    pub(super) fn new(matrices: &dyn Matrices<C>) -> Option<Self> {
        let part = matrices.symmetric_part()?;
        let zeros = || vec![SVector::zeros(); part.vertex_count()];
        Some(Self {
            load: zeros(),
            forces: zeros(),
        })
    }

    /// The number of forces.
    pub(super) fn count(&self) -> usize {
        C * self.forces.len()
    }

    /// Stores the load of a step.
    pub(super) fn begin(&mut self, load: &[SVector<f64, C>]) {
        self.load.copy_from_slice(load);
    }

    /// Writes the forces of a velocity.
    pub(super) fn find(
        &mut self,
        matrices: &dyn Matrices<C>,
        (c_u, velocity): (f64, &[SVector<f64, C>]),
        forces: &mut [f64],
    ) {
        self.forces.fill(SVector::zeros());
        (matrices.stiffness()).multiply_add(c_u, velocity, &mut self.forces);
        if let Some(part) = matrices.symmetric_part() {
            part.multiply_add(-c_u, velocity, &mut self.forces);
        }
        for (forces, own) in forces.chunks_exact_mut(C).zip(&self.forces) {
            forces.copy_from_slice(own.as_slice());
        }
    }

    /// Puts forces into the load.
    pub(super) fn apply(&self, forces: &[f64], load: &mut [SVector<f64, C>]) {
        let without = self.load.iter().zip(forces.chunks_exact(C));
        for (load, (without, forces)) in load.iter_mut().zip(without) {
            *load = SVector::from_fn(|c, _| without[c] - forces[c]);
        }
    }
}
