//! The input of a step, and its workspace.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{Basis, MeshId, Ranks};
use stickslip_time::{RateScheme, UpdateFormula};

use super::free_step::FreeStep;
use super::initial_acceleration::InitialAcceleration;
use super::method::{Method, Tolerance};
use super::operators::Operators;
use super::reactions::Reactions;
use super::uniqueness::Certificate;
use crate::body::{Boundary, Matrices};
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::placement::Constraints;
use crate::scene::{Loads, same_mesh};
use crate::sums::{agreed, sum};
use crate::{Clock, StepError, StepState};

/// A scene with its discretisation: the complete input of a step beside its initial state.
#[derive(Clone)]
pub(crate) struct Problem<const C: usize> {
    pub(crate) matrices: Arc<dyn Matrices<C>>,
    /// The body's mesh, if it is known.
    pub(crate) mesh: Option<MeshId>,
    pub(crate) loads: Loads<C>,
    pub(crate) constraints: Constraints<C>,
    pub(crate) basis: Basis<C>,
    pub(crate) method: Method,
    pub(crate) ranks: Ranks,
    /// The reference displacement of the motion: that of an initial equilibrium; empty for zero.
    pub(crate) equilibrium: Vec<SVector<f64, C>>,
    /// The reference velocity of the motion with inertia: the initial one.
    pub(crate) initial_velocity: Vec<SVector<f64, C>>,
    /// A rigid-body mode of the body is unconstrained.
    pub(crate) moves_freely: bool,
    /// Times at which data can jump \[s\], increasing.
    pub(crate) stops: Vec<f64>,
}

/// The complete output of a step. It contains nothing of an accepted step: the caller can discard it.
pub(crate) struct Workspace<const C: usize> {
    /// Laws, and the states, slip rates and normal stresses of the step.
    pub(crate) contacts: ContactSet<C>,
    pub(crate) operators: Operators<C>,
    /// The state at the end of the step; until the velocity is known, with `u^` and `a^`.
    pub(crate) end: StepState<C>,
    /// The start of a stage, if it is not the last accepted step; allocated on first use.
    pub(crate) start: Option<Box<StepState<C>>>,
    /// `r`.
    pub(crate) load: Vec<SVector<f64, C>>,
    /// The change of the velocity by the last velocity problem.
    pub(crate) change: Vec<SVector<f64, C>>,
    pub(crate) scratch: Vec<SVector<f64, C>>,
    /// The velocity that lagged viscosities see [m/s], or the displacement \[m\] that has their force, too; empty without
    /// them.
    pub(crate) mean_velocity: Vec<SVector<f64, C>>,
    /// What is known of the vertices without friction before the velocity problem is solved.
    pub(crate) free: FreeStep<C>,
    pub(crate) solver_iterations: usize,
    /// None if friction weakens nowhere.
    pub(crate) certificate: Option<Box<Certificate<C>>>,
    /// None if no normal stress comes from the body.
    pub(crate) reactions: Option<Box<Reactions<C>>>,
    /// The velocity problem is that of before with other normal stresses.
    pub(crate) again: bool,
    /// A gap has closed in the step, with inertia.
    pub(crate) impact: bool,
    /// None without inertia, and for a mass that is not positive definite.
    pub(crate) acceleration: Option<Box<InitialAcceleration<C>>>,
    /// The accepted step of load and operator.
    pub(crate) balanced: Option<Clock>,
    /// Steps are compared, and differ in size from one to the next.
    pub(crate) compared: bool,
}

impl<const C: usize> Clone for Workspace<C> {
    fn clone(&self) -> Self {
        Self {
            contacts: self.contacts.clone(),
            operators: self.operators.clone(),
            end: self.end.clone(),
            start: self.start.clone(),
            load: self.load.clone(),
            change: self.change.clone(),
            scratch: self.scratch.clone(),
            mean_velocity: self.mean_velocity.clone(),
            free: self.free.clone(),
            solver_iterations: self.solver_iterations,
            certificate: self.certificate.clone(),
            reactions: self.reactions.clone(),
            again: false,
            impact: false,
            acceleration: self.acceleration.clone(),
            balanced: self.balanced,
            compared: self.compared,
        }
    }
}

impl<const C: usize> Workspace<C> {
    /// Assembles `B = c_a M + C + c_u A` of a stage of `dt`, and prepares the solver, if they have changed.
    pub(super) fn assemble(
        &mut self,
        p: &Problem<C>,
        scheme: &dyn RateScheme,
        dt: f64,
    ) -> Result<UpdateFormula, StepError> {
        let formula = scheme.update_formula(dt);
        let factors = (
            formula.displacement.new_velocity,
            formula.acceleration.new_velocity,
        );
        if self.operators.prepared == Some(factors) {
            return Ok(formula);
        }
        self.operators.prepared = None;
        same_mesh(p.mesh, self.operators.body.mesh())?;
        let fixed = &p.constraints.fixed;
        (self.operators).check_stability(&*p.matrices, fixed, dt)?;
        let inertia = p.matrices.has_mass();
        (self.operators).form(inertia, factors, &self.contacts.vertices);
        let prepared = self.operators.body.prepare(&Boundary {
            load: &self.load,
            potentials: &self.contacts,
            vertices: &self.contacts.vertices,
            fixed,
        });
        agreed(&p.ranks, prepared.map_err(Into::into))?;
        self.operators.prepared = Some(factors);
        Ok(formula)
    }

    /// The rounding of the velocity, in the norm of the operators.
    pub(super) fn rounding(&self, ranks: &Ranks) -> f64 {
        // A size is asked for: where the last step left the body is near enough.
        let (norm, velocity) = (self.operators.norm(), &self.end.velocity);
        // What moves a stiff body as a whole has a small norm, and the rounding errors of its vertices a large one.
        let squares = velocity.iter().enumerate().map(|(i, v)| {
            let diagonal = norm.diagonal_block(i).diagonal();
            diagonal.dot(&v.component_mul(v))
        });
        let vertices = 0.1 * ranks.sum(sum(squares)).sqrt();
        NUMERICS.rounding * norm.norm(velocity).max(vertices)
    }

    /// The allowed error of a velocity, in the norm of the operators.
    pub(super) fn tolerance(&self, method: &Method) -> f64 {
        let relative = match method.tolerance {
            Tolerance::Absolute(tolerance) => return tolerance,
            Tolerance::Relative(relative) => relative,
        };
        let mut scale = self.operators.scale(self.contacts.strengths());
        if scale == 0.0 {
            // Nothing but the motion to compare with.
            scale = self.operators.norm().norm(&self.end.velocity);
        }
        let mut least = f64::MIN_POSITIVE;
        if self.contacts.can_open() {
            // Where a contact opens its strength vanishes, and the rounding of the motion does not.
            least = least.max(self.rounding(&self.operators.step().ranks()));
        }
        (relative * scale).max(least)
    }
}
