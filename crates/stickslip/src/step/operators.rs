//! The operators of a step, assembled again when its size changes.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Basis, Matrix};

use super::highest_frequency::step_limit;
use super::uniqueness::Definite;
use crate::StepError;
use crate::body::{Body, Matrices};
use crate::sums::sum;

/// `B = c_a M + C + c_u A` for a step size, and the norm of the coupling.
pub(crate) struct Operators<const C: usize> {
    /// `B`; the matrix of the norm, if it is another one: `A + M` for an absolute tolerance, the mass alone in explicit
    /// schemes; and the solver.
    pub(crate) body: Box<dyn Body<C>>,
    /// The inverse diagonal stiffness of each frictional vertex in `B` [m/(N s)].
    compliance: Vec<f64>,
    /// The factors `c_u` \[s\] and `c_a` [1/s] of `B` and of the prepared solver.
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

/// The solver of the clone is not prepared.
impl<const C: usize> Clone for Operators<C> {
    fn clone(&self) -> Self {
        Self {
            body: self.body.boxed_clone(),
            compliance: self.compliance.clone(),
            prepared: None,
            ..*self
        }
    }
}

impl<const C: usize> Operators<C> {
    /// The operators of a body that is allocated for an implicit or explicit scheme, with or without a step limit.
    pub(crate) fn new(body: Box<dyn Body<C>>, implicit: bool, bound: Option<f64>) -> Self {
        Self {
            body,
            compliance: Vec::new(),
            prepared: None,
            equivalence: f64::INFINITY,
            factors: (1.0, 1.0),
            implicit,
            unsupported: false,
            bound,
            limit: None,
        }
    }

    /// Allocates them for another scheme.
    pub(crate) fn renew(&mut self, implicit: bool, bound: Option<f64>) {
        self.body.allocate(implicit);
        self.compliance.clear();
        (self.prepared, self.equivalence, self.factors) = (None, f64::INFINITY, (1.0, 1.0));
        (self.implicit, self.bound, self.limit) = (implicit, bound, None);
        self.unsupported = false;
    }

    /// `B`.
    #[inline]
    pub(crate) fn step(&self) -> &dyn Matrix<C> {
        self.body.step()
    }

    /// The norm `sqrt(d . N d)` of changes of the velocity.
    pub(crate) fn norm(&self) -> &dyn Matrix<C> {
        self.body.norm()
    }

    /// The velocity of a vertex that has this norm by itself [m/s]; 0 where the norm does not depend on it.
    pub(crate) fn velocity_of(&self, norm: f64, vertex: usize) -> f64 {
        let block = self.norm().diagonal_block(vertex);
        let velocity = norm / block.diagonal().max().sqrt();
        if velocity.is_finite() { velocity } else { 0.0 }
    }

    /// Measures changes of the velocity by `A + M`, as the paper does.
    pub(crate) fn measure_absolutely(&mut self) {
        if !self.unsupported {
            self.body.measure_absolutely(self.implicit);
            self.prepared = None;
        }
    }

    /// The velocity of the frictional vertices under forces alone, in the norm: the mean square of `F_k / sqrt(B_kk)`.
    pub(crate) fn scale(&self, forces: impl Iterator<Item = f64>) -> f64 {
        let squares = forces
            .zip(&self.compliance)
            .map(|(force, compliance)| force * force * compliance);
        let ranks = self.step().ranks();
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
    pub(crate) fn measure_sliding(
        &mut self,
        matrices: &dyn Matrices<C>,
        fixed: &[[bool; C]],
        frictional: &[usize],
        basis: &Basis<C>,
    ) {
        let stiffness = matrices.energy_stiffness();
        if matrices.has_mass() || frictional.is_empty() || stiffness.ranks().are_several() {
            return;
        }
        let (directions, count) = basis.free_translations(fixed);
        let mut shift = vec![SVector::zeros(); fixed.len()];
        for direction in &directions[..count] {
            if !basis.moves_freely(stiffness, direction, &mut shift) {
                continue;
            }
            self.unsupported = true;
            let block = |&i: &usize| {
                let own = shift[i].dot(&(stiffness.diagonal_block(i) * shift[i]));
                (i, shift[i] * shift[i].transpose() * own)
            };
            self.body.add_to_norm(&mut frictional.iter().map(block));
        }
    }

    /// The diagonal block of a vertex in `B` for `c_u` and `c_a`, whichever is assembled.
    pub(crate) fn block(
        &self,
        matrices: &dyn Matrices<C>,
        (c_u, c_a): (f64, f64),
        vertex: usize,
    ) -> SMatrix<f64, C, C> {
        let mut block = SMatrix::zeros();
        if self.implicit {
            block += matrices.stiffness().diagonal_block(vertex) * c_u;
        }
        if let Some(mass) = matrices.mass() {
            block += mass.diagonal_block(vertex) * c_a;
        }
        if let Some(viscosity) = matrices.prompt_viscosity(self.implicit) {
            block += viscosity.diagonal_block(vertex);
        }
        block
    }

    /// Assembles `B`; the caller prepares the solver for it.
    pub(crate) fn form(&mut self, inertia: bool, (c_u, c_a): (f64, f64), frictional: &[usize]) {
        self.body.combine(self.implicit, (c_u, c_a));
        let factor = match (inertia, self.implicit) {
            (true, false) => c_a,
            (true, true) => c_u.min(c_a),
            (false, _) => c_u,
        };
        self.equivalence = match self.body.has_norm() {
            _ if self.unsupported => f64::INFINITY,
            false => 1.0,
            true => factor.recip(),
        };
        self.factors = (c_u, c_a);
        self.compliance.clear();
        let step = self.body.step();
        let resistances = frictional
            .iter()
            .map(|&vertex| step.diagonal_block(vertex).diagonal().max());
        self.compliance.extend(resistances.map(f64::recip));
    }

    /// Whether `B` is positive definite with slopes of friction added at some vertices. The sum is assembled in place
    /// of `B`, which is then restored bit for bit: no scene needs memory for it.
    pub(crate) fn is_definite_with(
        &mut self,
        definite: &mut Definite<C>,
        (vertices, slopes): (&[usize], &[f64]),
        fixed: &[[bool; C]],
    ) -> bool {
        self.body.add_to_diagonal(vertices, slopes);
        let is_definite = definite.is_positive_definite(self.body.step(), fixed);
        self.body.combine(self.implicit, self.factors);
        is_definite
    }

    /// Refuses a step beyond the stability limit of the scheme; the limit is computed once.
    pub(crate) fn check_stability(
        &mut self,
        matrices: &dyn Matrices<C>,
        fixed: &[[bool; C]],
        dt: f64,
    ) -> Result<(), StepError> {
        let (Some(bound), Some(mass)) = (self.bound, matrices.mass()) else {
            return Ok(());
        };
        let limit = match self.limit {
            Some(limit) => limit,
            None => {
                let limit = step_limit(matrices, mass, fixed, bound)?;
                *self.limit.insert(limit)
            }
        };
        if dt > limit {
            return Err(StepError::Unstable { dt, limit });
        }
        Ok(())
    }
}
