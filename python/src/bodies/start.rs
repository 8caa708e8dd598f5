//! A simulation of a body: its scene, scheme and solver.

use pyo3::prelude::*;
use stickslip::fem::{Assembled, FemError, P1, body_force, mass};
use stickslip::integrate::Stepper;
use stickslip::nalgebra::SVector;
use stickslip::{
    BackwardEuler, BlockMatrix, Cholesky, Condensed, Coupling, DenseNewton, GeneralizedAlpha,
    MultigridSolver, Newmark, NonsmoothSolver, Operator, RateScheme, Scene, SceneError, Sdirk2,
    Simulation, StateUpdate, Tnnmg,
};

use super::body::Body;
use super::reduced::{Modes, Whole};
use super::simulation::Moving;
use crate::errors::argument;
use crate::raised::Raised;

/// How a simulation begins.
pub(super) struct Start {
    pub(super) scheme: Box<dyn RateScheme>,
    pub(super) multigrid: bool,
    /// The modes of a reduced body.
    pub(super) modes: Option<Modes>,
    pub(super) equilibrium: bool,
    pub(super) zero_acceleration: bool,
    pub(super) coupling: Box<dyn Coupling>,
    pub(super) state_update: Option<StateUpdate>,
    pub(super) tolerance: Option<f64>,
    pub(super) absolute_tolerance: Option<f64>,
}

impl Start {
    /// The simulation of a body with this stiffness.
    pub(super) fn begin<const D: usize, const C: usize>(
        self,
        body: &Body,
        space: &P1<D>,
        stiffness: Result<Assembled<C>, FemError>,
        raised: &Raised,
    ) -> Result<Moving<C>, SceneError> {
        let mut scene: Scene<BlockMatrix<C>, C> = Scene::new(stiffness?).on(space);
        if body.density > 0.0 {
            scene = scene.with_mass(mass(space, body.density)?);
        }
        let mut load = Vec::new();
        if !body.gravity.is_empty() {
            let weight = SVector::<f64, C>::from_fn(|c, _| body.density * body.gravity[c]);
            load = body_force(space, |_| weight);
            scene = scene.with_load(load.clone());
        }
        for condition in &body.conditions {
            scene = condition.on(scene, raised);
        }
        for contact in &body.contacts {
            scene = contact.on(scene, raised);
        }
        if self.equilibrium {
            scene = if self.multigrid {
                scene.in_equilibrium(MultigridSolver::new(space.transfers()))
            } else {
                scene.in_equilibrium(Cholesky::new())
            };
        }
        if self.zero_acceleration {
            scene = scene.with_zero_acceleration();
        }
        if let Some(modes) = self.modes {
            let reduced = modes.reduced(&scene)?;
            let scene = reduced.reduce(scene)?;
            return Ok(Moving {
                stepper: self.moving(scene, Box::new(DenseNewton::new()))?,
                whole: Some(Whole::new(reduced, load, space.vertex_count())),
            });
        }
        let solver: Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> = if self.multigrid {
            Box::new(Tnnmg::new(space.transfers()))
        } else {
            Box::new(Condensed::new())
        };
        Ok(Moving {
            stepper: self.moving(scene, solver)?,
            whole: None,
        })
    }

    /// The simulation of a scene.
    fn moving<Op: Operator<C> + 'static, const C: usize>(
        self,
        scene: Scene<Op, C>,
        solver: Box<dyn NonsmoothSolver<Op, C>>,
    ) -> Result<Box<dyn Stepper<C>>, SceneError> {
        let mut simulation =
            Simulation::new(scene, self.scheme, solver)?.with_coupling(self.coupling);
        if let Some(update) = self.state_update {
            simulation = simulation.with_state_update(update);
        }
        if let Some(tolerance) = self.tolerance {
            simulation = simulation.with_tolerance(tolerance)?;
        }
        if let Some(tolerance) = self.absolute_tolerance {
            simulation = simulation.with_absolute_tolerance(tolerance)?;
        }
        Ok(Box::new(simulation))
    }
}

/// The scheme of a name.
pub(super) fn scheme_of(scheme: &str) -> PyResult<Box<dyn RateScheme>> {
    Ok(match scheme {
        "generalized-alpha" => Box::new(GeneralizedAlpha::default()),
        "newmark" => Box::new(Newmark::default()),
        "backward-euler" => Box::new(BackwardEuler),
        "sdirk2" => Box::new(Sdirk2),
        _ => {
            let names = "\"generalized-alpha\", \"newmark\", \"backward-euler\" or \"sdirk2\"";
            return Err(argument("scheme", names, scheme));
        }
    })
}
