//! The initial conditions of a reduced body.

use nalgebra::SVector;
use stickslip_solvers::{BlockMatrix, Matrix};

use super::ReducedBody;
use super::projector::{add, inner};
use super::support::Support;
use crate::scene::{Initial, Loads};
use crate::{Scene, SceneError};

/// The largest share of an initial field's energy that can be lost.
const LOST: f64 = 1e-2;
/// The largest initial displacement of fixed components, as a share of the largest displacement.
const HELD: f64 = 1e-6;
const DISPLACEMENT: &str = "initial displacement";

impl<const C: usize> ReducedBody<C> {
    /// The initial conditions of a scene, with its own support, in the coordinates of the reduced body.
    pub(super) fn start(
        &self,
        scene: &Scene<BlockMatrix<C>, C>,
        support: &Support<C>,
    ) -> Result<Initial<C>, SceneError> {
        let given = &scene.conditions.initial;
        let mut initial = Initial {
            time: given.time,
            balanced: given.balanced,
            ..Initial::default()
        };
        if scene.equilibrium.is_none() {
            let offset = self.projector.offset(&first_load(scene, &self.support))?;
            let loaded = inner(&offset, &offset) > 0.0;
            if loaded || !given.displacement.is_empty() {
                let mut field = self.in_frames(&given.displacement);
                add(&mut field, -1.0, &offset);
                let (coordinates, apart) = self.statics(&field)?;
                self.check_held(&field, &apart)?;
                let displacement = self.dynamics(coordinates, &field, apart, Some(DISPLACEMENT))?;
                initial.displacement = self.field(&displacement);
            }
        }
        let velocity = self.velocity_of(scene, support)?;
        if velocity.iter().any(|v| v.norm_squared() > 0.0) {
            let what = (!given.velocity.is_empty()).then_some("initial velocity");
            initial.velocity = self.nearest(&velocity, what)?;
        }
        if !given.acceleration.is_empty() {
            let acceleration = self.in_frames(&given.acceleration);
            initial.acceleration = self.nearest(&acceleration, Some("initial acceleration"))?;
        }
        Ok(initial)
    }

    /// The initial velocity as in a simulation of the whole body, with its Dirichlet components.
    fn velocity_of(
        &self,
        scene: &Scene<BlockMatrix<C>, C>,
        support: &Support<C>,
    ) -> Result<Vec<SVector<f64, C>>, SceneError> {
        let mut velocity = self.in_frames(&scene.conditions.initial.velocity);
        for (velocity, fixed) in velocity.iter_mut().zip(&support.fixed) {
            (0..C).filter(|&c| fixed[c]).for_each(|c| velocity[c] = 0.0);
        }
        for moved in &support.parts {
            moved.set(
                &moved.velocity_at(scene.conditions.initial.time)?,
                &mut velocity,
            );
        }
        Ok(velocity)
    }

    fn in_frames(&self, field: &[SVector<f64, C>]) -> Vec<SVector<f64, C>> {
        let mut field = crate::scene::or_zeros(field, self.support.fixed.len());
        self.support.basis.field_to_basis(&mut field);
        field
    }

    /// The field of the reduced body that is nearest to a field of the whole one.
    fn nearest(
        &self,
        field: &[SVector<f64, C>],
        what: Option<&'static str>,
    ) -> Result<Vec<SVector<f64, C>>, SceneError> {
        let (coordinates, apart) = self.statics(field)?;
        Ok(self.field(&self.dynamics(coordinates, field, apart, what)?))
    }

    /// The coordinates of the boundary and of driven parts in a field, and its remainder beside their static responses.
    fn statics(
        &self,
        field: &[SVector<f64, C>],
    ) -> Result<(Vec<f64>, Vec<SVector<f64, C>>), SceneError> {
        let projector = &self.projector;
        let mut coordinates = vec![0.0; projector.size()];
        for (coordinate, &(vertex, c)) in coordinates.iter_mut().zip(&projector.owners) {
            *coordinate = field[vertex][c];
        }
        let units = self
            .handles
            .iter()
            .filter_map(|(_, handle)| handle.as_ref());
        let units = units.flat_map(|handle| &handle.units);
        for (coordinate, unit) in coordinates[projector.count()..].iter_mut().zip(units) {
            let along: f64 = unit.iter().map(|(vertex, x)| x.dot(&field[*vertex])).sum();
            let length: f64 = unit.iter().map(|(_, x)| x.norm_squared()).sum();
            *coordinate = if length > 0.0 { along / length } else { 0.0 };
        }
        let mut apart = field.to_vec();
        add(&mut apart, -1.0, &projector.combine(&coordinates)?);
        Ok((coordinates, apart))
    }

    /// Refuses displacements of fixed components, and those of driven parts that are not uniform.
    fn check_held(
        &self,
        field: &[SVector<f64, C>],
        apart: &[SVector<f64, C>],
    ) -> Result<(), SceneError> {
        let largest = field.iter().map(|u| u.amax()).fold(0.0, f64::max);
        for (vertex, held) in self.support.eliminated().iter().enumerate() {
            for component in (0..C).filter(|&c| held[c]) {
                let value = apart[vertex][component];
                if value.abs() > HELD * largest {
                    return Err(SceneError::HeldApart {
                        vertex,
                        component,
                        value,
                    });
                }
            }
        }
        Ok(())
    }

    /// Adds the amplitudes of the modes nearest to the remainder beside the static responses; for a named field it
    /// refuses a large loss.
    fn dynamics(
        &self,
        mut coordinates: Vec<f64>,
        field: &[SVector<f64, C>],
        apart: Vec<SVector<f64, C>>,
        what: Option<&'static str>,
    ) -> Result<Vec<f64>, SceneError> {
        let projector = &self.projector;
        let Some(mass) = &self.inertia else {
            return Ok(coordinates);
        };
        let mut momentum = vec![SVector::zeros(); apart.len()];
        mass.multiply_add(1.0, &apart, &mut momentum);
        let square = inner(&apart, &momentum);
        let first = projector.count() + projector.handles;
        let modes = coordinates[first..].iter_mut();
        let mut kept = 0.0;
        let shapes = projector.shapes[projector.handles..].iter();
        for (coordinate, (shape, mass)) in modes.zip(shapes.zip(&projector.masses)) {
            let along = inner(shape, &momentum);
            *coordinate = along / mass;
            kept += along * *coordinate;
        }
        let share = (square - kept) / mass.quadratic(field).max(f64::MIN_POSITIVE);
        match what {
            Some(what) if share > LOST => Err(SceneError::ReducedStart { what, share }),
            _ => Ok(coordinates),
        }
    }
}

/// The load of a scene at its first time, in the frames of the vertices.
fn first_load<const C: usize>(
    scene: &Scene<BlockMatrix<C>, C>,
    support: &Support<C>,
) -> Vec<SVector<f64, C>> {
    let size = scene.stiffness.rows();
    let loads = Loads::new(scene.conditions.loads.clone(), &support.basis);
    let mut load = vec![SVector::zeros(); size];
    loads.fill(
        scene.conditions.initial.time,
        &mut load,
        &mut loads.scratch(size),
    );
    load
}
