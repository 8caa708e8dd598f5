//! The operators of a step, assembled again when its size changes.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Basis, Operator};

use super::highest_frequency::step_limit;
use super::uniqueness::Definite;
use crate::scene::Scene;
use crate::sums::sum;
use crate::{SceneError, StepError};

/// `B = c_a M + C + c_u A` for a step size, and the norm of the coupling.
#[derive(Clone)]
pub(crate) struct Operators<Op> {
    pub(crate) step: Op,
    /// The matrix of the norm for velocity changes, if it is not `step`: `A + M` for an absolute tolerance, the mass
    /// alone in explicit schemes.
    norm: Option<Op>,
    /// The inverse diagonal stiffness of each frictional vertex in `step` [m/(N s)].
    compliance: Vec<f64>,
    /// The factors `c_u` \[s\] and `c_a` [1/s] of `step` and of the prepared solver.
    pub(crate) prepared: Option<(f64, f64)>,
    /// `d . N d <= equivalence d . B d`.
    pub(crate) equivalence: f64,
    /// The factors `c_u` \[s\] and `c_a` [1/s] of the last assembled operator.
    factors: (f64, f64),
    /// The stiffness is part of `B`.
    pub(crate) implicit: bool,
    /// `N` measures motions without resistance in `B`.
    unsupported: bool,
    /// The largest `omega dt` of the scheme, and the largest stable step once it has been computed \[s\].
    bound: Option<f64>,
    pub(crate) limit: Option<f64>,
}

impl<Op> Operators<Op> {
    /// Allocates the operators of an implicit or explicit scheme, with or without a step limit.
    pub(crate) fn new<const C: usize>(
        scene: &Scene<Op, C>,
        implicit: bool,
        bound: Option<f64>,
    ) -> Result<Self, SceneError>
    where
        Op: Operator<C>,
    {
        let mut terms = Vec::new();
        if implicit {
            terms.push((1.0, scene.energy_stiffness()));
        }
        let mass = scene.mass.as_ref().map(|mass| (1.0, mass));
        if terms.is_empty() && mass.is_none() {
            return Err(SceneError::unsupported(SceneError::EXPLICIT, "a mass"));
        }
        let viscosity = scene.prompt_viscosity(implicit);
        terms.extend(viscosity.map(|viscosity| (1.0, viscosity)));
        Ok(Self {
            step: Op::combination_with(&terms, mass),
            norm: None,
            compliance: Vec::new(),
            prepared: None,
            equivalence: f64::INFINITY,
            factors: (1.0, 1.0),
            implicit,
            unsupported: false,
            bound,
            limit: None,
        })
    }

    /// The norm `sqrt(d . N d)` of changes of the velocity.
    pub(crate) fn norm(&self) -> &Op {
        self.norm.as_ref().unwrap_or(&self.step)
    }

    /// The velocity of a vertex that has this norm by itself [m/s]; 0 where the norm does not depend on it.
    pub(crate) fn velocity_of<const C: usize>(&self, norm: f64, vertex: usize) -> f64
    where
        Op: Operator<C>,
    {
        let block = self.norm().diagonal_block(vertex);
        let velocity = norm / block.diagonal().max().sqrt();
        if velocity.is_finite() { velocity } else { 0.0 }
    }

    /// Measures changes of the velocity by `A + M`, as the paper does.
    pub(crate) fn measure_absolutely<const C: usize>(&mut self, scene: &Scene<Op, C>)
    where
        Op: Operator<C>,
    {
        if self.unsupported {
            return;
        }
        let stiffness = self.implicit.then_some((1.0, scene.energy_stiffness()));
        let mass = scene.mass.as_ref().map(|mass| (1.0, mass));
        let terms: Vec<_> = stiffness.into_iter().collect();
        self.norm = Some(Op::combination_with(&terms, mass));
        self.prepared = None;
    }

    /// The velocity of the frictional vertices under forces alone, in the norm: the mean square of `F_k / sqrt(B_kk)`.
    pub(crate) fn scale<const C: usize>(&self, forces: impl Iterator<Item = f64>) -> f64
    where
        Op: Operator<C>,
    {
        let squares = forces
            .zip(&self.compliance)
            .map(|(force, compliance)| force * force * compliance);
        let ranks = self.step.ranks();
        let count = ranks.sum(self.compliance.len() as f64);
        let mean = ranks.sum(sum(squares)) / count.max(1.0);
        let scale = mean.sqrt();
        if self.unsupported {
            scale / self.factors.0.sqrt()
        } else {
            scale
        }
    }

