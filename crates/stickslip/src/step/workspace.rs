//! What a step is taken of, and the memory it is taken in.

use nalgebra::SVector;
use stickslip_solvers::{Energy, Frames, NonsmoothSolver, Operator, Ranks};
use stickslip_time::{RateScheme, UpdateFormula};

use super::initial_acceleration::InitialAcceleration;
use super::method::{Method, Tolerance};
use super::operators::Operators;
use super::uniqueness::Certificate;
use crate::contact::ContactSet;
use crate::scene::{Constraints, Loads, Scene, same_mesh};
use crate::{Clock, StepError, StepState};

/// A scene with its discretisation: all that a step reads beside the state it starts from.
pub(crate) struct Problem<Op: Operator<C>, const C: usize> {
    pub(crate) scene: Scene<Op, C>,
    pub(crate) loads: Loads<C>,
    pub(crate) constraints: Constraints<C>,
    pub(crate) frames: Frames<C>,
    pub(crate) method: Method,
    pub(crate) ranks: Ranks,
    /// The displacement from which the motion is measured: that of an initial equilibrium; empty for zero.
    pub(crate) equilibrium: Vec<SVector<f64, C>>,
    /// Nothing holds the body in some direction, which deforms nothing.
    pub(crate) moves_freely: bool,
    /// Times at which data may jump \[s\], increasing.
    pub(crate) stops: Vec<f64>,
}

/// All that a step writes. Nothing of it is an accepted step's: whoever takes a step may drop it.
pub(crate) struct Workspace<Op: Operator<C>, const C: usize> {
    /// Laws, and the states, slip rates and normal stresses of the step.
    pub(crate) contacts: ContactSet<C>,
    pub(crate) solver: Box<dyn NonsmoothSolver<Op, C>>,
    pub(crate) operators: Operators<Op>,
    /// The state at the end of the step; until the velocity is known, with `u^` and `a^`.
    pub(crate) end: StepState<C>,
    /// Where a stage starts, if not at the last accepted step; takes memory the first time.
    pub(crate) start: Option<Box<StepState<C>>>,
    /// `r`.
    pub(crate) load: Vec<SVector<f64, C>>,
    /// By how much the last velocity problem moved the velocity.
    pub(crate) change: Vec<SVector<f64, C>>,
    pub(crate) scratch: Vec<SVector<f64, C>>,
    pub(crate) solver_iterations: usize,
    /// None where friction weakens nowhere.
    pub(crate) certificate: Option<Box<Certificate<C>>>,
    /// None without inertia, and for a mass that is not definite.
    pub(crate) acceleration: Option<Box<InitialAcceleration<C>>>,
    /// The step that load and operator still belong to.
    pub(crate) balanced: Option<Clock>,
    /// Steps are compared, and change their size from one to the next.
    pub(crate) compared: bool,
}

impl<Op, const C: usize> Clone for Problem<Op, C>
where
    Op: Operator<C, Mass: Clone> + Clone,
{
    fn clone(&self) -> Self {
        Self {
            scene: self.scene.clone(),
            loads: self.loads.clone(),
            constraints: self.constraints.clone(),
            frames: self.frames.clone(),
            method: self.method.clone(),
            ranks: self.ranks.clone(),
            equilibrium: self.equilibrium.clone(),
            moves_freely: self.moves_freely,
            stops: self.stops.clone(),
        }
    }
}

impl<Op: Operator<C> + Clone, const C: usize> Clone for Workspace<Op, C> {
    fn clone(&self) -> Self {
        let mut operators = self.operators.clone();
        // The solver is not.
        operators.prepared = None;
        Self {
            contacts: self.contacts.clone(),
            solver: self.solver.boxed_clone(),
            operators,
            end: self.end.clone(),
            start: self.start.clone(),
            load: self.load.clone(),
            change: self.change.clone(),
            scratch: self.scratch.clone(),
            solver_iterations: self.solver_iterations,
            certificate: self.certificate.clone(),
            acceleration: self.acceleration.clone(),
            balanced: self.balanced,
            compared: self.compared,
        }
    }
}

impl<Op: Operator<C>, const C: usize> Workspace<Op, C> {
    /// `B = c_a M + C + c_u A` of a stage of `dt`, and whatever the solver makes of it, if they changed.
    pub(super) fn assemble(
        &mut self,
        p: &Problem<Op, C>,
        scheme: &dyn RateScheme,
        dt: f64,
    ) -> Result<UpdateFormula, StepError> {
        let rule = scheme.update_formula(dt);
        let factors = (
            rule.displacement.new_velocity,
            rule.acceleration.new_velocity,
        );
        if self.operators.prepared == Some(factors) {
            return Ok(rule);
        }
        self.operators.prepared = None;
        same_mesh(p.scene.mesh, self.solver.mesh())?;
        let fixed = &p.constraints.fixed;
        (self.operators).check_stability(&p.scene, fixed, dt)?;
        (self.operators).form(&p.scene, factors, &self.contacts.vertices);
        self.solver.prepare(&Energy {
            operator: &self.operators.step,
            load: &self.load,
            potentials: &self.contacts,
            vertices: &self.contacts.vertices,
            fixed,
        })?;
        self.operators.prepared = Some(factors);
        Ok(rule)
    }

    /// How far a velocity may be off, in the norm of the operators.
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
        (relative * scale).max(f64::MIN_POSITIVE)
    }
}
