//! What a reduced body starts from.

use nalgebra::SVector;
use stickslip_tnnmg::{BlockMatrix, ConjugateGradients, Operator, Symmetric};

use super::ReducedBody;
use super::body::first_load;
use super::projector::{add, inner};
use crate::scene::Initial;
use crate::{Scene, SceneError};

/// The share of a start, by its energy, that may be lost.
const LOST: f64 = 1e-2;

impl<const C: usize> ReducedBody<C> {
    /// The start of a scene in the coordinates of the reduced body.
    pub(super) fn start(
        &self,
        scene: &Scene<BlockMatrix<C>, C>,
    ) -> Result<Initial<Symmetric<C>, C>, SceneError> {
        let given = &scene.initial;
        let mut initial = Initial {
            time: given.time,
            recurrent: given.recurrent,
            ..Initial::default()
        };
        if given.equilibrium.is_some() {
            initial.equilibrium = Some(Box::new(ConjugateGradients::default()));
        } else {
            let offset = self.projector.offset(&first_load(scene, &self.support))?;
            let loaded = inner(&offset, &offset) > 0.0;
            if loaded || !given.displacement.is_empty() {
                let mut field = self.in_frames(&given.displacement);
                add(&mut field, -1.0, &offset);
                let displacement = self.coordinates_of(&field, "initial displacement")?;
                initial.displacement = self.field(&displacement);
            }
        }
        for (what, field, into) in [
            ("initial velocity", &given.velocity, &mut initial.velocity),
            (
                "initial acceleration",
                &given.acceleration,
                &mut initial.acceleration,
            ),
        ] {
            if !field.is_empty() {
                let coordinates = self.coordinates_of(&self.in_frames(field), what)?;
                *into = self.field(&coordinates);
            }
        }
        Ok(initial)
    }

    fn in_frames(&self, field: &[SVector<f64, C>]) -> Vec<SVector<f64, C>> {
        let mut field = crate::scene::or_zeros(field, self.support.fixed.len());
        self.support.frames.field_to_frames(&mut field);
        field
    }

    /// The coordinates of a field, as near as modes come to what is beside the static responses.
    fn coordinates_of(
        &self,
        field: &[SVector<f64, C>],
        what: &'static str,
    ) -> Result<Vec<f64>, SceneError> {
        let projector = &self.projector;
        let mut coordinates = vec![0.0; projector.size()];
        for (coordinate, &(vertex, c)) in coordinates.iter_mut().zip(projector.responses().owners())
        {
            *coordinate = field[vertex][c];
        }
        let units = self
            .handles
            .iter()
            .filter_map(|(_, handle)| handle.as_ref());
        let units = units.flat_map(|handle| &handle.units);
        for (coordinate, unit) in coordinates[projector.count..].iter_mut().zip(units) {
            let along: f64 = unit.iter().map(|(vertex, x)| x.dot(&field[*vertex])).sum();
            let length: f64 = unit.iter().map(|(_, x)| x.norm_squared()).sum();
            *coordinate = if length > 0.0 { along / length } else { 0.0 };
        }
        let Some(mass) = &self.inertia else {
            return Ok(coordinates);
        };
        let mut left = field.to_vec();
        add(&mut left, -1.0, &projector.combine(&coordinates)?);
        let mut momentum = vec![SVector::zeros(); left.len()];
        mass.multiply_add(1.0, &left, &mut momentum);
        let square = inner(&left, &momentum);
        let first = projector.count + projector.handles;
        let modes = coordinates[first..].iter_mut();
        let mut kept = 0.0;
        for (coordinate, shape) in modes.zip(&projector.shapes[projector.handles..]) {
            *coordinate = inner(shape, &momentum);
            kept += *coordinate * *coordinate;
        }
        let lost = (square - kept) / mass.quadratic(field).max(f64::MIN_POSITIVE);
        if lost > LOST {
            return Err(SceneError::ReducedStart { what, share: lost });
        }
        Ok(coordinates)
    }
}
