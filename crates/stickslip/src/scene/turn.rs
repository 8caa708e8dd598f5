//! The rotation of a scene to the local frames of its surfaces.

use stickslip_solvers::{Frames, LinearSolver, Operator};

use super::{Initial, MASS, STIFFNESS, Scene, VISCOSITY};
use crate::SceneError;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Rotates operators and initial conditions to the local frames of the vertices.
    pub(crate) fn turn(&mut self, frames: &Frames<C>) -> Result<(), SceneError> {
        if frames.is_empty() {
            return Ok(());
        }
        if !self.turned {
            let turned =
                |what, turned: bool| turned.then_some(()).ok_or(SceneError::NoFrames { what });
            turned(STIFFNESS, self.stiffness.turn(frames))?;
            if let Some(mass) = &mut self.mass {
                turned(MASS, mass.turn(frames))?;
            }
            for viscosity in self.viscosity.iter_mut().chain(&mut self.viscosities) {
                turned(VISCOSITY, viscosity.turn(frames))?;
            }
        }
        let Initial {
            equilibrium,
            displacement,
            velocity,
            acceleration,
            ..
        } = &mut self.initial;
        if let Some(solver) = equilibrium {
            solver.turn(frames);
        }
        for field in [displacement, velocity, acceleration] {
            if !field.is_empty() {
                frames.field_to_frames(field);
            }
        }
        Ok(())
    }

    /// Adds the viscosities, which have equal size, and stores the summands.
    pub(crate) fn sum_viscosities(&mut self) {
        if self.viscosity.len() > 1 {
            let terms: Vec<_> = self.viscosity.iter().map(|term| (1.0, term)).collect();
            let sum = Op::combination(&terms);
            self.viscosities = std::mem::replace(&mut self.viscosity, vec![sum]);
        }
    }
}
