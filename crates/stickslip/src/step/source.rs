//! What a snapshot is taken of.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use super::acceleration::is_used;
use super::{Seen, Simulation};
use crate::contact::ContactSet;
use crate::scene::Loads;

/// An end of the last step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StepEnd {
    Begin,
    Finish,
}

/// What a snapshot is taken of.
pub(crate) trait Source<const C: usize> {
    fn contacts(&self) -> &ContactSet<C>;

    fn loads(&self) -> &Loads<C>;

    /// The mesh of the body by its fingerprint, if that is known.
    fn mesh(&self) -> Option<u64> {
        None
    }

    /// What is seen of a body with frames.
    fn seen(&self) -> Option<&Seen<C>> {
        None
    }

    /// A vector at a vertex from its frame to coordinates.
    fn to_coordinates(&self, vertex: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        match self.seen() {
            Some(seen) => seen.frames().to_coordinates(vertex, vector),
            None => vector,
        }
    }

    /// Whether a component is no unknown.
    fn is_fixed(&self, vertex: usize, component: usize) -> bool;

    /// Whether a component has a prescribed velocity.
    fn is_moved(&self, _vertex: usize, _component: usize) -> bool {
        false
    }

    /// By how much a change of a vertex's velocity changes the force on it [N s/m].
    fn resistance(&self, vertex: usize) -> f64;

    /// `l - M a - C v - A u` at each of `vertices`: what friction and supports have to balance \[N\].
    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]);

    /// The same at one vertex.
    fn unbalanced(&self, vertex: usize) -> SVector<f64, C> {
        let mut force = [SVector::zeros()];
        self.unbalanced_at(&[vertex], &mut force);
        force[0]
    }

    /// Kinetic and elastic energy, `v . M v / 2` and `u . A u / 2` [J; J/m in 2D].
    fn energies(&self) -> [f64; 2];

    /// Adds `C v` to `force`; false without viscosity.
    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool;

    /// The same for one of several viscosities whose sum is `C`, counted from zero; false if there is none.
    fn add_viscous_force_of(
        &self,
        _number: usize,
        _v: &[SVector<f64, C>],
        _force: &mut [SVector<f64, C>],
    ) -> bool {
        false
    }

    /// Whether the last step began with an acceleration that the one before did not end with, or ends with
    /// another than its scheme's.
    fn has_jump(&self, _end: StepEnd) -> bool {
        false
    }

    /// `M` times that difference at a vertex, the later less the earlier \[N\].
    fn jump(&self, _end: StepEnd, _vertex: usize) -> SVector<f64, C> {
        SVector::zeros()
    }

    /// Marks what the scene is made of beside contacts and loads, functions of time at `time` \[s\].
    #[cfg(feature = "serde")]
    fn describe(&self, time: f64, fingerprint: &mut crate::checkpoint::Fingerprint);
}

impl<Op: Operator<C>, const C: usize> Source<C> for Simulation<Op, C> {
    fn contacts(&self) -> &ContactSet<C> {
        &self.contacts
    }

    fn loads(&self) -> &Loads<C> {
        &self.loads
    }

    fn mesh(&self) -> Option<u64> {
        self.scene.mesh
    }

    fn seen(&self) -> Option<&Seen<C>> {
        Some(&self.seen).filter(|seen| !seen.frames().is_empty())
    }

    fn is_fixed(&self, vertex: usize, component: usize) -> bool {
        self.constraints.fixed[vertex][component]
    }

    fn is_moved(&self, vertex: usize, component: usize) -> bool {
        self.constraints.is_moved(vertex, component)
    }

    fn resistance(&self, vertex: usize) -> f64 {
        if self.state.last_step == 0.0 {
            // The velocity is given.
            return f64::INFINITY;
        }
        let rule = self.method.scheme.rule(self.state.last_step);
        let factors = (
            rule.displacement.new_velocity,
            rule.acceleration.new_velocity,
        );
        let block = self.operators.block(&self.scene, factors, vertex);
        block.diagonal().max()
    }

    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let state = &self.state;
        if self.trial.balanced == Some(state.clock) {
            // `r - B v` is the same with fewer products, and differs from friction by what the solver left.
            for (force, &vertex) in forces.iter_mut().zip(vertices) {
                let product = self.operators.step.product_at(vertex, &state.velocity);
                *force = self.trial.load[vertex] - product;
            }
            return;
        }
        let size = state.velocity.len();
        let mut load = vec![SVector::zeros(); size];
        let time = state.clock.time();
        self.loads
            .fill(time, &mut load, &mut self.loads.scratch(size));
        self.contacts.add_tractions(true, &mut load);
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            let mut left =
                load[vertex] - self.scene.stiffness.product_at(vertex, &state.displacement);
            if let Some(mass) = &self.scene.mass {
                left -= mass.product_at(vertex, &state.acceleration);
            }
            for viscosity in &self.scene.viscosity {
                left -= viscosity.product_at(vertex, &state.velocity);
            }
            *force = left;
        }
    }

    fn energies(&self) -> [f64; 2] {
        let (mass, state) = (self.scene.mass.as_ref(), &self.state);
        let kinetic = mass.map_or(0.0, |mass| 0.5 * mass.quadratic(&state.velocity));
        let elastic = 0.5 * self.scene.stiffness.quadratic(&state.displacement);
        [kinetic, elastic]
    }

    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool {
        for viscosity in &self.scene.viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        !self.scene.viscosity.is_empty()
    }

    fn add_viscous_force_of(
        &self,
        number: usize,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool {
        let viscosity = self.scene.viscosities.get(number);
        if let Some(viscosity) = viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        viscosity.is_some()
    }

    fn has_jump(&self, end: StepEnd) -> bool {
        let Some(accelerations) = &self.accelerations else {
            return false;
        };
        let scheme = &self.method.scheme;
        accelerations.anew[end as usize]
            && scheme.facts().stages.len() == 1
            && is_used(&scheme.rule(self.state.last_step))
    }

    fn jump(&self, end: StepEnd, vertex: usize) -> SVector<f64, C> {
        let (Some(accelerations), Some(mass)) = (&self.accelerations, &self.scene.mass) else {
            return SVector::zeros();
        };
        match end {
            StepEnd::Begin => accelerations.renewal_at(mass, vertex),
            // What was settled has left the difference there.
            StepEnd::Finish => -mass.product_at(vertex, &self.trial.acceleration),
        }
    }

    #[cfg(feature = "serde")]
    fn describe(&self, time: f64, fingerprint: &mut crate::checkpoint::Fingerprint) {
        let scene = &self.scene;
        fingerprint.words("the mesh", scene.mesh);
        fingerprint.operator("the stiffness matrix", &scene.stiffness);
        if let Some(mass) = &scene.mass {
            fingerprint.operator("the mass matrix", mass);
        }
        for viscosity in &scene.viscosity {
            fingerprint.operator("the viscosity matrix", viscosity);
        }
        let recurrent = usize::from(scene.initial.recurrent);
        fingerprint.count("the use of recurrent accelerations", recurrent);
        self.constraints.describe(time, fingerprint);
    }
}
