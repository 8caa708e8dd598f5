//! Construction of a simulation whose matrices, scheme and solver are not known by their types.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{Basis, Matrix, MeshId};
use stickslip_time::{RateScheme, SchemeProperties};

use crate::body::{AnySolver, Matrices};
use crate::numerics::NUMERICS;
use crate::placement::{self, Placement};
use crate::scene::Conditions;
use crate::step::{
    Certificate, FreeStep, InitialAcceleration, Method, Operators, Problem, Reactions, Tolerance,
    Traits, Workspace,
};
use crate::{MeshMismatch, SceneError, Simulation};

/// Refuses an explicit scheme without a mass, and one of several stages with local steps.
pub(super) fn check_scheme<const C: usize>(
    matrices: &dyn Matrices<C>,
    properties: &SchemeProperties,
) -> Result<(), SceneError> {
    if properties.implicit {
        return Ok(());
    }
    if !matrices.has_mass() {
        return Err(SceneError::unsupported(SceneError::EXPLICIT, "a mass"));
    }
    if matrices.stiffness().levels() > 1 && properties.stages.len() > 1 {
        let stages = "a stiffness without local steps, or a scheme of one stage";
        return Err(SceneError::unsupported(SceneError::EXPLICIT, stages));
    }
    Ok(())
}

compiled! {
    /// A simulation whose matrices, scheme and solver are not known by their types.
    pub(super) fn build<C>(
        scene: Conditions<C>,
        matrices: Box<dyn Matrices<C>>,
        scheme: Arc<dyn RateScheme>,
        solver: (AnySolver, Option<MeshId>),
    ) -> Result<Simulation<C>, SceneError> {
        let (mut scene, mut matrices, (solver, mesh)) = (scene, matrices, solver);
        scheme.validate()?;
        matrices.find_energy(scene.asymmetric.as_ref())?;
        placement::check(&mut *matrices, &mut scene)?;
        MeshMismatch::check("solver", scene.mesh, mesh)?;
        let in_equilibrium = matrices.starts_in_equilibrium();
        let given = !scene.initial.acceleration.is_empty();
        let mesh = scene.mesh;
        let Placement {
            loads,
            constraints,
            mut contacts,
            basis,
            mut state,
        } = Placement::new(&mut *matrices, scene)?;
        contacts.follow_displacement()?;
        let (ranks, size) = (matrices.stiffness().ranks(), state.velocity.len());
        let traits = Traits {
            inertia: matrices.has_mass(),
            has_state: ranks.any(contacts.have_state()),
            resists: ranks.all(contacts.resist_rates()) || matrices.viscosity().is_some(),
            lags: matrices.any_lags(),
        };
        let method = Method::new(scheme, traits);
        let properties = method.scheme.properties();
        let implicit = properties.implicit;
        check_scheme(&*matrices, &properties)?;
        let (matrices, mut body) = matrices.into_body(solver, implicit)?;
        if ranks.any(!basis.is_empty()) {
            body.change_basis(&basis);
        }
        let mut operators = Operators::new(body, implicit, properties.stability_limit);
        operators.measure_sliding(&*matrices, &constraints.fixed, &contacts.vertices, &basis);
        let zeros = |present: bool| vec![SVector::zeros(); if present { size } else { 0 }];
        state.algorithmic = zeros(properties.has_algorithmic);
        let kept = |kept: bool, field: &[_]| if kept { field.to_vec() } else { Vec::new() };
        let problem = Problem {
            equilibrium: kept(in_equilibrium, &state.displacement),
            initial_velocity: kept(matrices.has_mass(), &state.velocity),
            method,
            ranks,
            moves_freely: moves_freely(matrices.stiffness(), &constraints.fixed, &basis),
            stops: Vec::new(),
            loads,
            constraints,
            basis,
            matrices,
            mesh,
        };
        let matrices = &*problem.matrices;
        let work = Workspace {
            certificate: Certificate::new(matrices, &contacts, &mut *operators.body),
            reactions: Reactions::new(matrices, &contacts),
            again: false,
            impact: false,
            acceleration: InitialAcceleration::new(&problem, &contacts),
            contacts,
            operators,
            end: state.clone(),
            start: None,
            load: zeros(true),
            change: zeros(true),
            scratch: problem.loads.scratch(size),
            mean_velocity: zeros(matrices.any_lags()),
            free: FreeStep::default(),
            solver_iterations: 0,
            balanced: None,
            compared: false,
        };
        let mut simulation = Simulation::at(problem, work, state);
        if !given {
            simulation.find_acceleration()?;
            if !simulation.state.acceleration.is_empty() {
                let (work, state) = (&simulation.work, &mut simulation.state);
                work.contacts.start_open(&mut state.contacts);
            }
        }
        Ok(simulation)
    }

    pub(super) fn find_acceleration<C>(own: &mut Simulation<C>) -> Result<(), SceneError> {
        let (p, state) = (&own.problem, &mut own.state);
        let time = state.clock.time();
        let dt = NUMERICS.difference * time.abs().max(1.0);
        own.work.find_acceleration(p, state, (time, dt))?;
        own.work.balanced = None;
        own.show();
        Ok(())
    }

    pub(super) fn renew_operators<C>(own: &mut Simulation<C>) {
        let (p, w) = (&own.problem, &mut own.work);
        let properties = p.method.scheme.properties();
        w.operators.renew(properties.implicit, properties.stability_limit);
        let (fixed, vertices) = (&p.constraints.fixed, &w.contacts.vertices);
        (w.operators).measure_sliding(&*p.matrices, fixed, vertices, &p.basis);
        if let Tolerance::Absolute(_) = p.method.tolerance {
            w.operators.measure_absolutely();
        }
        w.balanced = None;
    }

    pub(super) fn replace_solver<C>(own: &mut Simulation<C>, solver: AnySolver) -> Result<(), SceneError> {
        let operators = &mut own.work.operators;
        operators.body.set_solver(solver)?;
        if own.problem.ranks.any(!own.problem.basis.is_empty()) {
            operators.body.change_basis(&own.problem.basis);
        }
        operators.prepared = None;
        Ok(())
    }
}

/// Whether a rigid-body mode of the body is constrained by friction alone.
fn moves_freely<const C: usize>(
    stiffness: &dyn Matrix<C>,
    fixed: &[[bool; C]],
    basis: &Basis<C>,
) -> bool {
    if stiffness.ranks().are_several() {
        return false;
    }
    let (directions, count) = basis.free_translations(fixed);
    let mut shift = vec![SVector::zeros(); fixed.len()];
    let mut free = directions[..count].iter();
    free.any(|direction| basis.moves_freely(stiffness, direction, &mut shift))
}
