//! The local problems of a stage: slip rates and velocities in balance with forces.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Matrix, Potentials};

use super::damping::{Smooth, of_vertices};
use super::motion::Motion;
use super::scalar::ScalarContact;
use crate::SceneError;
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::Constraints;

/// What resists at each vertex, and how its balance is found: by laws for many vertices at once, where it is scalar, or
/// vertex by vertex.
pub(super) struct LocalProblems<const C: usize> {
    /// `C` at each frictional vertex, with Dirichlet components removed.
    pub(super) damping: Vec<SMatrix<f64, C, C>>,
    /// The vertices without friction, and the inverse of `C` on their free components.
    pub(super) smooth: Vec<Smooth<C>>,
    /// The contacts with scalar local problems.
    pub(super) scalar: Vec<Option<ScalarContact<C>>>,
    /// The numbers of the other frictional vertices.
    pub(super) coupled: Vec<usize>,
}

impl<const C: usize> LocalProblems<C> {
    pub(super) fn new(
        matrices: &dyn Matrices<C>,
        constraints: &Constraints<C>,
        contacts: &ContactSet<C>,
    ) -> Result<Self, SceneError> {
        let (damping, smooth) = of_vertices(matrices, constraints, contacts)?;
        let scalar = |contact| ScalarContact::new(contact, contacts, &damping);
        let scalar: Vec<_> = contacts.contacts.iter().map(scalar).collect();
        let mut is_scalar = vec![false; contacts.vertices.len()];
        for &number in scalar.iter().flatten().flat_map(|own| &own.numbers) {
            is_scalar[number] = true;
        }
        Ok(Self {
            damping,
            smooth,
            scalar,
            coupled: (0..is_scalar.len()).filter(|&k| !is_scalar[k]).collect(),
        })
    }

    /// The number of vertices with scalar problems.
    pub(super) fn scalar_count(&self) -> usize {
        self.damping.len() - self.coupled.len()
    }

    /// The velocities in balance with forces, and the rates of the states of scalar contacts. Where components are prescribed
    /// they are so already, and the others zero. Whether all numbers of scalar contacts are finite.
    pub(super) fn balance(
        &mut self,
        contacts: &ContactSet<C>,
        constraints: &Constraints<C>,
        (forces, viscosity): (&[SVector<f64, C>], Option<&dyn Matrix<C>>),
        slope: &mut Motion<C>,
    ) -> bool {
        let velocity = slope.displacement.as_mut_slice();
        let (mut states, mut all) = (slope.states.as_mut_slice(), true);
        for (contact, scalar) in contacts.contacts.iter().zip(&mut self.scalar) {
            let (own, others) = states.split_at_mut(contact.state_count());
            states = others;
            if let Some(scalar) = scalar {
                all &= scalar.balance(contact, forces, velocity, own);
            }
        }
        let prescribed = !constraints.held.is_empty();
        // What is left to the free components of a vertex, its velocity being that of the prescribed ones.
        let left = |vertex: usize, held: &SVector<f64, C>| {
            let mut force = forces[vertex];
            if prescribed {
                if let Some(viscosity) = viscosity {
                    force -= viscosity.diagonal_block(vertex) * held;
                }
                for c in (0..C).filter(|&c| constraints.fixed[vertex][c]) {
                    force[c] = 0.0;
                }
            }
            force
        };
        for &k in &self.coupled {
            let vertex = contacts.vertices[k];
            let own = &mut velocity[vertex];
            let free = contacts.minimize(k, &self.damping[k], &left(vertex, own));
            *own = if prescribed { *own + free } else { free };
        }
        for (vertex, inverse) in &self.smooth {
            let own = &mut velocity[*vertex];
            let free = inverse * left(*vertex, own);
            *own = if prescribed { *own + free } else { free };
        }
        all
    }
}
