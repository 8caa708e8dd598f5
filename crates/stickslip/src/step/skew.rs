//! The forces of a stiffness matrix that is not symmetric, in a step.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use crate::SceneError;
use crate::scene::Scene;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// The stiffness matrix of the elastic energy: the symmetric part.
    pub(crate) fn energy_stiffness(&self) -> &Op {
        self.symmetric_part.as_ref().unwrap_or(&self.stiffness)
    }

    /// Splits a stiffness matrix that is not symmetric; refuses it with inertia, which no energy bounds then, in an initial
    /// equilibrium, and in a format without transposes.
    pub(crate) fn find_energy(&mut self) -> Result<(), SceneError> {
        let Some(asymmetric) = &self.asymmetric else {
            return Ok(());
        };
        if self.mass.is_none() && self.initial.equilibrium.is_none() {
            self.symmetric_part = self.stiffness.symmetric_part();
        }
        match self.symmetric_part {
            Some(_) => Ok(()),
            None => Err(asymmetric.clone()),
        }
    }
}

/// The forces `c_u (A - S) v` of a velocity, beside the symmetric part `S` in the operator of the step.
#[derive(Clone)]
pub(super) struct Skew<const C: usize> {
    /// The load without them \[N\].
    load: Vec<SVector<f64, C>>,
    forces: Vec<SVector<f64, C>>,
}

impl<const C: usize> Skew<C> {
    /// Memory for a scene whose stiffness is not symmetric; none for others.
    pub(super) fn new<Op: Operator<C>>(scene: &Scene<Op, C>) -> Option<Self> {
        let part = scene.symmetric_part.as_ref()?;
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
    pub(super) fn find<Op: Operator<C>>(
        &mut self,
        scene: &Scene<Op, C>,
        (c_u, velocity): (f64, &[SVector<f64, C>]),
        forces: &mut [f64],
    ) {
        self.forces.fill(SVector::zeros());
        (scene.stiffness).multiply_add(c_u, velocity, &mut self.forces);
        if let Some(part) = &scene.symmetric_part {
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