    /// Adds a norm for rigid-body modes that are constrained by friction alone, without inertia and Dirichlet
    /// conditions: by the stiffness of each frictional vertex by itself.
    pub(crate) fn measure_sliding<const C: usize>(
        &mut self,
        scene: &Scene<Op, C>,
        fixed: &[[bool; C]],
        frictional: &[usize],
        basis: &Basis<C>,
    ) where
        Op: Operator<C>,
    {
        let stiffness = scene.energy_stiffness();
        if scene.mass.is_some() || frictional.is_empty() || stiffness.ranks().are_several() {
            return;
        }
        let (directions, count) = basis.free_translations(fixed);
        let mut shift = vec![SVector::zeros(); fixed.len()];
        for direction in &directions[..count] {
            if !basis.moves_freely(stiffness, direction, &mut shift) {
                continue;
            }
            self.unsupported = true;
            let norm = self
                .norm
                .get_or_insert_with(|| Op::combination(&[(1.0, stiffness)]));
            for &i in frictional {
                let own = shift[i].dot(&(stiffness.diagonal_block(i) * shift[i]));
                norm.add_to_diagonal(i, &(shift[i] * shift[i].transpose() * own));
            }
        }
    }

    /// Combines `c_a M + C + c_u A` to the operator of the step; without the stiffness and the lagged viscosities in an
    /// explicit scheme.
    fn combine<const C: usize>(&mut self, scene: &Scene<Op, C>, (c_u, c_a): (f64, f64))
    where
        Op: Operator<C>,
    {
        let stiffness = (c_u, scene.energy_stiffness());
        let mass = scene.mass.as_ref().map(|mass| (c_a, mass));
        let viscosity = scene.prompt_viscosity(self.implicit);
        let viscosity = viscosity.map(|viscosity| (1.0, viscosity));
        match (self.implicit, viscosity) {
            (true, None) => self.step.set_combination_with(&[stiffness], mass),
            (true, Some(viscosity)) => {
                self.step
                    .set_combination_with(&[stiffness, viscosity], mass);
            }
            (false, viscosity) => self.step.set_combination_with(viscosity.as_slice(), mass),
        }
    }

    /// The diagonal block of a vertex in that operator, whichever is assembled.
    pub(crate) fn block<const C: usize>(
        &self,
        scene: &Scene<Op, C>,
        (c_u, c_a): (f64, f64),
        vertex: usize,
    ) -> SMatrix<f64, C, C>
    where
        Op: Operator<C>,
    {
        let mut block = SMatrix::zeros();
        if self.implicit {
            block += scene.stiffness.diagonal_block(vertex) * c_u;
        }
        if let Some(mass) = &scene.mass {
            block += mass.diagonal_block(vertex) * c_a;
        }
        if let Some(viscosity) = scene.prompt_viscosity(self.implicit) {
            block += viscosity.diagonal_block(vertex);
        }
        block
    }

    /// Assembles `B`; the caller prepares `solver` for it.
    pub(crate) fn form<const C: usize>(
        &mut self,
        scene: &Scene<Op, C>,
        (c_u, c_a): (f64, f64),
        frictional: &[usize],
    ) where
        Op: Operator<C>,
    {
        self.combine(scene, (c_u, c_a));
        let factor = match (&scene.mass, self.implicit) {
            (Some(_), false) => c_a,
            (Some(_), true) => c_u.min(c_a),
            (None, _) => c_u,
        };
        self.equivalence = match &self.norm {
            _ if self.unsupported => f64::INFINITY,
            None => 1.0,
            Some(_) => factor.recip(),
        };
        self.factors = (c_u, c_a);
        self.compliance.clear();
        let resistances = frictional
            .iter()
            .map(|&vertex| self.step.diagonal_block(vertex).diagonal().max());
        self.compliance.extend(resistances.map(f64::recip));
    }

    /// Whether `B` is positive definite with slopes of friction added at some vertices. The sum is assembled in place
    /// of `B`, which is then restored bit for bit: no scene needs memory for it.
    pub(crate) fn is_definite_with<const C: usize>(
        &mut self,
        definite: &mut Definite<C>,
        scene: &Scene<Op, C>,
        slopes: (&[usize], &[f64]),
        fixed: &[[bool; C]],
    ) -> bool
    where
        Op: Operator<C>,
    {
        let is_definite = definite.is_positive_definite(&mut self.step, slopes, fixed);
        self.combine(scene, self.factors);
        is_definite
    }

    /// Refuses a step beyond the stability limit of the scheme; the limit is computed once.
    pub(crate) fn check_stability<const C: usize>(
        &mut self,
        scene: &Scene<Op, C>,
        fixed: &[[bool; C]],
        dt: f64,
    ) -> Result<(), StepError>
    where
        Op: Operator<C>,
    {
        let (Some(bound), Some(mass)) = (self.bound, &scene.mass) else {
            return Ok(());
        };
        let limit = match self.limit {
            Some(limit) => limit,
            None => {
                let limit = step_limit(scene, mass, fixed, bound)?;
                *self.limit.insert(limit)
            }
        };
        if dt > limit {
            return Err(StepError::Unstable { dt, limit });
        }
        Ok(())
    }
}
